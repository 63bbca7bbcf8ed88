/// What the user may have meant.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tenku {

/// The known name nearest to `name`, if it is at most three letters (a third of the name) away.
std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string_view> known);

/// `; did you mean 'wall'?`, or nothing if no known name is near.
std::string suggestion(std::string_view name, std::span<const std::string_view> known);

}  // namespace tenku
