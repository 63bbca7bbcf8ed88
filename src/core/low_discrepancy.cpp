#include "core/low_discrepancy.h"

#include <array>

#include "core/random.h"

namespace tenku {
namespace {

using Directions = std::array<std::uint32_t, 32>;

/// Direction numbers from a primitive polynomial of the given degree, coefficients `a` (without
/// the leading and trailing one) and the initial odd numbers `m`.
constexpr Directions directions(unsigned degree, unsigned a, std::array<std::uint32_t, 3> m) {
  Directions v{};
  for (unsigned i = 0; i < 32; ++i) {
    if (i < degree) {
      v[i] = m[i] << (31U - i);
      continue;
    }
    v[i] = v[i - degree] ^ (v[i - degree] >> degree);
    for (unsigned k = 1; k < degree; ++k) {
      if ((a >> (degree - 1 - k)) & 1U) v[i] ^= v[i - k];
    }
  }
  return v;
}

constexpr Directions van_der_corput() {
  Directions v{};
  for (unsigned i = 0; i < 32; ++i) v[i] = 1U << (31U - i);
  return v;
}

constexpr std::array<Directions, kSobolDimensions> kDirections{
    van_der_corput(), directions(1, 0, {1, 0, 0}), directions(2, 1, {1, 3, 0}),
    directions(3, 1, {1, 3, 1})};

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x >> 1U) & 0x55555555U) | ((x & 0x55555555U) << 1U);
  x = ((x >> 2U) & 0x33333333U) | ((x & 0x33333333U) << 2U);
  x = ((x >> 4U) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4U);
  x = ((x >> 8U) & 0x00ff00ffU) | ((x & 0x00ff00ffU) << 8U);
  return (x >> 16U) | (x << 16U);
}

/// Each bit is flipped by a hash of the bits below it: an Owen scramble of the reversed number.
constexpr std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16U) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

constexpr std::uint32_t owen(std::uint32_t x, std::uint32_t seed) {
  return reverse_bits(scramble_reversed(reverse_bits(x), seed));
}

}  // namespace

double sobol_owen(std::uint32_t index, unsigned dimension, std::uint64_t scramble) {
  const unsigned group = dimension / kSobolDimensions, column = dimension % kSobolDimensions;
  const std::uint64_t group_seed = mix_bits(scramble + group);
  const std::uint32_t shuffled = owen(index, static_cast<std::uint32_t>(group_seed));
  std::uint32_t x = 0;
  for (std::uint32_t i = shuffled, k = 0; i != 0; i >>= 1U, ++k) {
    if (i & 1U) x ^= kDirections[column][k];
  }
  const auto seed = static_cast<std::uint32_t>(mix_bits(group_seed + 1U + column) >> 32U);
  return static_cast<double>(owen(x, seed)) * 0x1.0p-32;
}

}  // namespace tenku
