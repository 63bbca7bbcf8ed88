/// Rows of numbers of which most are zero.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/form_factor.h"

namespace tenku {

struct SparseEntry {
  std::uint32_t side;
  double value;
};

/// Entries in rising order of side.
using SparseRow = std::vector<SparseEntry>;

/// k a + m b.
inline SparseRow combined(const SparseRow& a, double k, const SparseRow& b, double m) {
  SparseRow sum;
  sum.reserve(a.size() + b.size());
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && i->side < j->side)) {
      sum.push_back({i->side, k * i->value}), ++i;
    } else if (i == a.end() || j->side < i->side) {
      sum.push_back({j->side, m * j->value}), ++j;
    } else {
      sum.push_back({i->side, k * i->value + m * j->value}), ++i, ++j;
    }
  }
  return sum;
}

}  // namespace tenku
