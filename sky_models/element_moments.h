/// Integrals of the luminance over a piece of the sky.
#pragma once

#include <array>

#include "sky_models/sky_element.h"
#include "sky_models/sky_model.h"

namespace tenku {

/// Moments of the field F(d) = L(d) d over a cell: enough for its light on any plane that sees it
/// whole, and for the error of a single sample of it.
struct ElementMoments {
  double solid_angle = 0.0;        ///< sr
  double luminance = 0.0;          ///< integral of L, cd/m2 sr
  Vec3 vector;                     ///< integral of L d, lx
  std::array<double, 6> square{};  ///< integral of L^2 d d^T: xx, yy, zz, xy, xz, yz

  ElementMoments& operator+=(const ElementMoments& other);
};

/// Source   tensor Gauss-Legendre rules in azimuth and altitude on boxes of a few times the sky's
///          detail, halved where two rules differ.
/// Error    1e-7 of the cell's light for the models with a formula.
ElementMoments element_moments(const SkyModel& sky, const SkyCell& cell);

/// Six numbers of a symmetric 3 x 3 matrix, in the order of `ElementMoments::square`.
using Symmetric3 = std::array<double, 6>;

/// Solid angle squared times the covariance of F over the cell: the covariance of the estimate
/// that one uniformly random direction gives of `vector`.
Symmetric3 sample_covariance(const ElementMoments& moments);

/// Largest eigenvalue, not below zero.
double largest_eigenvalue(const Symmetric3& matrix);

}  // namespace tenku
