#include "core/error.h"

#include <cstdio>
#include <cstdlib>

namespace tenku {

void expects(bool condition, std::string_view what, const char* file, int line) {
  if (condition) return;
  std::fprintf(stderr, "tenku: expected that %.*s (%s:%d). This is a mistake in tenku.\n",
               static_cast<int>(what.size()), what.data(), file, line);
  std::abort();
}

}  // namespace tenku
