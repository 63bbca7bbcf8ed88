// Parts of sensors that share maps.
#include "illuminance/sensor_regions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/extent.h"

namespace tenku {
namespace {

constexpr double kMost_m = 2048.0, kAlone_m = 256.0;

/// On a square of `side` m.
Sensors square(std::size_t count, double side) {
  Sensors sensors;
  for (std::size_t y = 0; y < count; ++y) {
    for (std::size_t x = 0; x < count; ++x) {
      const double step = side / static_cast<double>(count - 1);
      sensors.position.push_back({step * static_cast<double>(x), step * static_cast<double>(y), 0});
      sensors.normal.push_back(kZenith);
    }
  }
  return sensors;
}

TEST(SensorRegions, ManySensorsShareOneMap) {
  EXPECT_EQ(split_by_extent(square(30, 2000.0), kMost_m, kAlone_m).size(), 1u);
}

TEST(SensorRegions, FewFarApartHaveTheirOwn) {
  const Parts parts = split_by_extent(square(3, 2000.0), kMost_m, kAlone_m);
  EXPECT_EQ(parts.size(), 9u);
}

TEST(SensorRegions, NoneIsWiderThanAMapAndAllSensorsAreInOne) {
  const Sensors sensors = square(40, 5000.0);
  const Parts parts = split_by_extent(sensors, kMost_m, kAlone_m);
  std::vector<std::uint32_t> all;
  for (const auto& part : parts) {
    Extent box;
    for (const std::uint32_t s : part) box.add(sensors.position[s]);
    EXPECT_LE(box.longest_side(), kMost_m);
    all.insert(all.end(), part.begin(), part.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, all_of(sensors.size()));
}

}  // namespace
}  // namespace tenku
