#include "illuminance/daylight_source.h"

#include <algorithm>

namespace tenku {

double DaylightSource::unobstructed_lux() const {
  const double from_sun = sun.normal_illuminance.value() * std::max(0.0, sun.direction.z);
  return (sky ? sky->horizontal_lux() : 0.0) + from_sun;
}

DaylightSource daylight_of(const Sky& sky) {
  DaylightSource source;
  if (sky.model) source.sky = std::make_unique<SkyTable>(*sky.model);
  source.sun = sky.sun;
  source.model = sky.model.get();
  return source;
}

}  // namespace tenku
