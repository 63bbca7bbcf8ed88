#include "flythrough/store_lighting.h"

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr int kColumns = 360, kRows = 91;
constexpr double kGroundReflectance = 0.2;  // as render_view has it

SkyMap map_of(const SkyModel& model) {
  SkyMap map{kColumns, kRows, {}};
  map.pixels.resize(std::size_t{kColumns} * kRows);
  parallel_for(kRows, 4, [&](IndexRange range) {
    for (std::size_t r = range.begin; r < range.end; ++r) {
      const Angle altitude = Angle::degrees(static_cast<double>(r) * 90.0 / (kRows - 1));
      for (std::size_t c = 0; c < kColumns; ++c) {
        const Angle azimuth = Angle::degrees(static_cast<double>(c) * 360.0 / kColumns);
        map.pixels[r * kColumns + c] = model.colour(direction_from(azimuth, altitude));
      }
    }
  });
  return map;
}

}  // namespace

StoreLighting lighting_of(const Sky& sky, const DaylightSource& source, const std::string& time) {
  StoreLighting lighting;
  lighting.time = time;
  lighting.sky = sky.description;
  lighting.sun_normal_lux = source.sun.normal_illuminance.value();
  if (lighting.sun_normal_lux > 0.0) lighting.sun_direction = source.sun.direction;
  lighting.horizontal_lux = source.unobstructed_lux();
  lighting.white_cd_m2 = lighting.horizontal_lux / kPi;
  lighting.below_horizon = Rgb::grey(kGroundReflectance * lighting.horizontal_lux / kPi);
  if (sky.model) lighting.sky_map = map_of(*sky.model);
  return lighting;
}

}  // namespace tenku
