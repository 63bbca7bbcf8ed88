/// Rows of form factors that are kept, so that another light costs no other look.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "form_factors/form_factor.h"

namespace tenku {

/// Sparse rows, as many as fit into the memory given.
///
/// Threads  looking up may be shared; keeping may not.
class FormFactorStore {
 public:
  /// @param rows         how many there may be
  /// @param most_bytes   memory that rows may take
  FormFactorStore(std::size_t rows, std::size_t most_bytes)
      : row_(rows), is_kept_(rows), most_bytes_(most_bytes) {}

  std::size_t size() const { return row_.size(); }
  /// Null where the row is not kept.
  const FormFactorRow* find(std::size_t row) const {
    return is_kept_[row] != 0 ? &row_[row] : nullptr;
  }
  /// Whether there is memory left for it.
  bool fits(const FormFactorRow& factors) const;
  /// Gives the memory of a row back.
  void forget(std::size_t row);
  /// @param factors  that fit
  void keep(std::size_t row, FormFactorRow factors);

  std::size_t bytes() const { return bytes_; }
  std::size_t kept() const { return kept_; }

 private:
  std::vector<FormFactorRow> row_;
  std::vector<std::uint8_t> is_kept_;
  std::size_t most_bytes_, bytes_ = 0, kept_ = 0;
};

}  // namespace tenku
