#include "study/toml_section.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "core/error.h"
#include "core/suggest.h"

namespace tenku {
namespace {

std::string in_brackets(const std::string& path) {
  return path.empty() ? "the study" : "[" + path + "]";
}

std::string listed(std::span<const std::string_view> words) {
  std::string result;
  for (const std::string_view word : words) {
    if (!result.empty()) result += ", ";
    result += '\'';
    result += word;
    result += '\'';
  }
  return result;
}

std::string written(double value) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  return text.str();
}

std::string written(const NumberRange& range) {
  return (range.low_excluded ? "above " + written(range.low) + ", at most "
                             : "from " + written(range.low) + " to ") +
         written(range.high);
}

bool is_in(double value, const NumberRange& range) {
  return (range.low_excluded ? value > range.low : value >= range.low) && value <= range.high;
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  return std::string(text.substr(0, kLongest)) + (text.size() > kLongest ? "..." : "");
}

template <typename T>
std::string as_text(const T& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

struct TomlSection::State {
  std::shared_ptr<const toml::table> document;
  const toml::table* table = nullptr;
  std::string file, path;
  toml::source_position place;  // of the table that is absent: its parent's

  const toml::node* find(std::string_view key) const { return table ? table->get(key) : nullptr; }

  [[noreturn]] void refuse_at(const toml::node& node, const std::string& what) const {
    throw InputError(file + ":" + std::to_string(node.source().begin.line) + ": " + what);
  }

  std::string name_of_key(std::string_view key) const {
    return std::string(key) + " in " + in_brackets(path);
  }

  [[noreturn]] void refuse_type(std::string_view key, const toml::node& node,
                                const char* wanted) const {
    refuse_at(node, name_of_key(key) + " must be " + wanted + ", not " + as_text(node.type()));
  }

  double checked(std::string_view key, const toml::node& node, const NumberRange& range) const {
    if (!node.is_number()) refuse_type(key, node, "a number");
    const double value = *node.value<double>();
    if (!is_in(value, range)) {
      refuse_at(node,
                name_of_key(key) + " is " + written(value) + "; it must be " + written(range));
    }
    return value;
  }

  std::string checked_text(std::string_view key, const toml::node& node) const {
    if (!node.is_string()) refuse_type(key, node, "text");
    std::string text = *node.value<std::string>();
    if (text.empty()) refuse_at(node, name_of_key(key) + " is empty");
    const auto is_control = [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; };
    if (std::any_of(text.begin(), text.end(), is_control)) {
      refuse_at(node, name_of_key(key) + " holds a control character");
    }
    return text;
  }

  std::string checked_choice(std::string_view key, const toml::node& node,
                             std::span<const std::string_view> choices) const {
    const std::string text = checked_text(key, node);
    if (std::find(choices.begin(), choices.end(), text) == choices.end()) {
      refuse_at(node, name_of_key(key) + " is '" + excerpt(text) + "'; it must be one of " +
                          listed(choices) + suggestion(text, choices));
    }
    return text;
  }
};

TomlSection::TomlSection(std::shared_ptr<const State> state) : state_(std::move(state)) {}

TomlSection TomlSection::parse(std::string_view text, const std::string& file) {
  auto state = std::make_shared<State>();
  state->file = file;
  try {
    state->document = std::make_shared<const toml::table>(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    throw InputError(file + ":" + std::to_string(error.source().begin.line) +
                     ": not TOML: " + std::string(error.description()));
  }
  state->table = state->document.get();
  state->place.line = 1;
  return TomlSection(state);
}

TomlSection TomlSection::table(std::string_view name) const {
  auto state = std::make_shared<State>(*state_);
  state->path = state_->path.empty() ? std::string(name) : state_->path + "." + std::string(name);
  state->table = nullptr;
  if (const toml::node* node = state_->find(name)) {
    state->table = node->as_table();
    if (!state->table)
      state_->refuse_at(*node, std::string(name) + " must be a table: [" + state->path + "]");
    state->place = node->source().begin;
  }
  return TomlSection(state);
}

std::vector<TomlSection> TomlSection::tables(std::string_view name) const {
  std::vector<TomlSection> result;
  const toml::node* node = state_->find(name);
  if (!node) return result;
  const toml::array* array = node->as_array();
  const std::string wanted = std::string(name) + " must be tables: [[" + std::string(name) + "]]";
  if (!array) state_->refuse_at(*node, wanted);
  for (const toml::node& element : *array) {
    if (!element.is_table()) state_->refuse_at(element, wanted);
    auto state = std::make_shared<State>(*state_);
    state->path = name;
    state->table = element.as_table();
    state->place = element.source().begin;
    result.push_back(TomlSection(state));
  }
  return result;
}

bool TomlSection::is_there() const { return state_->table != nullptr; }

bool TomlSection::has(std::string_view key) const { return state_->find(key) != nullptr; }

std::optional<double> TomlSection::number(std::string_view key, NumberRange range) const {
  const toml::node* node = state_->find(key);
  if (!node) return std::nullopt;
  return state_->checked(key, *node, range);
}

std::optional<std::int64_t> TomlSection::integer(std::string_view key, NumberRange range) const {
  const toml::node* node = state_->find(key);
  if (!node) return std::nullopt;
  if (!node->is_integer()) state_->refuse_type(key, *node, "a whole number");
  state_->checked(key, *node, range);
  return node->value<std::int64_t>();
}

std::optional<bool> TomlSection::boolean(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (!node) return std::nullopt;
  if (!node->is_boolean()) state_->refuse_type(key, *node, "true or false");
  return node->value<bool>();
}

std::optional<std::string> TomlSection::text(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (!node) return std::nullopt;
  return state_->checked_text(key, *node);
}

std::optional<std::string> TomlSection::text_or_number(std::string_view key,
                                                       NumberRange range) const {
  const toml::node* node = state_->find(key);
  if (node && node->is_number()) return written(state_->checked(key, *node, range));
  return text(key);
}

std::optional<std::string> TomlSection::time(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (node && node->is_date_time()) return as_text(*node->as_date_time());
  return text(key);
}

std::optional<std::string> TomlSection::choice(std::string_view key,
                                               std::span<const std::string_view> choices) const {
  const toml::node* node = state_->find(key);
  if (!node) return std::nullopt;
  return state_->checked_choice(key, *node, choices);
}

std::optional<std::vector<std::string>> TomlSection::choice_list(
    std::string_view key, std::span<const std::string_view> choices) const {
  const toml::node* node = state_->find(key);
  if (!node) return std::nullopt;
  const toml::array* array = node->as_array();
  if (!array) state_->refuse_type(key, *node, "a list of texts");
  std::vector<std::string> result;
  for (const toml::node& element : *array) {
    std::string word = state_->checked_choice(key, element, choices);
    if (std::find(result.begin(), result.end(), word) != result.end()) {
      state_->refuse_at(element, state_->name_of_key(key) + " has '" + word + "' twice");
    }
    result.push_back(std::move(word));
  }
  if (result.empty()) state_->refuse_at(*node, state_->name_of_key(key) + " is empty");
  return result;
}

std::optional<std::vector<double>> TomlSection::numbers(std::string_view key, std::size_t count,
                                                        NumberRange range) const {
  const toml::node* node = state_->find(key);
  if (!node) return std::nullopt;
  const toml::array* array = node->as_array();
  if (!array || array->size() != count) {
    state_->refuse_at(*node, state_->name_of_key(key) + " must be a list of " +
                                 std::to_string(count) + " numbers");
  }
  std::vector<double> result;
  for (const toml::node& element : *array) {
    result.push_back(state_->checked(key, element, range));
  }
  return result;
}

std::optional<Vec3> TomlSection::point(std::string_view key) const {
  constexpr double kFarthest = 1e8;  // metres: more than any map projection has
  const auto values = numbers(key, 3, {-kFarthest, kFarthest});
  if (!values) return std::nullopt;
  return Vec3{(*values)[0], (*values)[1], (*values)[2]};
}

void TomlSection::refuse_unknown_keys(std::span<const std::string_view> known) const {
  if (!state_->table) return;
  for (const auto& [key, node] : *state_->table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    throw InputError(state_->file + ":" + std::to_string(key.source().begin.line) +
                     ": unknown key '" + excerpt(key.str()) + "' in " + in_brackets(state_->path) +
                     suggestion(key.str(), known));
  }
}

void TomlSection::refuse(std::string_view key, const std::string& what) const {
  if (const toml::node* node = state_->find(key)) state_->refuse_at(*node, what);
  throw InputError(state_->file + ":" + std::to_string(state_->place.line) + ": " + what);
}

}  // namespace tenku
