/// Walks over the lines and words of a text file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tenku {

/// Reads words and numbers within a line; a backslash at a line's end continues it.
class TextCursor {
 public:
  /// @param file  name for messages
  TextCursor(std::string_view text, const std::string& file)
      : at_(text.data()), end_(text.data() + text.size()), file_(file) {}

  /// Reads `text` next, as what follows in the file. Words found before are no longer valid.
  void go_on(std::string_view text) { at_ = text.data(), end_ = text.data() + text.size(); }
  bool at_end() const { return at_ == end_; }
  std::size_t line() const { return line_; }
  void next_line();
  /// True if no word is left in this line.
  bool line_is_done();
  /// Next word of this line; empty if there is none.
  std::string_view word();
  /// Rest of this line without blanks at its ends.
  std::string_view rest();
  /// @throws InputError if the next word is not a finite number
  double number();
  /// Throws InputError with file and line.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  void skip_blanks();

  const char* at_;
  const char* end_;
  const std::string& file_;
  std::size_t line_ = 1;
};

/// `word` between quotation marks for a message, cut at 40 letters.
std::string quoted(std::string_view word);

/// A whole number at the start of `word`, which is shortened by it.
std::optional<long long> leading_integer(std::string_view& word);

/// A finite number that is all of `word`; a leading plus sign is allowed.
std::optional<double> finite_number(std::string_view word);

}  // namespace tenku
