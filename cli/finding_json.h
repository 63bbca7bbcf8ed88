/// Findings in the summaries of `--json`. Private to this module.
#pragma once

#include <nlohmann/json.hpp>

#include "core/finding.h"

namespace tenku {

inline nlohmann::ordered_json json_of(const Finding& finding) {
  return {{"code", finding.code},     {"severity", name_of(finding.severity)},
          {"object", finding.object}, {"where", finding.where},
          {"what", finding.what},     {"repair", finding.repair},
          {"count", finding.count}};
}

}  // namespace tenku
