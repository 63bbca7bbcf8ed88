#include "core/csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>

#include "core/error.h"

namespace tenku {
namespace {

std::string_view trimmed(std::string_view s) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = s.find_first_not_of(kBlank);
  if (first == s.npos) return {};
  return s.substr(first, s.find_last_not_of(kBlank) - first + 1);
}

/// Cells of one line. A quoted cell may hold commas, and doubled quotes.
std::vector<std::string> cells_of(std::string_view line, const std::string& where) {
  std::vector<std::string> cells;
  std::size_t i = 0;
  while (true) {
    while (i < line.size() && (line[i] == ' ' || line[i] == '\t')) ++i;
    std::string cell;
    if (i < line.size() && line[i] == '"') {
      for (++i;; ++i) {
        if (i >= line.size()) throw InputError(where + ": a quoted cell is not closed");
        if (line[i] != '"') {
          cell += line[i];
        } else if (i + 1 < line.size() && line[i + 1] == '"') {
          cell += line[++i];
        } else {
          break;
        }
      }
      i = std::min(line.find(',', i), line.size());
    } else {
      const std::size_t end = std::min(line.find(',', i), line.size());
      cell = trimmed(line.substr(i, end - i));
      i = end;
    }
    cells.push_back(std::move(cell));
    if (i >= line.size()) return cells;
    ++i;
  }
}

}  // namespace

CsvInput::CsvInput(std::string_view text, std::string name) : name_(std::move(name)) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::size_t line_number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    const std::string here = fmt::format("{}, line {}", name_, line_number);
    std::vector<std::string> cells = cells_of(line, here);
    if (columns_.empty()) {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!columns_.emplace(cells[i], i).second) {
          throw InputError(fmt::format("{}: column '{}' is named twice", here, cells[i]));
        }
      }
      continue;
    }
    if (cells.size() != columns_.size()) {
      throw InputError(
          fmt::format("{}: {} cells, but the header has {}", here, cells.size(), columns_.size()));
    }
    rows_.push_back({line_number, std::move(cells)});
  }
  if (columns_.empty()) throw InputError(name_ + ": the table is empty; a header line is needed");
}

void CsvInput::require(std::string_view column) const {
  if (!has(column)) throw InputError(fmt::format("{}: there is no column '{}'", name_, column));
}

const std::string& CsvInput::text(std::size_t row, std::string_view column) const {
  const auto found = columns_.find(column);
  expects(found != columns_.end(), "the column was required");
  return rows_.at(row).cells.at(found->second);
}

double CsvInput::number(std::size_t row, std::string_view column) const {
  return finite_number(text(row, column), fmt::format("{}, column '{}'", where(row), column));
}

std::string CsvInput::where(std::size_t row) const {
  return fmt::format("{}, line {}", name_, rows_.at(row).line);
}

std::string read_whole_file(const std::filesystem::path& path) {
  std::string bytes;
  if (path == "-") {
    bytes.assign(std::istreambuf_iterator<char>(std::cin), {});
    return bytes;
  }
  std::error_code status;
  if (!std::filesystem::exists(path, status)) {
    throw InputError(fmt::format("'{}': there is no such file", path.string()));
  }
  if (std::filesystem::is_directory(path, status)) {
    throw InputError(fmt::format("'{}' is a folder, not a file", path.string()));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("'{}' cannot be read", path.string()));
  bytes.assign(std::istreambuf_iterator<char>(file), {});
  if (file.bad()) throw InputError(fmt::format("'{}' cannot be read", path.string()));
  return bytes;
}

std::string exact_text(double value) { return fmt::format("{}", value); }

double finite_number(std::string_view text, const std::string& where) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || last != digits.data() + digits.size() || !std::isfinite(value)) {
    throw InputError(fmt::format("{}: '{}' is not a finite number", where, text));
  }
  return value;
}

}  // namespace tenku
