#include "illuminance/daylight_source.h"

#include <algorithm>

namespace tenku {

double DaylightSource::unobstructed_lux() const {
  const double from_sun = sun.normal_illuminance.value() * std::max(0.0, sun.direction.z);
  return (sky ? sky->horizontal_lux() : 0.0) + from_sun;
}

}  // namespace tenku
