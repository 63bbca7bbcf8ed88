#include "radiosity/progressive_refinement.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "core/error.h"

namespace tenku {
namespace {

constexpr std::size_t kBatch = 32;  // patch sides whose rows are found at once
constexpr std::size_t kMostShots = 1'000'000, kMostShotsAPatch = 100;

constexpr std::size_t kSettled = 16;    // batches between two exact sums
constexpr double kMostUnshot = 0.0005;  // of what is emitted: a balance to 0.1 %

class Refinement {
 public:
  Refinement(const ElementMesh& mesh, const SurfaceLight& surfaces, std::span<const Rgb> direct)
      : mesh_(mesh), surfaces_(surfaces), direct_(direct) {
    expects(direct.size() == mesh.sides(), "direct light is known on every side");
    received_.resize(mesh.sides());
    first_unshot_.resize(mesh.sides());
    element_.resize(mesh.size());
    unshot_lm_.resize(2 * mesh.patches());
    for (std::size_t p = 0; p < mesh.patches(); ++p) add_patch(p);
    settle();
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

  /// Sides of a patch follow one another in a row, and are of one material: what they send is added
  /// up before it is stored.
  void shoot(std::uint32_t patch_side, const FormFactorRow& row) {
    const Rgb flux = take_unshot(patch_side);
    std::size_t receiver = 0;
    double arrived = 0.0, at_receiver = 0.0;
    for (const FormFactor& f : row) {
      const Element& element = element_[f.side / 2];
      const std::size_t its_patch = 2 * std::size_t{element.patch} + f.side % 2;
      if (its_patch != receiver) {
        add_unshot(receiver, at_receiver, flux);
        arrived += at_receiver;
        receiver = its_patch, at_receiver = 0.0;
      }
      received_[f.side] = received_[f.side] + (f.value * element.per_m2) * flux;
      at_receiver += f.value;
    }
    add_unshot(receiver, at_receiver, flux);
    arrived += at_receiver;
    const double lm = luminance_of(flux);
    received_lm_ += arrived * lm;
    escaped_lm_ += (1.0 - arrived) * lm;
    ++shots_;
  }

  /// Sums anew what shots have changed bit by bit.
  void settle() { total_unshot_lm_ = std::accumulate(unshot_lm_.begin(), unshot_lm_.end(), 0.0); }

  double left_lm() const { return total_unshot_lm_ / (1.0 - surfaces_.most_reflectance); }
  bool is_within(double tolerance) const {
    return left_lm() <= tolerance * received_lm_ && total_unshot_lm_ <= kMostUnshot * emitted_lm_;
  }
  std::size_t shots() const { return shots_; }

  SideRadiosity sides() const {
    SideRadiosity sides;
    sides.received = received_;
    for (std::size_t s = 0; s < mesh_.sides(); ++s) {
      sides.unshot.push_back(unshot(s));
      sides.radiosity.push_back(surfaces_.emission_lm_m2[s / 2] +
                                surfaces_.reflectance[s / 2] * (direct_[s] + received_[s]));
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
    b.escaped_lm = escaped_lm_;
    for (std::size_t s = 0; s < mesh_.sides(); ++s) {
      const std::size_t e = s / 2;
      const double area = surfaces_.area_m2[e];
      const Rgb rho = surfaces_.reflectance[e], lux = direct_[s] + received_[s];
      b.emitted_lm += area * luminance_of(surfaces_.emission_lm_m2[e] + direct_[s]);
      b.absorbed_lm += area * luminance_of(Rgb{1.0 - rho.r, 1.0 - rho.g, 1.0 - rho.b} * lux);
      b.unshot_lm += area * luminance_of(unshot(s));
    }
    return b;
  }

 private:
  /// What the inner loop needs of an element, side by side in memory.
  struct Element {
    double per_m2 = 0.0;
    std::uint32_t patch = 0;
  };

  Rgb unshot(std::size_t side) const {
    return first_unshot_[side] + surfaces_.reflectance[side / 2] * received_[side];
  }

  void add_patch(std::size_t patch) {
    for (std::size_t e = mesh_.patch_begin[patch]; e < mesh_.patch_begin[patch + 1]; ++e) {
      const double area = surfaces_.area_m2[e];
      element_[e] = {1.0 / area, static_cast<std::uint32_t>(patch)};
      for (const std::size_t face : {0U, 1U}) {
        const std::size_t s = 2 * e + face;
        first_unshot_[s] = surfaces_.emission_lm_m2[e] + surfaces_.reflectance[e] * direct_[s];
        received_lm_ += area * luminance_of(direct_[s]);
        emitted_lm_ += area * luminance_of(direct_[s] + surfaces_.emission_lm_m2[e]);
        unshot_lm_[2 * patch + face] += area * luminance_of(unshot(s));
      }
    }
  }

  /// @param arrived  of `flux`
  void add_unshot(std::size_t patch_side, double arrived, Rgb flux) {
    const Rgb reflectance = surfaces_.reflectance[mesh_.patch_begin[patch_side / 2]];
    const double lm = arrived * luminance_of(reflectance * flux);
    unshot_lm_[patch_side] += lm;
    total_unshot_lm_ += lm;
  }

  Rgb take_unshot(std::uint32_t patch_side) {
    Rgb flux;
    const std::size_t patch = patch_side / 2;
    for (std::size_t e = mesh_.patch_begin[patch]; e < mesh_.patch_begin[patch + 1]; ++e) {
      const std::size_t side = 2 * e + patch_side % 2;
      flux = flux + surfaces_.area_m2[e] * unshot(side);
      first_unshot_[side] = -1.0 * (surfaces_.reflectance[e] * received_[side]);
    }
    total_unshot_lm_ -= unshot_lm_[patch_side];
    unshot_lm_[patch_side] = 0.0;
    return flux;
  }

  const ElementMesh& mesh_;
  const SurfaceLight& surfaces_;
  std::span<const Rgb> direct_;
  std::vector<Rgb> received_;  ///< [element side], lux from other sides
  std::vector<Rgb>
      first_unshot_;  ///< [element side], and so much more as is reflected of `received_`
  std::vector<Element> element_;
  std::vector<double> unshot_lm_;  ///< [patch side]
  std::vector<std::uint32_t> order_;
  double total_unshot_lm_ = 0.0, emitted_lm_ = 0.0, received_lm_ = 0.0, escaped_lm_ = 0.0;
  std::size_t shots_ = 0;
};

}  // namespace

RefinementResult refine_progressively(const ElementMesh& mesh, const SurfaceLight& surfaces,
                                      std::span<const Rgb> direct, PatchRows& rows,
                                      const RefinementOptions& options, Progress& progress) {
  Refinement state(mesh, surfaces, direct);
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
  std::size_t batches = 0;
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
    if (++batches % kSettled == 0 || state.is_within(options.tolerance)) state.settle();
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
