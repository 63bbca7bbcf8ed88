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
    side_.resize(mesh.sides());
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

  void shoot(std::uint32_t patch_side, const FormFactorRow& row) {
    const Rgb flux = take_unshot(patch_side);
    double arrived = 0.0;
    // Sides of a patch follow one another in a row: what they send is added up before it is stored.
    std::size_t sender = 0;
    double sum_lm = 0.0;
    for (const FormFactor& f : row) {
      const Receiver& element = element_[f.side / 2];
      SideState& side = side_[f.side];
      const Rgb lux = (f.value * element.per_m2) * flux;
      const Rgb sent = element.reflectance * lux;
      side.received = side.received + lux;
      side.unshot = side.unshot + sent;
      const std::size_t its_patch = 2 * element.patch + f.side % 2;
      if (its_patch != sender) {
        add_unshot(sender, sum_lm);
        sender = its_patch, sum_lm = 0.0;
      }
      sum_lm += element.area_m2 * luminance_of(sent);
      arrived += f.value;
    }
    add_unshot(sender, sum_lm);
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
    for (std::size_t s = 0; s < mesh_.sides(); ++s) {
      sides.received.push_back(side_[s].received);
      sides.unshot.push_back(side_[s].unshot);
      sides.radiosity.push_back(surfaces_.emission_lm_m2[s / 2] +
                                surfaces_.reflectance[s / 2] * (direct_[s] + side_[s].received));
    }
    return sides;
  }

  /// Unshot light, and all that it becomes, spread over both sides of everything.
  Rgb ambient() const {
    Rgb flux, weighted;
    double area = 0.0;
    for (std::size_t s = 0; s < mesh_.sides(); ++s) {
      const std::size_t e = s / 2;
      flux = flux + surfaces_.area_m2[e] * side_[s].unshot;
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
      const Rgb rho = surfaces_.reflectance[e], lux = direct_[s] + side_[s].received;
      b.emitted_lm += area * luminance_of(surfaces_.emission_lm_m2[e] + direct_[s]);
      b.absorbed_lm += area * luminance_of(Rgb{1.0 - rho.r, 1.0 - rho.g, 1.0 - rho.b} * lux);
      b.unshot_lm += area * luminance_of(side_[s].unshot);
    }
    return b;
  }

 private:
  /// What the inner loop needs of a side and of an element, side by side in memory.
  struct SideState {
    Rgb received, unshot;
  };
  struct Receiver {
    Rgb reflectance;
    double area_m2 = 0.0, per_m2 = 0.0;
    std::size_t patch = 0;
  };

  void add_patch(std::size_t patch) {
    for (std::size_t e = mesh_.patch_begin[patch]; e < mesh_.patch_begin[patch + 1]; ++e) {
      const double area = surfaces_.area_m2[e];
      element_[e] = {surfaces_.reflectance[e], area, 1.0 / area, patch};
      for (const std::size_t face : {0U, 1U}) {
        const std::size_t s = 2 * e + face;
        side_[s].unshot = surfaces_.emission_lm_m2[e] + surfaces_.reflectance[e] * direct_[s];
        received_lm_ += area * luminance_of(direct_[s]);
        emitted_lm_ += area * luminance_of(direct_[s] + surfaces_.emission_lm_m2[e]);
        unshot_lm_[2 * patch + face] += area * luminance_of(side_[s].unshot);
      }
    }
  }

  void add_unshot(std::size_t patch_side, double lm) {
    unshot_lm_[patch_side] += lm;
    total_unshot_lm_ += lm;
  }

  Rgb take_unshot(std::uint32_t patch_side) {
    Rgb flux;
    const std::size_t patch = patch_side / 2;
    for (std::size_t e = mesh_.patch_begin[patch]; e < mesh_.patch_begin[patch + 1]; ++e) {
      Rgb& unshot = side_[2 * e + patch_side % 2].unshot;
      flux = flux + surfaces_.area_m2[e] * unshot;
      unshot = {};
    }
    total_unshot_lm_ -= unshot_lm_[patch_side];
    unshot_lm_[patch_side] = 0.0;
    return flux;
  }

  const ElementMesh& mesh_;
  const SurfaceLight& surfaces_;
  std::span<const Rgb> direct_;
  std::vector<SideState> side_;    ///< [element side]
  std::vector<Receiver> element_;  ///< [element]
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
