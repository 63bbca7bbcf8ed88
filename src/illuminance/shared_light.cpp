#include "illuminance/shared_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tenku {
namespace {

constexpr double kLeastScale = 5e-4;  // of the unobstructed light: what no outline tells
constexpr double kUnmet = 0.5;        // of an element: what may hide part of it and no other

}  // namespace

SharedLight shared_light(const Visibility& sky_engine, const Visibility& sun_engine,
                         const Sensors& at, const DaylightSource& source,
                         const SharedElements& elements, int sun_directions, Progress& progress,
                         const SharedElements::Wanted* wanted) {
  SharedLight result;
  result.sun_lux.resize(at.size());
  result.sky_lux.resize(at.size());
  result.sky_view.resize(at.size());
  result.scale_lux.assign(at.size(), kLeastScale * source.unobstructed_lux());
  if (elements.count() > 0) {
    auto light = elements.light(sky_engine, at, progress, wanted);
    result.sky_lux = std::move(light.lux);
    result.sky_view = std::move(light.sky_view);
    for (std::size_t s = 0; s < at.size(); ++s) {
      result.scale_lux[s] =
          std::hypot(result.scale_lux[s], light.outline_lux[s], kUnmet * light.element_lux[s]);
    }
  }
  if (sun_directions == 0) return result;
  result.sun_lux = shared_sun_lux(sun_engine, at, source.sun, sun_directions);
  const double uncertain = 0.4 / std::pow(sun_directions, 0.75);
  for (std::size_t s = 0; s < at.size(); ++s) {
    const double whole = source.sun.normal_illuminance.value() *
                         std::max(0.0, dot(at.normal[s], source.sun.direction));
    const bool is_partly = result.sun_lux[s] > 1e-6 * whole && result.sun_lux[s] < 0.999 * whole;
    if (is_partly) result.scale_lux[s] = std::hypot(result.scale_lux[s], uncertain * whole);
  }
  return result;
}

}  // namespace tenku
