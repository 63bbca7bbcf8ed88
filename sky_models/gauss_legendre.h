/// Points and weights of Gauss-Legendre quadrature.
#pragma once

#include <cstddef>
#include <vector>

namespace tenku {

/// Rule on [0, 1]; the weights add up to 1. Exact for polynomials of degree 2 n - 1.
struct GaussLegendre {
  std::vector<double> point, weight;

  /// @param n  number of points, at least 1
  explicit GaussLegendre(std::size_t n);

  std::size_t size() const { return point.size(); }
};

}  // namespace tenku
