/// Tables of reference values, as the tests read them.
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace tenku::testing_support {

/// A CSV file without quotes, by column name.
class ReferenceTable {
 public:
  explicit ReferenceTable(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("no reference table " + path);
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> names = cells(line);
    for (std::size_t i = 0; i < names.size(); ++i) column_[names[i]] = i;
    while (std::getline(file, line)) {
      if (!line.empty()) rows_.push_back(cells(line));
    }
  }

  std::size_t size() const { return rows_.size(); }
  const std::string& text(std::size_t row, const std::string& column) const {
    return rows_.at(row).at(column_.at(column));
  }
  double number(std::size_t row, const std::string& column) const {
    return std::stod(text(row, column));
  }

 private:
  static std::vector<std::string> cells(std::string line) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> result;
    std::stringstream stream(line + ",");
    for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
    return result;
  }

  std::map<std::string, std::size_t> column_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace tenku::testing_support
