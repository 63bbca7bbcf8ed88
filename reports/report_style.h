/// How the report looks, on a screen and on A4 paper.
#pragma once

#include <string_view>

namespace tenku {

/// Style sheet of the report.
std::string_view report_style();

}  // namespace tenku
