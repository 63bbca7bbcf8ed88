#include "form_factors/form_factor_store.h"

#include <utility>

#include "core/error.h"

namespace tenku {

namespace {

std::size_t bytes_of(const FormFactorRow& row) {
  return row.size() * sizeof(FormFactor) + sizeof(FormFactorRow);
}

}  // namespace

bool FormFactorStore::fits(const FormFactorRow& factors) const {
  return bytes_ + bytes_of(factors) <= most_bytes_;
}

void FormFactorStore::forget(std::size_t row) {
  if (is_kept_[row] == 0) return;
  bytes_ -= bytes_of(row_[row]);
  row_[row] = {};
  is_kept_[row] = 0;
  --kept_;
}

void FormFactorStore::keep(std::size_t row, FormFactorRow factors) {
  expects(is_kept_[row] == 0 && fits(factors), "a row is kept once, where it fits");
  bytes_ += bytes_of(factors);
  factors.shrink_to_fit();
  row_[row] = std::move(factors);
  is_kept_[row] = 1;
  ++kept_;
}

}  // namespace tenku
