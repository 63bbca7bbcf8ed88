/// Plans in words and as JSON. Private to this module.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "illuminance/planned_region.h"

namespace tenku {

/// One object a region; numbers that were not estimated or measured are null.
nlohmann::ordered_json json_of(const std::vector<PlannedRegion>& regions);

/// A table for people: one line a region, and what is left out of each.
std::string table_of(const std::vector<PlannedRegion>& regions);

}  // namespace tenku
