/// For tests that go on longer where the environment asks for it.
#pragma once

#include <chrono>
#include <cstdlib>

namespace tenku::testing_support {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The number that an environment variable holds.
inline double number_of(const char* variable, double otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtod(text, nullptr);
}

}  // namespace tenku::testing_support
