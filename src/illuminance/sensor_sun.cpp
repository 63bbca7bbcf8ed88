#include "illuminance/sensor_sun.h"

#include <algorithm>
#include <cmath>

#include "core/low_discrepancy.h"

namespace tenku {

Vec3 direction_on_disc(const SolarDisc& sun, const TangentFrame& frame, double u, double v) {
  const double radius = std::tan(sun.angular_radius.in_radians()) * std::sqrt(u);
  const double turn = 2.0 * kPi * v;
  return normalized(sun.direction + radius * std::cos(turn) * frame.tangent +
                    radius * std::sin(turn) * frame.bitangent);
}

SensorSun::SensorSun(const RayVisibility& rays, const SolarDisc& sun, Vec3 position, Vec3 normal,
                     std::uint64_t scramble)
    : rays_(rays),
      sun_(sun),
      origin_(position + rays.lift_m() * normal),
      normal_(normal),
      frame_(tangent_frame(sun.direction)),
      scramble_(scramble),
      settled_(!(sun.normal_illuminance > Illuminance(0.0)) ||
               dot(normal, sun.direction) < -std::sin(sun.angular_radius.in_radians()) ||
               sun.direction.z < -std::sin(sun.angular_radius.in_radians())) {}

bool SensorSun::is_in_front(Vec3 direction) const {
  return dot(normal_, direction) > 0.0 && direction.z > 0.0;
}

void SensorSun::refine() {
  if (settled_) return;
  if (sent_ == 0) {
    ask_rim();
    if (settled_) return;
  }
  const std::uint32_t goal = sent_ == 0 ? kFirstRays : 2 * sent_;
  for (; sent_ < goal; ++sent_) {
    const Vec3 direction = direction_on_disc(sun_, frame_, sobol_owen(sent_, 0, scramble_),
                                             sobol_owen(sent_, 1, scramble_));
    if (!is_in_front(direction)) continue;
    const double cosine = dot(normal_, direction);
    whole_ += cosine;
    ++rays_sent_;
    if (rays_.is_occluded(origin_, direction)) continue;
    seen_ += cosine;
    lit_ += cosine * rays_.glass_transmission(origin_, direction);
  }
  const double n = sent_, normal_lux = sun_.normal_illuminance.value();
  lux_ = normal_lux * lit_ / n;
  const double seen = whole_ > 0.0 ? seen_ / whole_ : 0.0;
  const double chord = std::cbrt(4.0 * std::max(seen, 1.0 / n) * std::max(1.0 - seen, 1.0 / n));
  variance_ = std::pow(normal_lux * whole_ / n, 2) * 0.19 / std::pow(n, 1.5) * chord;
}

void SensorSun::ask_rim() {
  constexpr double kRim = 1.0 - 1e-9;
  const double turn = sobol_owen(0, 2, scramble_);
  unsigned visible = 0, in_front = 0;
  for (unsigned k = 0; k < kRimRays; ++k) {
    const double v = turn + static_cast<double>(k) / kRimRays;
    const Vec3 direction = direction_on_disc(sun_, frame_, kRim, v);
    if (!is_in_front(direction)) continue;
    ++in_front;
    ++rays_sent_;
    if (!rays_.is_occluded(origin_, direction)) ++visible;
  }
  settled_ = visible == 0 || visible == kRimRays;
  if (in_front < kRimRays && visible > 0) settled_ = false;
  if (!settled_ || visible == 0) return;
  lux_ = sun_.normal_illuminance.value() * dot(normal_, sun_.direction) *
         rays_.glass_transmission(origin_, sun_.direction);
}

}  // namespace tenku
