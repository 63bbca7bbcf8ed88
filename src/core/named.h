/// Values by the names that users give them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/suggest.h"

namespace tenku {

/// The value beside a name.
/// @param what  the kind of name, for the message
/// @throws InputError for a name that is not there, with the one that may be meant
template <class Value, std::size_t count>
Value named(std::string_view name, const std::array<std::pair<std::string_view, Value>, count>& all,
            const char* what) {
  std::vector<std::string_view> known;
  for (const auto& [one, value] : all) {
    if (one == name) return value;
    known.push_back(one);
  }
  throw InputError("there is no " + std::string(what) + " '" + std::string(name) + "'" +
                   suggestion(name, known));
}

}  // namespace tenku
