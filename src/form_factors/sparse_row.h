/// Rows of numbers of which most are zero.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tenku {

struct SparseEntry {
  std::uint32_t column;
  double value;
};

/// Entries in rising order of column.
using SparseRow = std::vector<SparseEntry>;

/// A row of entries in any order, in which a column may come more than once.
inline SparseRow sorted(SparseRow entries) {
  const auto before = [](const SparseEntry& a, const SparseEntry& b) {
    return a.column < b.column;
  };
  std::stable_sort(entries.begin(), entries.end(), before);
  SparseRow row;
  for (const SparseEntry& entry : entries) {
    if (row.empty() || row.back().column != entry.column) {
      row.push_back(entry);
    } else {
      row.back().value += entry.value;
    }
  }
  return row;
}

/// k a + m b.
inline SparseRow combined(const SparseRow& a, double k, const SparseRow& b, double m) {
  SparseRow sum;
  sum.reserve(a.size() + b.size());
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && i->column < j->column)) {
      sum.push_back({i->column, k * i->value}), ++i;
    } else if (i == a.end() || j->column < i->column) {
      sum.push_back({j->column, m * j->value}), ++j;
    } else {
      sum.push_back({i->column, k * i->value + m * j->value}), ++i, ++j;
    }
  }
  return sum;
}

}  // namespace tenku
