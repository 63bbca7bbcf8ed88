/// Members of JSON objects, refused with their place. Private to this module.
#pragma once

#include <simdjson.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec3.h"

namespace tenku {

using JsonElement = simdjson::dom::element;

/// What a message names as the place of JSON that is being read: a file, later an item in it.
class JsonSource {
 public:
  explicit JsonSource(std::string place) : place_(std::move(place)) {}

  const std::string& place() const { return place_; }
  [[noreturn]] void refuse(const std::string& what) const;

  /// Nothing if it is absent or null, or `object` is no object.
  static std::optional<JsonElement> member(JsonElement object, std::string_view key);

  /// Items of a list; none if the member is absent.
  std::vector<JsonElement> list(JsonElement object, std::string_view key) const;
  std::vector<JsonElement> items(JsonElement list, std::string_view name) const;

  /// Empty if the member is absent.
  std::string text(JsonElement object, std::string_view key) const;
  double number(JsonElement object, std::string_view key, double otherwise) const;
  double number(JsonElement number, std::string_view name) const;
  bool flag(JsonElement object, std::string_view key) const;

  /// Whole numbers from 0 up.
  std::size_t as_whole(JsonElement number, std::string_view name) const;
  std::vector<std::size_t> wholes(JsonElement object, std::string_view key) const;
  std::size_t whole(JsonElement object, std::string_view key) const;
  std::optional<std::size_t> whole_if_given(JsonElement object, std::string_view key) const;

  /// Finite numbers of a list, as many as `count`.
  std::vector<double> numbers(JsonElement list, std::size_t count, std::string_view name) const;
  Vec3 point(JsonElement list, std::string_view name) const;

 private:
  std::string place_;
};

/// @throws InputError if `text` is not JSON. The parser keeps what the element points to.
JsonElement parse_json(simdjson::dom::parser& parser, std::string_view text,
                       const JsonSource& source);

}  // namespace tenku
