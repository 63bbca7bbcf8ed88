/// Walks over the bytes of a binary file.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string_view>

namespace tenku {

/// Takes numbers from the front of a piece of memory, in the byte order said.
class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes, std::endian order = std::endian::little)
      : left_(bytes), order_(order) {}

  std::size_t left() const { return left_.size(); }
  std::string_view rest() const { return left_; }

  /// The next number; nothing if too few bytes are left.
  template <class T>
  std::optional<T> next() {
    std::array<char, sizeof(T)> bytes{};
    if (left_.size() < sizeof(T)) return std::nullopt;
    for (std::size_t k = 0; k < sizeof(T); ++k) {
      bytes[order_ == std::endian::native ? k : sizeof(T) - 1 - k] = left_[k];
    }
    left_.remove_prefix(sizeof(T));
    return std::bit_cast<T>(bytes);
  }

  /// Passes over bytes; false if too few are left.
  bool skip(std::size_t count) {
    if (left_.size() < count) return false;
    left_.remove_prefix(count);
    return true;
  }

 private:
  std::string_view left_;
  std::endian order_;
};

}  // namespace tenku
