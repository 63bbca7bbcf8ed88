#include "illuminance/daylight_source.h"

#include <algorithm>
#include <cmath>

namespace tenku {

namespace {

/// Mean sine of the altitude over a disc, zero below the horizon: of chords along the horizon.
double mean_sine(const SolarDisc& disc) {
  const double radius = std::sin(disc.angular_radius.in_radians());
  if (!(radius > 0.0) || disc.direction.z >= radius) return std::max(0.0, disc.direction.z);
  const double x = std::max(-1.0, disc.direction.z / radius), root = std::sqrt(1.0 - x * x);
  return radius / kPi *
         (x * (0.5 * kPi + std::asin(x) + x * root) + 2.0 / 3.0 * root * root * root);
}

}  // namespace

double DaylightSource::unobstructed_lux() const {
  const double from_sun = sun.normal_illuminance.value() * mean_sine(sun);
  return (sky ? sky->horizontal_lux() : 0.0) + from_sun;
}

DaylightSource daylight_of(const Sky& sky, const std::optional<PartitionRequest>& partition) {
  DaylightSource source;
  if (sky.model) source.sky = std::make_unique<SkyTable>(*sky.model);
  source.sun = sky.sun;
  source.model = sky.model.get();
  if (sky.model && partition) {
    source.elements =
        std::make_unique<ElementSky>(*sky.model, partition_sky(*sky.model, *partition));
  }
  source.partition = partition;
  return source;
}

}  // namespace tenku
