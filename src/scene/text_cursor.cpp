#include "scene/text_cursor.h"

#include <charconv>
#include <cmath>
#include <cstring>

#include "core/error.h"

namespace tenku {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0'; }

}  // namespace

void TextCursor::skip_blanks() {
  while (at_ != end_) {
    if (is_blank(*at_)) {
      ++at_;
    } else if (*at_ == '\\' && at_ + 1 != end_ && at_[1] == '\n') {
      at_ += 2, ++line_;
    } else if (*at_ == '\\' && end_ - at_ > 2 && at_[1] == '\r' && at_[2] == '\n') {
      at_ += 3, ++line_;
    } else {
      return;
    }
  }
}

void TextCursor::next_line() {
  const void* found = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
  at_ = found == nullptr ? end_ : static_cast<const char*>(found) + 1;
  ++line_;
}

bool TextCursor::line_is_done() {
  skip_blanks();
  return at_ == end_ || *at_ == '\n';
}

std::string_view TextCursor::word() {
  skip_blanks();
  const char* begin = at_;
  while (at_ != end_ && *at_ != '\n' && !is_blank(*at_)) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string_view TextCursor::rest() {
  skip_blanks();
  const char* begin = at_;
  while (at_ != end_ && *at_ != '\n') ++at_;
  const char* last = at_;
  while (last != begin && is_blank(last[-1])) --last;
  return {begin, static_cast<std::size_t>(last - begin)};
}

double TextCursor::number() {
  const std::string_view text = word();
  const std::optional<double> value = finite_number(text);
  if (!value) {
    refuse(text.empty() ? "a number is missing" : quoted(text) + " is not a finite number");
  }
  return *value;
}

void TextCursor::refuse(const std::string& what) const {
  throw InputError(file_ + ", line " + std::to_string(line_) + ": " + what);
}

std::string quoted(std::string_view word) {
  std::string text(1, '\'');
  text.append(word.substr(0, 40));
  text.push_back('\'');
  return text;
}

std::optional<long long> leading_integer(std::string_view& word) {
  long long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc()) return std::nullopt;
  word.remove_prefix(static_cast<std::size_t>(end - word.data()));
  return value;
}

std::optional<double> finite_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) {
    // Too small is as good as zero; too large is refused. from_chars does not say which.
    const std::string text(word);
    value = std::strtod(text.c_str(), nullptr);
    if (!(std::abs(value) < 1.0)) return std::nullopt;
    return value;
  }
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace tenku
