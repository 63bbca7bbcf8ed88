/// Findings in the summaries of `--json`. Private to this module.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/finding.h"

namespace tenku {

inline nlohmann::ordered_json json_of(const Finding& finding) {
  return {{"code", finding.code},     {"severity", name_of(finding.severity)},
          {"object", finding.object}, {"where", finding.where},
          {"what", finding.what},     {"repair", finding.repair},
          {"count", finding.count}};
}

inline nlohmann::ordered_json json_of(const std::vector<Finding>& findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) list.push_back(json_of(finding));
  return list;
}

}  // namespace tenku
