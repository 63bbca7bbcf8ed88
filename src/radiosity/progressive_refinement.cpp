#include "radiosity/progressive_refinement.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"

namespace tenku {
namespace {

constexpr std::size_t kBatch = 32;  // patch sides whose rows are found at once
constexpr std::size_t kMostShots = 1'000'000, kMostShotsAPatch = 100;

constexpr double kMostUnshot = 0.0005;  // of what is emitted: a balance to 0.1 %
constexpr double kRounding = 1e-7;      // of what is emitted

Rgb magnitude(Rgb c) { return {std::abs(c.r), std::abs(c.g), std::abs(c.b)}; }

class Refinement {
 public:
  Refinement(const ElementMesh& mesh, const SurfaceLight& surfaces, std::span<const Rgb> direct,
             const SentLight& start)
      : mesh_(mesh), surfaces_(surfaces), direct_(direct), escaped_lm_(start.escaped_lm) {
    expects(direct.size() == mesh.sides(), "direct light is known on every side");
    received_.resize(mesh.sides());
    first_unshot_.resize(mesh.sides());
    patch_side_.resize(mesh.sides());
    patch_.resize(2 * mesh.patches());
    unshot_lm_.resize(patch_.size());
    for (std::size_t p = 0; p < mesh.patches(); ++p) add_patch(p, start);
    weigh();
  }

  std::vector<std::uint32_t> brightest() {
    order_.clear();
    for (std::uint32_t s = 0; s < unshot_lm_.size(); ++s) {
      if (unshot_lm_[s] > 0.0) order_.push_back(s);
    }
    const auto last = order_.begin() + static_cast<std::ptrdiff_t>(std::min(kBatch, order_.size()));
    std::partial_sort(order_.begin(), last, order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return unshot_lm_[a] != unshot_lm_[b] ? unshot_lm_[a] > unshot_lm_[b] : a < b;
    });
    return {order_.begin(), last};
  }

  void shoot(std::uint32_t patch_side, const FormFactorRow& row) {
    const Rgb flux = take_unshot(patch_side);
    double arrived = 0.0;
    for (const FormFactor& f : row) {
      const Rgb part = f.value * flux;
      received_[f.side] = received_[f.side] + part;
      Rgb& of_patch = patch_[patch_side_[f.side]].received;
      of_patch = of_patch + part;
      arrived += f.value;
    }
    const double lm = luminance_of(flux);
    received_lm_ += arrived * lm;
    escaped_lm_ += (1.0 - arrived) * lm;
    ++shots_;
  }

  /// What patch sides have to send by now.
  void weigh() {
    total_unshot_lm_ = 0.0;
    for (std::size_t s = 0; s < patch_.size(); ++s) {
      const Patch& p = patch_[s];
      unshot_lm_[s] = luminance_of(magnitude(p.first_unshot + p.reflectance * p.received));
      total_unshot_lm_ += unshot_lm_[s];
    }
  }

  double left_lm() const { return total_unshot_lm_ / (1.0 - surfaces_.most_reflectance); }
  bool is_within(double tolerance) const {
    return left_lm() <= tolerance * received_lm_ && total_unshot_lm_ <= kMostUnshot * emitted_lm_;
  }
  std::size_t shots() const { return shots_; }

  SideRadiosity sides() const {
    SideRadiosity sides;
    for (std::size_t s = 0; s < mesh_.sides(); ++s) {
      sides.received.push_back(received_lux(s));
      sides.unshot.push_back(unshot(s));
      sides.radiosity.push_back(surfaces_.emission_lm_m2[s / 2] +
                                surfaces_.reflectance[s / 2] * (direct_[s] + received_lux(s)));
    }
    return sides;
  }

  /// Unshot light, and all that it becomes, spread over both sides of everything.
  Rgb ambient() const {
    Rgb flux, weighted;
    double area = 0.0;
    for (std::size_t s = 0; s < mesh_.sides(); ++s) {
      const std::size_t e = s / 2;
      flux = flux + surfaces_.area_m2[e] * unshot(s);
      weighted = weighted + surfaces_.area_m2[e] * surfaces_.reflectance[e];
      area += surfaces_.area_m2[e];
    }
    const auto spread = [&](double lm, double rho_area) { return lm / (area - rho_area); };
    return {spread(flux.r, weighted.r), spread(flux.g, weighted.g), spread(flux.b, weighted.b)};
  }

  /// From the light on each side, not from the sums kept while shooting.
  LightBalance balance() const {
    LightBalance b;
    // Rows are floats: of a closed room they add up to 1 within rounding, on either side of it.
    b.escaped_lm =
        escaped_lm_ > -kRounding * emitted_lm_ ? std::max(0.0, escaped_lm_) : escaped_lm_;
    for (std::size_t s = 0; s < mesh_.sides(); ++s) {
      const std::size_t e = s / 2;
      const double area = surfaces_.area_m2[e];
      const Rgb rho = surfaces_.reflectance[e], lux = direct_[s] + received_lux(s);
      b.emitted_lm += area * luminance_of(surfaces_.emission_lm_m2[e] + direct_[s]);
      b.absorbed_lm += area * luminance_of(Rgb{1.0 - rho.r, 1.0 - rho.g, 1.0 - rho.b} * lux);
      b.unshot_lm += area * luminance_of(unshot(s));
    }
    return b;
  }

 private:
  /// Of a side of a patch, which is of one material; lm.
  struct Patch {
    Rgb first_unshot, reflectance, received;
  };

  Rgb received_lux(std::size_t side) const {
    return (1.0 / surfaces_.area_m2[side / 2]) * received_[side];
  }
  Rgb unshot(std::size_t side) const {
    const std::size_t e = side / 2;
    return (1.0 / surfaces_.area_m2[e]) *
           (first_unshot_[side] + surfaces_.reflectance[e] * received_[side]);
  }

  void add_patch(std::size_t patch, const SentLight& start) {
    for (std::size_t e = mesh_.patch_begin[patch]; e < mesh_.patch_begin[patch + 1]; ++e) {
      const double area = surfaces_.area_m2[e];
      for (const std::size_t face : {0U, 1U}) {
        const std::size_t s = 2 * e + face;
        patch_side_[s] = static_cast<std::uint32_t>(2 * patch + face);
        Patch& all = patch_[patch_side_[s]];
        Rgb first = surfaces_.emission_lm_m2[e] + surfaces_.reflectance[e] * direct_[s];
        if (!start.radiosity.empty()) {
          first = first + -1.0 * start.radiosity[s];
          received_[s] = area * start.received[s];
        }
        first_unshot_[s] = area * first;
        all.first_unshot = all.first_unshot + first_unshot_[s];
        all.received = all.received + received_[s];
        all.reflectance = surfaces_.reflectance[e];
        received_lm_ += luminance_of(area * direct_[s] + received_[s]);
        emitted_lm_ += area * luminance_of(direct_[s] + surfaces_.emission_lm_m2[e]);
      }
    }
  }

  Rgb take_unshot(std::uint32_t patch_side) {
    const std::size_t patch = patch_side / 2;
    for (std::size_t e = mesh_.patch_begin[patch]; e < mesh_.patch_begin[patch + 1]; ++e) {
      const std::size_t side = 2 * e + patch_side % 2;
      first_unshot_[side] = -1.0 * (surfaces_.reflectance[e] * received_[side]);
    }
    Patch& all = patch_[patch_side];
    const Rgb reflected = all.reflectance * all.received, flux = all.first_unshot + reflected;
    all.first_unshot = -1.0 * reflected;
    return flux;
  }

  const ElementMesh& mesh_;
  const SurfaceLight& surfaces_;
  std::span<const Rgb> direct_;
  std::vector<Rgb> received_;      ///< [element side], lm from other sides
  std::vector<Rgb> first_unshot_;  ///< [element side], lm, and what is reflected of `received_`
  std::vector<std::uint32_t> patch_side_;  ///< [element side]
  std::vector<Patch> patch_;               ///< [patch side]
  std::vector<double> unshot_lm_;          ///< [patch side], as last weighed
  std::vector<std::uint32_t> order_;
  double total_unshot_lm_ = 0.0, emitted_lm_ = 0.0, received_lm_ = 0.0, escaped_lm_ = 0.0;
  std::size_t shots_ = 0;
};

}  // namespace

RefinementResult refine_progressively(const ElementMesh& mesh, const SurfaceLight& surfaces,
                                      std::span<const Rgb> direct, PatchRows& rows,
                                      const RefinementOptions& options, Progress& progress) {
  Refinement state(mesh, surfaces, direct, options.start);
  const std::size_t most = options.most_shots > 0
                               ? options.most_shots
                               : std::max(kMostShots, kMostShotsAPatch * mesh.patches());
  progress.begin("shots of light", 0);
  std::size_t next_watch = 1;
  const auto show = [&] {
    if (!options.watch) return;
    const SideRadiosity sides = state.sides();
    options.watch({state.shots(), sides, state.ambient()});
  };
  while (!state.is_within(options.tolerance) && state.shots() < most) {
    progress.stop_if_cancelled();
    std::vector<std::uint32_t> batch = state.brightest();
    if (batch.empty()) break;
    batch.resize(std::min(batch.size(), most - state.shots()));
    const auto found = rows.rows_of(batch, progress);
    for (std::size_t k = 0; k < batch.size(); ++k) {
      state.shoot(batch[k], *found[k]);
      if (state.shots() == next_watch) {
        show();
        next_watch *= 2;
      }
    }
    state.weigh();
    progress.advance(batch.size());
  }
  show();
  RefinementResult result;
  result.shots = state.shots();
  result.left_lm = state.left_lm();
  result.is_converged = state.is_within(options.tolerance);
  result.balance = state.balance();
  result.sides = state.sides();
  progress.end(std::to_string(result.shots) + " shots");
  return result;
}

}  // namespace tenku
