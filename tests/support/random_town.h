/// A town of random cuboids for tests.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/random.h"
#include "support/test_scene.h"

namespace tenku::testing_support {

struct Town {
  TestScene scene;
  Sensors sensors;
};

/// Cuboids on a square of ground, sensors on the ground (half) and on walls.
inline Town random_town(int boxes, double side_m, int sensors) {
  Town town;
  SampleRandom random(4711, 0, 0);
  std::vector<std::array<double, 4>> plan;
  town.scene.level({0, 0, side_m, side_m}, 0.0);
  for (int i = 0; i < boxes; ++i) {
    const Vec3 corner{side_m * random.uniform(), side_m * random.uniform(), 0.0};
    const Vec3 size{6.0 + 14.0 * random.uniform(), 6.0 + 14.0 * random.uniform(),
                    3.0 + 40.0 * random.uniform() * random.uniform()};
    town.scene.box(corner, size);
    plan.push_back({corner.x, corner.y, corner.x + size.x, corner.y + size.y});
    if (i >= sensors / 2) continue;
    town.sensors.position.push_back(
        {corner.x, corner.y + size.y * random.uniform(), size.z * random.uniform()});
    town.sensors.normal.push_back({-1.0, 0.0, 0.0});
  }
  while (town.sensors.size() < static_cast<std::size_t>(sensors)) {
    const Vec3 p{side_m * random.uniform(), side_m * random.uniform(), 0.0};
    const bool indoors = std::any_of(plan.begin(), plan.end(), [&](const auto& b) {
      return p.x > b[0] && p.y > b[1] && p.x < b[2] && p.y < b[3];
    });
    if (indoors) continue;
    town.sensors.position.push_back(p);
    town.sensors.normal.push_back(kZenith);
  }
  return town;
}

}  // namespace tenku::testing_support
