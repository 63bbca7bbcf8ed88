#include "study/work_plane.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"

namespace tenku {
namespace {

constexpr double kMostSensors = 1e6;

void check(double height, double spacing_m, Vec3 size) {
  if (!std::isfinite(height)) throw InputError("--work-plane is a height in metres");
  if (!(spacing_m > 0.0)) throw InputError("--spacing must be positive");
  if (!((size.x / spacing_m + 1.0) * (size.y / spacing_m + 1.0) <= kMostSensors)) {
    throw InputError("a work plane with a spacing of " + std::to_string(spacing_m) +
                     " m has over a million sensors");
  }
}

}  // namespace

Sensors work_plane(const LitScene& lit, double height, double spacing_m) {
  const Extent extent = lit.extent();
  const Vec3 size = extent.size();
  check(height, spacing_m, size);
  const auto steps = [&](double x) {
    return std::max(1, static_cast<int>(std::lround(x / spacing_m)));
  };
  const int columns = steps(size.x), rows = steps(size.y);
  const Vec3 origin = lit.scene().frame.origin();
  const double z = lit.scene().frame.to_local({origin.x, origin.y, height}).z;
  Sensors over_floor, in_room;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vec3 at{extent.min.x + (i + 0.5) * size.x / columns,
                    extent.min.y + (j + 0.5) * size.y / rows, z};
      if (!lit.rays().is_occluded(at, -kZenith)) continue;
      over_floor.position.push_back(at);
      if (lit.rays().is_occluded(at, kZenith)) in_room.position.push_back(at);
    }
  }
  Sensors plane = in_room.size() > 0 ? std::move(in_room) : std::move(over_floor);
  if (plane.size() == 0) {
    throw InputError("no part of the work plane at " + std::to_string(height) +
                     " m has a floor below it");
  }
  plane.normal.assign(plane.position.size(), kZenith);
  return plane;
}

}  // namespace tenku
