/// The ways in which a call can refuse. Everything else is a value.
#pragma once

#include <stdexcept>
#include <string_view>

namespace tenku {

/// The caller's data cannot be used: an argument out of range, a malformed file.
/// The message names the offending value and where it came from.
class InputError : public std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Something outside the program failed: a file system, a graphics or ray-tracing device.
class ResourceError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The user asked to stop. Thrown by long loops that see it; nothing half-written is left.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("stopped by the user") {}
};

/// States a condition that only a mistake in this program can break. If it is broken, prints
/// what was expected and where, and aborts. Active in every build type.
void expects(bool condition, std::string_view what, const char* file = __builtin_FILE(),
             int line = __builtin_LINE());

}  // namespace tenku
