#include "illuminance/element_sky.h"

#include <algorithm>
#include <cmath>

#include "core/low_discrepancy.h"

namespace tenku {
namespace {

constexpr double kUnseen = 0.5;  // elements that are cut where both directions do not tell

/// Integral of the direction over a cell.
///
/// Source   with s the sine of the altitude: integral of sqrt(1 - s^2) ds, of the sine and the
///          cosine of the azimuth, of s ds.
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

/// Where a cell lies to the plane of a sensor.
enum class Side { Front, Behind, Both };

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

}  // namespace

ElementSky::ElementSky(const SkyModel& sky, const SkyPartition& partition)
    : sky_(sky), description_(partition.description) {
  for (const SkyElement& e : partition.elements) {
    elements_.push_back({e.cell, e.solid_angle, e.illuminance_vector, uniform_vector(e.cell)});
  }
}

ElementSky::Light ElementSky::light(const Visibility& visibility, Vec3 origin, Vec3 normal,
                                    SampleRandom random) const {
  const std::uint64_t scramble = random.bits();
  std::vector<std::size_t> in_front;
  std::vector<Vec3> directions;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const SkyCell& cell = elements_[e].cell;
    if (side_of(cell, normal) == Side::Behind) continue;
    in_front.push_back(e);
    for (const unsigned look : {0U, 2U}) {
      const auto index = static_cast<std::uint32_t>(e);
      directions.push_back(
          cell.direction(sobol_owen(index, look, scramble), sobol_owen(index, look + 1, scramble)));
    }
  }
  const std::vector<Vec3> origins(directions.size(), origin);
  std::vector<float> seen(directions.size());
  visibility.transmission(origins, directions, seen);
  Light sum;
  sum.rays = directions.size();
  double squares = 0.0;
  for (std::size_t k = 0; k < in_front.size(); ++k) {
    const double whole = std::max(0.0, dot(normal, elements_[in_front[k]].luminous));
    squares += whole * whole;
    add(sum, elements_[in_front[k]], normal,
        {Look{directions[2 * k], seen[2 * k]}, Look{directions[2 * k + 1], seen[2 * k + 1]}});
  }
  if (!in_front.empty()) {
    sum.variance += kUnseen * 0.25 * squares / static_cast<double>(in_front.size());
  }
  return sum;
}

void ElementSky::add(Light& sum, const Element& element, Vec3 normal,
                     const std::array<Look, 2>& looks) const {
  const auto& [one, two] = looks;
  const bool is_whole = side_of(element.cell, normal) == Side::Front;
  const double both = 0.5 * (one.seen + two.seen), half_gap = 0.5 * (one.seen - two.seen);
  const double cos_one = element.solid_angle * std::max(0.0, dot(normal, one.direction));
  const double cos_two = element.solid_angle * std::max(0.0, dot(normal, two.direction));
  if (is_whole && half_gap == 0.0) {
    sum.lux += both * dot(normal, element.luminous);
    sum.sky_view += both * dot(normal, element.uniform) / kPi;
    return;
  }
  const double g1 = cos_one * sky_.luminance(one.direction).value();
  const double g2 = cos_two * sky_.luminance(two.direction).value();
  if (!is_whole) {
    const double lux_one = g1 * one.seen, lux_two = g2 * two.seen;
    sum.lux += 0.5 * (lux_one + lux_two);
    sum.variance += 0.25 * (lux_one - lux_two) * (lux_one - lux_two);
    sum.sky_view += 0.5 * (cos_one * one.seen + cos_two * two.seen) / kPi;
    return;
  }
  sum.lux += both * dot(normal, element.luminous) + half_gap * (g1 - g2);
  sum.variance +=
      half_gap * half_gap * (0.25 * (g1 + g2) * (g1 + g2) + 0.5 * (g1 - g2) * (g1 - g2));
  sum.sky_view += (both * dot(normal, element.uniform) + half_gap * (cos_one - cos_two)) / kPi;
}

}  // namespace tenku
