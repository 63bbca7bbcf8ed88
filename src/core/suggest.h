/// The word that was meant, for messages about words that nobody knows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tenku {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
///
/// Source   "optimal string alignment" of F. J. Damerau, "A technique for computer detection and
///          correction of spelling errors", CACM 7(3), 1964.
/// Cost     product of the lengths
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `name`, letter case aside; the first of equals. None if even that one
/// differs in more than a third of the letters of the longer (and more than one).
std::optional<std::string_view> closest_name(std::string_view name,
                                             std::span<const std::string_view> candidates);

/// `; did you mean 'tolerance_percent'?`, or nothing where no candidate is near: to be appended.
std::string suggestion(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace tenku
