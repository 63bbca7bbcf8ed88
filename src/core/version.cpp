#include "core/version.h"

namespace tenku {

std::string_view software_name() { return "tenku " TENKU_VERSION; }

}  // namespace tenku
