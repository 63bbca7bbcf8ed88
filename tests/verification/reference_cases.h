/// Obstructed skies whose illuminance is known, put together from the tables in tests/reference.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "support/reference_table.h"
#include "support/test_scene.h"

namespace tenku::testing_support {

/// Sensors of one scene under one sky.
struct ReferenceCase {
  std::string name;
  std::shared_ptr<TestScene> scene;
  std::shared_ptr<DaylightSource> source;
  Sensors sensors;
  std::vector<double> ratio;  ///< [sensor], of the unobstructed horizontal illuminance
};

/// Canyons, overhangs, courtyards, blocks, slabs and boxes.
std::vector<ReferenceCase> obstructed_cases();
/// CIE 171:2006, the sky components of 5.9 to 5.14, and a glazed one of the same kind.
std::vector<ReferenceCase> cie_171_cases();

}  // namespace tenku::testing_support
