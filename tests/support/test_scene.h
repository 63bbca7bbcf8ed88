/// Scenes built in code, and their illuminance in one call.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "illuminance/illuminate.h"
#include "sky_models/cie_general_sky.h"
#include "sky_models/cie_overcast_sky.h"
#include "sky_models/uniform_sky.h"

namespace tenku::testing_support {

inline Material black_material() {
  Material material;
  material.name = "black";
  material.reflectance = {};
  return material;
}

inline Material grey_material(double reflectance) {
  Material material;
  material.name = "grey";
  material.reflectance = Rgb::grey(reflectance);
  return material;
}

/// Triangles put together by hand. Each call below adds to the object last begun.
class TestScene {
 public:
  TriangleSoup soup;
  std::vector<Material> materials{black_material()};

  void begin_object() { ++object_; }

  void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d, std::uint32_t material = 0) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), {a, b, c, d});
    triangle({first, first + 1, first + 2}, material);
    triangle({first, first + 2, first + 3}, material);
  }

  /// Upright rectangle over the line from (x0, y0) to (x1, y1).
  void wall(std::array<double, 4> line, double z0, double z1, std::uint32_t material = 0) {
    const auto [x0, y0, x1, y1] = line;
    quad({x0, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x0, y0, z1}, material);
  }

  /// Level rectangle, facing up.
  void level(std::array<double, 4> x0_y0_x1_y1, double z, std::uint32_t material = 0) {
    const auto [x0, y0, x1, y1] = x0_y0_x1_y1;
    quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}, material);
  }

  /// Box of its own object on the level z0, turned counter-clockwise about (x0, y0).
  void box(Vec3 corner, Vec3 size, double turn_deg = 0.0, std::uint32_t material = 0) {
    begin_object();
    const double c = std::cos(turn_deg * kPi / 180.0), s = std::sin(turn_deg * kPi / 180.0);
    const auto at = [&](double x, double y, double z) {
      return corner + Vec3{c * x - s * y, s * x + c * y, z};
    };
    const auto [w, d, h] = size;
    quad(at(0, 0, h), at(w, 0, h), at(w, d, h), at(0, d, h), material);
    quad(at(0, 0, 0), at(0, d, 0), at(w, d, 0), at(w, 0, 0), material);
    quad(at(0, 0, 0), at(w, 0, 0), at(w, 0, h), at(0, 0, h), material);
    quad(at(w, 0, 0), at(w, d, 0), at(w, d, h), at(w, 0, h), material);
    quad(at(w, d, 0), at(0, d, 0), at(0, d, h), at(w, d, h), material);
    quad(at(0, d, 0), at(0, 0, 0), at(0, 0, h), at(0, d, h), material);
  }

 private:
  void triangle(std::array<std::uint32_t, 3> corners, std::uint32_t material) {
    soup.triangles.push_back(corners);
    soup.object.push_back(object_);
    soup.surface_type.push_back(SurfaceType::Unknown);
    soup.material.push_back(material);
  }

  std::uint32_t object_ = 0;
};

/// Sky by its number in ISO 15469; 16 is the traditional overcast one.
inline std::unique_ptr<SkyModel> numbered_sky(int type, double sun_altitude_deg,
                                              double sun_azimuth_deg) {
  if (type == 16) return std::make_unique<CieOvercastSky>(Luminance(3000.0));
  return std::make_unique<CieGeneralSky>(
      type, direction_from(Angle::degrees(sun_azimuth_deg), Angle::degrees(sun_altitude_deg)),
      Luminance(3000.0));
}

inline DaylightSource source_of(const SkyModel& sky) {
  DaylightSource source;
  source.sky = std::make_unique<SkyTable>(sky);
  return source;
}

inline IlluminanceResult illuminate(const TestScene& scene, const Sensors& sensors,
                                    const DaylightSource& source,
                                    const IlluminanceOptions& options) {
  const RayVisibility rays(scene.soup, scene.materials);
  Progress quiet;
  return illuminate(sensors, rays, source, options, quiet);
}

/// Options for light straight from the sky and the sun.
inline IlluminanceOptions direct_options(double tolerance_pct, std::uint64_t seed = 1) {
  IlluminanceOptions options;
  options.tolerance_pct = tolerance_pct;
  options.bounces = 0;
  options.seed = seed;
  return options;
}

inline IlluminanceOptions with_bounces(double tolerance_pct, int bounces) {
  IlluminanceOptions options = direct_options(tolerance_pct);
  options.bounces = bounces;
  return options;
}

/// How many values lie in their intervals.
class Coverage {
 public:
  void add(double value, double truth, double interval) {
    ++count_;
    inside_ += std::abs(value - truth) <= interval;
  }
  double pct() const { return 100.0 * static_cast<double>(inside_) / static_cast<double>(count_); }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0, inside_ = 0;
};

}  // namespace tenku::testing_support
