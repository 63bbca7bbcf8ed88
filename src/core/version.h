/// The version of this program, as results and reports record it.
#pragma once

#include <string_view>

namespace tenku {

/// `tenku 0.1.0`.
std::string_view software_name();

}  // namespace tenku
