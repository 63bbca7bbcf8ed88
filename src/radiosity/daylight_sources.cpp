#include "radiosity/daylight_sources.h"

namespace tenku {
namespace {

constexpr std::uint32_t kNowhere = ~0U;

/// The sensors of open points and open sides.
struct OpenSensors {
  Sensors sensors;
  std::vector<std::uint32_t> of_point, of_side;  ///< place in `sensors`, or kNowhere

  void add(std::vector<std::uint32_t>& place, std::size_t i, Vec3 position, Vec3 normal) {
    place[i] = static_cast<std::uint32_t>(sensors.size());
    sensors.position.push_back(position);
    sensors.normal.push_back(normal);
  }
};

OpenSensors open_sensors(const ElementMesh& mesh, const SidePoints& points,
                         std::span<const std::uint8_t> is_open) {
  OpenSensors open;
  open.of_point.assign(points.size(), kNowhere);
  open.of_side.assign(mesh.sides(), kNowhere);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_open[i] == 0) continue;
    open.add(open.of_point, i, points.sensors.position[i], points.sensors.normal[i]);
  }
  for (std::size_t s = 0; s < mesh.sides(); ++s) {
    const auto& [a, b, c] = points.corner[s];
    if (is_open[a] + is_open[b] + is_open[c] == 0) continue;
    open.add(open.of_side, s, mesh.centre(s / 2), mesh.normal(s));
  }
  return open;
}

}  // namespace

DaylightOnSides daylight_on_sides(const ElementMesh& mesh, const SidePoints& points,
                                  std::span<const std::uint8_t> is_open,
                                  const DaylightMethod& daylight, KeptDaylight& kept,
                                  Progress& progress) {
  DaylightOnSides result(points.size(), mesh.sides());
  const OpenSensors open = open_sensors(mesh, points, is_open);
  if (open.sensors.size() == 0) return result;
  IlluminanceResult found = kept.light(open.sensors, daylight, progress);
  const SensorIlluminance& lit = found.values;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t k = open.of_point[i];
    if (k == kNowhere) continue;
    result.points.sun_lux[i] = lit.sun_lux[k];
    result.points.sky_lux[i] = lit.sky_lux[k];
    result.points.error_lux[i] = lit.error_lux[k];
    result.points.sky_view[i] = lit.sky_view[k];
  }
  for (std::size_t s = 0; s < mesh.sides(); ++s) {
    if (open.of_side[s] == kNowhere) continue;
    double corners = 0.0;
    for (const std::uint32_t i : points.corner[s]) corners += result.points.total_lux(i) / 3.0;
    const double middle = lit.total_lux(open.of_side[s]);
    result.lux[s] = 0.25 * corners + 0.75 * middle;
    result.middle_lux[s] = middle;
  }
  result.rays = found.rays;
  result.sensors = open.sensors.size();
  result.out_of_tolerance = found.out_of_tolerance;
  // Many sides are dark, and their errors are part of the result's.
  std::erase_if(found.findings, [](const Finding& f) {
    return f.code == "no_light" || f.code == "tolerance_not_reached";
  });
  result.findings = std::move(found.findings);
  return result;
}

}  // namespace tenku
