#include "sky_models/gauss_legendre.h"

#include <cmath>

#include "core/error.h"
#include "core/units.h"

namespace tenku {
namespace {

struct Legendre {
  double value, derivative;
};

Legendre legendre(std::size_t n, double x) {
  double p = 1.0, previous = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double kk = static_cast<double>(k);
    const double next = ((2.0 * kk + 1.0) * x * p - kk * previous) / (kk + 1.0);
    previous = p;
    p = next;
  }
  return {p, static_cast<double>(n) * (x * p - previous) / (x * x - 1.0)};
}

}  // namespace

GaussLegendre::GaussLegendre(std::size_t n) : point(n), weight(n) {
  expects(n >= 1, "a quadrature rule has a point");
  for (std::size_t i = 0; i < n; ++i) {
    // Tricomi's first guess, then Newton's method.
    double x = -std::cos(kPi * (static_cast<double>(i) + 0.75) / (static_cast<double>(n) + 0.5));
    for (int iteration = 0; iteration < 8; ++iteration) {
      const Legendre p = legendre(n, x);
      x -= p.value / p.derivative;
    }
    const double derivative = legendre(n, x).derivative;
    point[i] = 0.5 * (1.0 + x);
    weight[i] = 1.0 / ((1.0 - x * x) * derivative * derivative);
  }
}

}  // namespace tenku
