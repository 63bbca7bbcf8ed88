/// Random numbers addressed by what they are for, not by when they are drawn.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace tenku {

/// Finaliser of SplitMix64: a bijective hash of 64 bits.
///
/// Source   Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
constexpr std::uint64_t mix_bits(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// Hash of numbers rounded to integers, on top of `key`: equal for what lies in one cell.
inline std::uint64_t mix_rounded(std::uint64_t key, std::initializer_list<double> numbers) {
  for (const double x : numbers) key = mix_bits(key + static_cast<std::uint64_t>(std::llround(x)));
  return key;
}

/// Stream of uniform numbers belonging to one sample of one sensor of one study.
///
/// The k-th number is a hash of (seed, sensor, sample, k): any thread, in any order, draws the
/// same value. Not for cryptography.
class SampleRandom {
 public:
  constexpr SampleRandom(std::uint64_t seed, std::uint64_t sensor, std::uint64_t sample)
      : state_(mix_bits(mix_bits(mix_bits(seed) + sensor) + sample)) {}

  /// Next 64 random bits.
  constexpr std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15U;
    return mix_bits(state_);
  }

  /// Next number, uniform in [0, 1): 53 random bits.
  constexpr double uniform() { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }

 private:
  std::uint64_t state_;
};

}  // namespace tenku
