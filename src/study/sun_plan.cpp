#include "study/sun_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tenku {
namespace {

constexpr double kSameGround = 0.05;  // m: a patch and the ground of the plan are one

bool holds(const std::vector<Vec3>& corners, double x, double y) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 a = corners[k], b = corners[(k + 1) % corners.size()];
    if ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) < 0.0) return false;
  }
  return true;
}

/// Ground of the plan by squares.
class Squares {
 public:
  Squares(const GroundPlan& plan, SunPlan& result) : plan_(plan), result_(result) {
    height_.assign(plan.grid.values.size(), std::numeric_limits<double>::quiet_NaN());
    result.minutes = result.most_lux = plan.grid;
    for (std::size_t i = 0; i < plan.cell.size(); ++i) {
      height_[plan.cell[i]] = plan.sensors.position[i].z;
      result.minutes.values[plan.cell[i]] = 0.0;
      result.most_lux.values[plan.cell[i]] = 0.0;
    }
  }

  void add(const SunPatch& patch, double minutes) {
    const Extent box = extent_of(patch.corners);
    const auto& c = patch.corners;
    const Vec3 normal = cross(c[1] - c[0], c[2] - c[0]);
    if (!(normal.z > 0.0)) return;  // walls and undersides
    const PlanGrid& grid = plan_.grid;
    const auto clamped = [](double v, int count) {
      return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(count)));
    };
    const int west = clamped(std::floor((box.min.x - grid.west) / grid.cell_m), grid.columns),
              east = clamped(std::ceil((box.max.x - grid.west) / grid.cell_m), grid.columns),
              top = clamped(std::floor((grid.north - box.max.y) / grid.cell_m), grid.rows),
              bottom = clamped(std::ceil((grid.north - box.min.y) / grid.cell_m), grid.rows);
    for (int row = top; row < bottom; ++row) {
      for (int column = west; column < east; ++column) {
        const double x = grid.west + (column + 0.5) * grid.cell_m,
                     y = grid.north - (row + 0.5) * grid.cell_m;
        if (!holds(c, x, y)) continue;
        const double z = c[0].z - (normal.x * (x - c[0].x) + normal.y * (y - c[0].y)) / normal.z;
        const std::size_t k =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
            static_cast<std::size_t>(column);
        if (!(std::abs(height_[k] - z) < kSameGround)) continue;
        if (result_.minutes.values[k] == 0.0 && result_.most_lux.values[k] == 0.0) {
          result_.lit_m2 += grid.cell_m * grid.cell_m;
        }
        result_.minutes.values[k] += minutes;
        result_.most_lux.values[k] = std::max(result_.most_lux.values[k], patch.lux);
      }
    }
  }

 private:
  const GroundPlan& plan_;
  SunPlan& result_;
  std::vector<double> height_;  ///< of the ground in each square
};

}  // namespace

SunPlan sun_plan(const LitScene& lit, const ReflectedSun& sun, double spacing_m) {
  const GroundPlan ground = ground_plan(lit, spacing_m);
  SunPlan plan;
  plan.buildings = ground.buildings;
  Squares squares(ground, plan);
  for (std::size_t m = 0; m < sun.patches.size(); ++m) {
    for (const SunPatch& patch : sun.patches[m]) {
      squares.add(patch, sun.moments[m].step_s / 60.0);
    }
  }
  return plan;
}

}  // namespace tenku
