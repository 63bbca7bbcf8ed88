#include "illuminance/sensor_regions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/extent.h"

namespace tenku {
namespace {

constexpr std::size_t kMostParts = 64;

/// A part and the box about it.
struct Part {
  std::vector<std::uint32_t> sensor;
  Extent box;

  Part(std::vector<std::uint32_t> chosen, const Sensors& sensors) : sensor(std::move(chosen)) {
    for (const std::uint32_t s : sensor) box.add(sensors.position[s]);
  }
};

}  // namespace

std::vector<std::uint32_t> all_of(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

Parts split_by_extent(const Sensors& sensors, double most_m, double alone_m) {
  std::vector<Part> parts{Part(all_of(sensors.size()), sensors)};
  while (parts.size() < kMostParts) {
    const auto excess = [&](const Part& part) {
      const double few_m = alone_m * std::sqrt(static_cast<double>(part.sensor.size()));
      return part.box.longest_side() / std::min(most_m, few_m);
    };
    const auto widest =
        std::max_element(parts.begin(), parts.end(),
                         [&](const Part& a, const Part& b) { return excess(a) < excess(b); });
    const Extent box = widest->box;
    if (!(excess(*widest) > 1.0)) break;
    const bool by_x = box.size().x >= box.size().y;
    const auto place = [&](std::uint32_t s) {
      return by_x ? sensors.position[s].x : sensors.position[s].y;
    };
    const double middle = by_x ? box.middle().x : box.middle().y;
    auto& all = widest->sensor;
    const auto cut = std::stable_partition(all.begin(), all.end(),
                                           [&](std::uint32_t s) { return place(s) < middle; });
    if (cut == all.begin() || cut == all.end()) break;  // one above the other
    Part low({all.begin(), cut}, sensors), high({cut, all.end()}, sensors);
    *widest = std::move(low);
    parts.push_back(std::move(high));
  }
  Parts made;
  for (Part& part : parts) made.push_back(std::move(part.sensor));
  return made;
}

Parts split_by_distance(const Sensors& sensors, Vec3 eye) {
  std::vector<std::uint32_t> order = all_of(sensors.size());
  const auto away = [&](std::uint32_t s) { return length(sensors.position[s] - eye); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return away(a) < away(b); });
  const auto half = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
  Parts parts{{order.begin(), half}, {half, order.end()}};
  for (auto& part : parts) std::sort(part.begin(), part.end());
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  return parts;
}

}  // namespace tenku
