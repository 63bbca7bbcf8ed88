/// One table of a study file, read key by key with its checks. Private to this module.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec3.h"

namespace tenku {

/// Numbers that a key may have.
struct NumberRange {
  double low, high;
  bool low_excluded = false;
};

/// A table of a TOML document, or its absence: then every key is absent.
///
/// Messages begin with `FILE:LINE: ` of the value that is wrong.
/// @throws InputError from every reading function, if the value's type or range is wrong
class TomlSection {
 public:
  /// The whole document.
  /// @param text  the content of `file`; `file` is for messages
  /// @throws InputError if it is no TOML
  static TomlSection parse(std::string_view text, const std::string& file);

  /// The table `[name]` in this one; absent if there is none.
  TomlSection table(std::string_view name) const;
  /// The tables `[[name]]` in this one.
  std::vector<TomlSection> tables(std::string_view name) const;

  bool is_there() const;
  bool has(std::string_view key) const;

  std::optional<double> number(std::string_view key, NumberRange range) const;
  std::optional<std::int64_t> integer(std::string_view key, NumberRange range) const;
  std::optional<bool> boolean(std::string_view key) const;
  /// Not empty, and without control characters.
  std::optional<std::string> text(std::string_view key) const;
  /// Text, or a number as it is written in decimal.
  std::optional<std::string> text_or_number(std::string_view key, NumberRange range) const;
  /// Text, or a date with time in TOML's own notation as ISO 8601.
  std::optional<std::string> time(std::string_view key) const;
  /// One of `choices`.
  std::optional<std::string> choice(std::string_view key,
                                    std::span<const std::string_view> choices) const;
  /// Some of `choices`, each at most once, at least one.
  std::optional<std::vector<std::string>> choice_list(
      std::string_view key, std::span<const std::string_view> choices) const;
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count,
                                             NumberRange range) const;
  std::optional<Vec3> point(std::string_view key) const;

  /// @throws InputError if a key is none of `known`; suggests the nearest
  void refuse_unknown_keys(std::span<const std::string_view> known) const;

  /// Throws an InputError at the place of `key`, or of the table where it is absent.
  [[noreturn]] void refuse(std::string_view key, const std::string& what) const;

 private:
  struct State;
  explicit TomlSection(std::shared_ptr<const State> state);
  // Shared: the tables of a document borrow from the one that was parsed.
  std::shared_ptr<const State> state_;
};

}  // namespace tenku
