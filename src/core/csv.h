/// Comma-separated tables with a header line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tenku {

/// A table read whole. Cells may be quoted; blanks around them are dropped; blank lines and lines
/// that begin with `#` are skipped; a byte-order mark and CRLF line ends are understood.
class CsvInput {
 public:
  /// @param name  of the file, for messages
  /// @throws InputError if there is no header, a column is named twice, or a row has another
  ///         number of cells than the header
  CsvInput(std::string_view text, std::string name);

  std::size_t size() const { return rows_.size(); }
  bool has(std::string_view column) const { return columns_.find(column) != columns_.end(); }

  /// @throws InputError if the column is missing
  void require(std::string_view column) const;

  /// Cell of a column that is there.
  const std::string& text(std::size_t row, std::string_view column) const;

  /// @throws InputError naming file, line and column if the cell is no finite number
  double number(std::size_t row, std::string_view column) const;

  /// `times.csv, line 7`.
  std::string where(std::size_t row) const;

 private:
  struct Row {
    std::size_t line;
    std::vector<std::string> cells;
  };
  std::string name_;
  std::map<std::string, std::size_t, std::less<>> columns_;
  std::vector<Row> rows_;
};

/// Whole contents of a file; `-` is standard input.
/// @throws InputError if it is missing, a folder, or cannot be read
std::string read_whole_file(const std::filesystem::path& path);

/// The shortest text that reads back as the same double.
std::string exact_text(double value);

/// @throws InputError naming `where` if `text` is no finite number
double finite_number(std::string_view text, const std::string& where);

}  // namespace tenku
