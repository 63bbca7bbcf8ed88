#include "illuminance/cell_side.h"

#include <algorithm>
#include <cmath>

namespace tenku {

Vec3 uniform_vector(const SkyCell& cell) {
  const auto primitive = [](double s) {
    const double held = std::min(1.0, s);
    return 0.5 * (held * std::sqrt(1.0 - held * held) + std::asin(held));
  };
  const double along = primitive(cell.sine_to) - primitive(cell.sine_from);
  const double up = 0.5 * (cell.sine_to * cell.sine_to - cell.sine_from * cell.sine_from);
  return {along * (std::cos(cell.azimuth_from) - std::cos(cell.azimuth_to)),
          along * (std::sin(cell.azimuth_to) - std::sin(cell.azimuth_from)),
          up * (cell.azimuth_to - cell.azimuth_from)};
}

/// At one azimuth the cosine of incidence is a sinusoid of the altitude: over a quarter turn it
/// keeps the sign that it has at both ends. Of the azimuths the nearest to that of the normal and
/// the farthest from it count.
Side side_of(const SkyCell& cell, Vec3 normal) {
  constexpr double kRounding = 1e-12;
  const double level = std::hypot(normal.x, normal.y);
  const double half = 0.5 * (cell.azimuth_to - cell.azimuth_from);
  const double turn = cell.azimuth_from + half - std::atan2(normal.x, normal.y);
  const double away = std::abs(std::remainder(turn, 2.0 * kPi));
  const auto cosine = [&](double azimuth, double sine) {
    return level * std::cos(azimuth) * std::sqrt(std::max(0.0, 1.0 - sine * sine)) +
           normal.z * sine;
  };
  const double far = std::min(kPi, away + half), near = std::max(0.0, away - half);
  if (std::min(cosine(far, cell.sine_from), cosine(far, cell.sine_to)) > -kRounding) {
    return Side::Front;
  }
  const double most = std::max(cosine(near, cell.sine_from), cosine(near, cell.sine_to));
  return most < kRounding ? Side::Behind : Side::Both;
}

}  // namespace tenku
