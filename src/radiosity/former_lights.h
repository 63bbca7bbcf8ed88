/// Lights solved before, from which another one begins.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/rgb.h"
#include "radiosity/progressive_refinement.h"

namespace tenku {

/// Where the solution for another light begins.
///
/// Shape    every vector [element side], or empty where no former light is like it.
struct LightStart {
  SentLight sent;
  std::vector<Rgb> beyond_shots;  ///< by which corners make sides send more than shots do, lm/m2
};

/// Solutions of some lights on one mesh. Light adds up, so that of another light begins with the
/// sum of their multiples that comes nearest to what it brings onto the sides, and only the rest is
/// shot and swept. Where it begins changes how soon an end is reached, not where that lies.
///
/// A light is kept where former ones do not make it up to kSame already; of more than kMost the
/// oldest is forgotten.
class FormerLights {
 public:
  static constexpr std::size_t kMost = 8;
  static constexpr double kSame = 0.003;  ///< root mean square of what is missed, in parts of all

  /// @param source  what sides send before any reflection between them, lm/m2 [element side]
  /// @param weight  of each side in the sum of squares
  LightStart start(std::span<const double> source, std::span<const double> weight) const;

  /// @param of_corners  radiosity [element side]
  void keep(std::vector<double> source, std::span<const double> weight,
            const RefinementResult& shots, std::span<const Rgb> of_corners);

 private:
  struct Former {
    std::vector<double> source;
    std::vector<double> product;  ///< of the source with those up to its own
    LightStart start;
  };
  /// Factors on the former lights that make up the most of a source.
  std::vector<double> factors(std::span<const double> source, std::span<const double> weight) const;

  std::vector<Former> former_;
};

}  // namespace tenku
