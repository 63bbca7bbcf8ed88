#include "scene/json_source.h"

#include <cmath>

#include "core/error.h"
#include "scene/text_cursor.h"

namespace tenku {
void JsonSource::refuse(const std::string& what) const { throw InputError(place_ + ": " + what); }

std::optional<JsonElement> JsonSource::member(JsonElement object, std::string_view key) {
  JsonElement found;
  if (object[key].get(found) != simdjson::SUCCESS || found.is_null()) return std::nullopt;
  return found;
}

std::vector<JsonElement> JsonSource::items(JsonElement list, std::string_view name) const {
  simdjson::dom::array array;
  if (list.get(array) != simdjson::SUCCESS) refuse(quoted(name) + " should be a list");
  std::vector<JsonElement> result;
  for (const JsonElement item : array) result.push_back(item);
  return result;
}

std::vector<JsonElement> JsonSource::list(JsonElement object, std::string_view key) const {
  const auto found = member(object, key);
  return found ? items(*found, key) : std::vector<JsonElement>{};
}

std::string JsonSource::text(JsonElement object, std::string_view key) const {
  const auto found = member(object, key);
  if (!found) return "";
  std::string_view text;
  if (found->get(text) != simdjson::SUCCESS) refuse(quoted(key) + " should be a text");
  return std::string(text);
}

double JsonSource::number(JsonElement element, std::string_view name) const {
  double value = 0.0;
  if (element.get(value) != simdjson::SUCCESS || !std::isfinite(value)) {
    refuse(quoted(name) + " should be a number");
  }
  return value;
}

double JsonSource::number(JsonElement object, std::string_view key, double otherwise) const {
  const auto found = member(object, key);
  return found ? number(*found, key) : otherwise;
}

bool JsonSource::flag(JsonElement object, std::string_view key) const {
  const auto found = member(object, key);
  bool value = false;
  return found && found->get(value) == simdjson::SUCCESS && value;
}

std::size_t JsonSource::as_whole(JsonElement number, std::string_view name) const {
  std::uint64_t value = 0;
  if (number.get(value) == simdjson::SUCCESS) return static_cast<std::size_t>(value);
  // Some programs write whole numbers with a decimal point.
  constexpr double kMost = 9007199254740992.0;  // doubles beyond are not all whole numbers apart
  double real = -1.0;
  if (number.get(real) != simdjson::SUCCESS || !(real >= 0.0 && real < kMost) ||
      real != std::floor(real)) {
    refuse(quoted(name) + " should be a whole number from 0 up");
  }
  return static_cast<std::size_t>(real);
}

std::optional<std::size_t> JsonSource::whole_if_given(JsonElement object,
                                                      std::string_view key) const {
  const auto found = member(object, key);
  if (!found) return std::nullopt;
  return as_whole(*found, key);
}

std::size_t JsonSource::whole(JsonElement object, std::string_view key) const {
  const auto value = whole_if_given(object, key);
  if (!value) refuse(quoted(key) + " is missing");
  return *value;
}

std::vector<std::size_t> JsonSource::wholes(JsonElement object, std::string_view key) const {
  std::vector<std::size_t> values;
  for (const JsonElement item : list(object, key)) values.push_back(as_whole(item, key));
  return values;
}

std::vector<double> JsonSource::numbers(JsonElement list, std::size_t count,
                                        std::string_view name) const {
  std::vector<double> values;
  for (const JsonElement item : items(list, name)) values.push_back(number(item, name));
  if (values.size() != count) {
    refuse(quoted(name) + " should be " + std::to_string(count) + " numbers, not " +
           std::to_string(values.size()));
  }
  return values;
}

Vec3 JsonSource::point(JsonElement list, std::string_view name) const {
  const std::vector<double> xyz = numbers(list, 3, name);
  return {xyz[0], xyz[1], xyz[2]};
}

JsonElement parse_json(simdjson::dom::parser& parser, std::string_view text,
                       const JsonSource& source) {
  const std::string_view mark = "\xEF\xBB\xBF";
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  JsonElement document;
  const auto error = parser.parse(text.data(), text.size()).get(document);
  if (error != simdjson::SUCCESS) {
    source.refuse(std::string("cut off, or not JSON: ") + simdjson::error_message(error));
  }
  return document;
}

}  // namespace tenku
