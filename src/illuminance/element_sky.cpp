#include "illuminance/element_sky.h"

#include <algorithm>
#include <cmath>

#include "core/low_discrepancy.h"
#include "illuminance/cell_side.h"

namespace tenku {
namespace {

constexpr double kUnseen = 0.5;  // elements that are cut where both directions do not tell

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
