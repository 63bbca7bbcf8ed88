#include "radiosity/corner_solution.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr std::size_t kMostSweeps = 100, kGrain = 16;
constexpr double kDarkShare = 0.3;  // of the brightest corner: less is inside of something
constexpr double kNear = 0.3, kDoubt = 0.05, kCurved = 0.4;
constexpr float kWideView = 0.03F;

double lum(Rgb c) { return luminance_of(c); }

double lum_of_difference(Rgb a, Rgb b) {
  return lum({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Corners of a side that are not inside of something, by what they gather: three bits.
std::uint8_t open_corners(const std::array<std::uint32_t, 3>& corner,
                          std::span<const Rgb> gathered) {
  double most = 0.0;
  for (const std::uint32_t i : corner) most = std::max(most, lum(gathered[i]));
  unsigned open = 0;
  for (unsigned k = 0; k < 3; ++k) {
    if (lum(gathered[corner[k]]) >= kDarkShare * most) open |= 1U << k;
  }
  return static_cast<std::uint8_t>(open);
}

constexpr std::uint8_t kAllOpen = 7;

class CornerSolver {
 public:
  CornerSolver(const CornerProblem& problem, const PointGather& gather, CornerLight start,
               std::span<const std::uint8_t> is_lit)
      : problem_(problem), gather_(gather), is_lit_(is_lit) {
    light_.radiosity = std::move(start.radiosity);
    light_.open = std::move(start.open);
    light_.lux.resize(is_lit.size());
  }

  CornerLight solve(const Progress& progress) {
    for (;;) {
      progress.stop_if_cancelled();
      const std::vector<Rgb> before = light_.radiosity;
      sweep();
      if (is_enough()) break;
      go_on(before);
    }
    find_errors();
    return std::move(light_);
  }

 private:
  void sweep() {
    const SurfaceLight& surfaces = problem_.surfaces;
    looks_ = gather_.gather(reflected_part(surfaces, light_.radiosity), is_lit_);
    gathered_.resize(looks_.size());
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      for (std::size_t k = 0; k < PointGather::kLooks; ++k) {
        looks_[i][k] = looks_[i][k] + problem_.lamp_scale * problem_.lamps.left_to_rows[i][k];
      }
      gathered_[i] = mean_of(looks_[i]);
      light_.lux[i] = gathered_[i] + of_lamps(i);
    }
    double change = 0.0;
    if (light_.open.empty()) {  // settled once: a sweep is linear
      for (const auto& corner : problem_.points.corner) {
        light_.open.push_back(open_corners(corner, gathered_));
      }
    }
    if (steady_.empty()) {
      for (std::size_t s = 0; s < light_.radiosity.size(); ++s) {
        steady_.push_back(steady_mean_lux(s));
      }
    }
    for (std::size_t s = 0; s < light_.radiosity.size(); ++s) {
      if (is_lit_[problem_.points.corner[s][0]] == 0) continue;
      const Rgb now = surfaces.emission_lm_m2[s / 2] + surfaces.reflectance[s / 2] * mean_lux(s);
      change = std::max(change, lum_of_difference(now, light_.radiosity[s]));
      light_.radiosity[s] = now;
    }
    light_.convergence_lux = change / (1.0 - surfaces.most_reflectance);
    ++light_.sweeps;
  }

  /// Changes that shrink by r a sweep add up to r / (1 - r) of the last. Where they do not, the
  /// next sweep's change tells: it bounds the error wherever that sweep begins.
  void go_on(const std::vector<Rgb>& before) {
    std::vector<Rgb> change(before.size());
    double both = 0.0, square = 0.0;
    for (std::size_t s = 0; s < change.size(); ++s) {
      change[s] = light_.radiosity[s] + -1.0 * before[s];
      if (change_.empty()) continue;
      both += lum(change[s] * change_[s]);
      square += lum(change_[s] * change_[s]);
    }
    if (change_.empty()) {
      change_ = std::move(change);
      return;
    }
    const double shrinks =
        std::clamp(square > 0.0 ? both / square : 0.0, 0.0, problem_.surfaces.most_reflectance);
    const double more = shrinks / (1.0 - shrinks);
    for (std::size_t s = 0; s < change.size(); ++s) {
      light_.radiosity[s] = light_.radiosity[s] + more * change[s];
    }
    change_.clear();
  }

  template <class At>
  Rgb mean_of_open(std::size_t side, const At& at) const {
    Rgb sum;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((light_.open[side] >> k & 1U) != 0) sum = sum + at(problem_.points.corner[side][k]);
    }
    return (1.0 / std::popcount(light_.open[side])) * sum;
  }

  Rgb mean_lux(std::size_t side) const {
    return steady_[side] + mean_of_open(side, [&](std::uint32_t i) { return gathered_[i]; });
  }

  /// What no sweep changes of the mean light of a side.
  Rgb steady_mean_lux(std::size_t side) const {
    const DaylightOnSides& daylight = problem_.daylight;
    const Rgb at_corners = mean_of_open(side, [&](std::uint32_t i) { return steady(i); });
    const Rgb in_middle = Rgb::grey(daylight.middle_lux[side]) + middle_of_lamps(side);
    const bool is_hidden = light_.open[side] != kAllOpen && !(lum(in_middle) > 0.0);
    return is_hidden || problem_.lamps.has_middle[side] == 0 ? at_corners
                                                             : 0.25 * at_corners + 0.75 * in_middle;
  }

  /// Light at a corner that no sweep changes.
  Rgb steady(std::uint32_t i) const {
    return Rgb::grey(problem_.daylight.points.total_lux(i)) + of_lamps(i);
  }
  Rgb of_lamps(std::size_t i) const { return problem_.lamp_scale * problem_.lamps.corner[i].lux; }
  Rgb middle_of_lamps(std::size_t side) const {
    return problem_.lamp_scale * problem_.lamps.middle[side];
  }

  /// Dim places count: nineteen of twenty corners are brighter than what is compared with.
  bool is_enough() const {
    std::vector<double> lux;
    for (std::size_t i = 0; i < is_lit_.size(); ++i) {
      const double here = problem_.daylight.points.total_lux(i) + lum(light_.lux[i]);
      if (is_lit_[i] != 0 && here > 0.0) lux.push_back(here);
    }
    if (lux.empty() || light_.sweeps >= kMostSweeps) return true;
    const auto dim = lux.begin() + static_cast<std::ptrdiff_t>(lux.size() / 20);
    std::nth_element(lux.begin(), dim, lux.end());
    return light_.convergence_lux <= problem_.enough_pct / 100.0 * *dim;
  }

  void find_errors() {
    const auto& [mesh, surfaces, points, lamps, lamp_scale, daylight, enough] = problem_;
    light_.spread.assign(mesh.sides(), 0.0);
    light_.uneven.assign(mesh.sides(), 0.0);
    light_.middle_off.assign(mesh.sides(), 0.0);
    for (std::size_t s = 0; s < mesh.sides(); ++s) {
      if (is_lit_[points.corner[s][0]] == 0) continue;
      std::array<double, 3> lux{};
      for (std::size_t k = 0; k < 3; ++k) {
        lux[k] = lum(gathered_[points.corner[s][k]] + steady(points.corner[s][k]));
      }
      const auto [low, high] = std::minmax_element(lux.begin(), lux.end());
      const Rgb at_corners = mean_of_open(s, [&](std::uint32_t i) { return steady(i); });
      const double middle = daylight.middle_lux[s] + lum(middle_of_lamps(s)),
                   rho = lum(surfaces.reflectance[s / 2]);
      light_.spread[s] = rho * (light_.open[s] == kAllOpen ? *high - *low : *high);
      if (lamps.has_middle[s] != 0) light_.middle_off[s] = std::abs(lum(at_corners) - middle);
      light_.uneven[s] = kCurved * light_.spread[s] + rho * light_.middle_off[s];
    }
    light_.variance = pooled_variance(looks_, points.plane);
    for (std::size_t i = 0; i < points.size(); ++i) {
      light_.variance[i] += lamp_scale * lamp_scale * lamps.corner[i].variance;
    }
  }

  const CornerProblem& problem_;
  const PointGather& gather_;
  std::span<const std::uint8_t> is_lit_;
  CornerLight light_;
  std::vector<PointGather::Looks> looks_;  ///< [point]
  std::vector<Rgb> gathered_;              ///< [point], by rows
  std::vector<Rgb> steady_;                ///< [element side], mean that no sweep changes, lux
  std::vector<Rgb> change_;  ///< [element side], of the sweep before; empty: begin anew
};

}  // namespace

/// Which lamps any corner of a plane has in sight, by the rays of its rows.
class LampsInSight {
 public:
  LampsInSight(const SidePoints& points, const EmitterLight& lamps, const PointGather& gather,
               std::span<const std::uint8_t> is_lit)
      : lamps_(lamps.size()), seen_(points.planes * lamps_) {
    gather.for_rows(is_lit, [&](std::size_t i, std::size_t, const FormFactorRow& row) {
      for (const FormFactor& f : row) {
        const std::uint32_t lamp = lamps.lamp_of(f.side / 2);
        if (lamp == EmitterLight::kNoLamp) continue;
        std::atomic_ref(seen_[points.plane[i] * lamps_ + lamp]).store(1, std::memory_order_relaxed);
      }
    });
  }
  std::span<const std::uint8_t> of_plane(std::uint32_t plane) const {
    return std::span(seen_).subspan(plane * lamps_, lamps_);
  }

 private:
  std::size_t lamps_;
  std::vector<std::uint8_t> seen_;
};

LampsOnMesh lamps_on_mesh(const ElementMesh& mesh, const SurfaceLight& surfaces,
                          const SidePoints& points, const EmitterLight& lamps,
                          const PointGather& gather, std::span<const std::uint8_t> is_lit,
                          double lift_m, int rays) {
  LampsOnMesh found;
  found.corner.resize(points.size());
  found.left_to_rows.resize(points.size());
  found.middle.resize(mesh.sides());
  found.has_middle.assign(mesh.sides(), 1);
  if (!surfaces.any_emits) return found;
  if (lamps.is_any()) {
    const LampsInSight in_sight(points, lamps, gather, is_lit);
    const auto light_at = [&](Vec3 position, Vec3 normal, std::uint32_t plane) {
      return lamps.at(position + lift_m * normal, normal, rays, in_sight.of_plane(plane));
    };
    parallel_for(points.size(), kGrain, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        if (is_lit[i] == 0) continue;
        found.corner[i] =
            light_at(points.sensors.position[i], points.sensors.normal[i], points.plane[i]);
      }
    });
    parallel_for(mesh.sides(), kGrain, [&](IndexRange range) {
      for (std::size_t s = range.begin; s < range.end; ++s) {
        const auto& corner = points.corner[s];
        if (is_lit[corner[0]] == 0) continue;
        const auto middle = light_at(mesh.centre(s / 2), mesh.normal(s), points.plane[corner[0]]);
        found.middle[s] = middle.lux;
        for (const std::uint32_t i : corner) {
          found.has_middle[s] &= found.corner[i].lamp == middle.lamp;
        }
      }
    });
  }
  gather.for_rows(is_lit, [&](std::size_t i, std::size_t look, const FormFactorRow& row) {
    found.left_to_rows[i][look] = emission_left_to_row(surfaces, lamps, found.corner[i], row);
  });
  return found;
}

CornerLight solve_at_corners(const CornerProblem& problem, const PointGather& gather,
                             CornerLight start, std::span<const std::uint8_t> is_lit,
                             Progress& progress) {
  return CornerSolver(problem, gather, std::move(start), is_lit).solve(progress);
}

std::vector<double> mesh_errors_lux(const CornerLight& light, const PointGather& gather,
                                    std::span<const std::uint8_t> is_lit) {
  std::vector<std::array<double, PointGather::kLooks>> of_look(is_lit.size());
  const std::vector<MeshDoubt> doubts = mesh_doubts(light);
  gather.for_rows(is_lit, [&](std::size_t i, std::size_t look, const FormFactorRow& row) {
    of_look[i][look] = mesh_error_lux(row, doubts);
  });
  std::vector<double> errors;
  errors.reserve(of_look.size());
  for (const auto& [one, other] : of_look) errors.push_back(0.5 * (one + other));
  return errors;
}

std::vector<MeshDoubt> mesh_doubts(const CornerLight& light) {
  std::vector<MeshDoubt> doubts;
  doubts.reserve(light.spread.size());
  for (std::size_t s = 0; s < light.spread.size(); ++s) {
    doubts.push_back({static_cast<float>(kNear * light.spread[s]),
                      static_cast<float>(kDoubt * light.uneven[s])});
  }
  return doubts;
}

double mesh_error_lux(const FormFactorRow& row, std::span<const MeshDoubt> of_side) {
  float sum = 0.0F;
  for (const FormFactor& f : row) {
    const float wide = f.value / (f.value + kWideView);
    sum += f.value * (wide * of_side[f.side].near + of_side[f.side].anywhere);
  }
  return static_cast<double>(sum);
}

std::vector<double> pooled_variance(std::span<const PointGather::Looks> looks,
                                    std::span<const std::uint32_t> group) {
  const std::uint32_t groups =
      group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
  std::vector<double> squares(groups), values(groups), variance;
  const auto draw = [&](std::size_t i) { return 0.5 * (lum(looks[i][0]) - lum(looks[i][1])); };
  for (std::size_t i = 0; i < looks.size(); ++i) {
    squares[group[i]] += std::pow(draw(i), 2);
    values[group[i]] += std::pow(lum(mean_of(looks[i])), 2);
  }
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const double share = values[group[i]] > 0.0 ? squares[group[i]] / values[group[i]] : 0.0;
    const double usual = share * std::pow(lum(mean_of(looks[i])), 2);
    variance.push_back(std::max(usual, 0.5 * (usual + std::pow(draw(i), 2))));
  }
  return variance;
}

std::vector<EmitterLight::Direct> light_of_lamps(const EmitterLight& lamps, const Sensors& sensors,
                                                 std::span<const std::uint8_t> is_wanted,
                                                 double lift_m, int rays) {
  std::vector<EmitterLight::Direct> light(sensors.size());
  if (!lamps.is_any()) return light;
  parallel_for(sensors.size(), kGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (is_wanted[i] == 0) continue;
      const Vec3 normal = sensors.normal[i];
      light[i] = lamps.at(sensors.position[i] + lift_m * normal, normal, rays);
    }
  });
  return light;
}

Rgb emission_left_to_row(const SurfaceLight& surfaces, const EmitterLight& lamps,
                         const EmitterLight::Direct& known, const FormFactorRow& row) {
  Rgb sum;
  for (const FormFactor& f : row) {
    const std::uint32_t e = f.side / 2;
    if (!surfaces.emits(e) || known.has(lamps.lamp_of(e))) continue;
    sum = sum + f.value * surfaces.emission_lm_m2[e];
  }
  return sum;
}

std::vector<Rgb> reflected_part(const SurfaceLight& surfaces, std::span<const Rgb> radiosity) {
  std::vector<Rgb> reflected(radiosity.begin(), radiosity.end());
  for (std::size_t s = 0; s < reflected.size(); ++s) {
    reflected[s] = reflected[s] + -1.0 * surfaces.emission_lm_m2[s / 2];
  }
  return reflected;
}

}  // namespace tenku
