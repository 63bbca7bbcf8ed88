#include "radiosity/radiosity_slopes.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

constexpr std::uint8_t kAllCorners = 7;

/// The share of a slope that leaves nothing negative.
double steepest(Rgb mean, const std::array<Rgb, 3>& corner) {
  double share = 1.0;
  const auto hold = [&](double m, double c) {
    if (m + c < 0.0) share = std::min(share, std::max(0.0, m) / -c);
  };
  for (const Rgb& c : corner) hold(mean.r, c.r), hold(mean.g, c.g), hold(mean.b, c.b);
  return share;
}

}  // namespace

RadiositySlopes::RadiositySlopes(const ElementMesh& mesh, const SidePoints& points,
                                 const SurfaceLight& surfaces, const SensorIlluminance& light,
                                 const std::vector<Rgb>& mean,
                                 const std::vector<std::uint8_t>& counts)
    : mesh_(mesh), points_(points), light_(light), corner_(mesh.sides()), is_level_(mesh.sides()) {
  for (std::size_t s = 0; s < mesh.sides(); ++s) {
    if (counts[s] != kAllCorners) continue;
    Rgb middle{};
    for (const std::uint32_t i : points.corner[s]) middle = middle + 1.0 / 3.0 * light.total_rgb(i);
    for (std::size_t c = 0; c < 3; ++c) {
      const Rgb beyond = light.total_rgb(points.corner[s][c]) + -1.0 * middle;
      corner_[s][c] = beyond * surfaces.reflectance[s / 2];
    }
    is_level_[s] = std::all_of(corner_[s].begin(), corner_[s].end(), [&](Rgb c) {
      return std::abs(luminance_of(c)) <= kLevel * luminance_of(mean[s]);
    });
    const double share = steepest(mean[s], corner_[s]);
    for (Rgb& c : corner_[s]) c = share * c;
  }
}

/// Of the corners of a triangle, which make up a place in its plane. None where rounding, or a ray
/// along the plane, tells of a place beyond.
std::array<double, 3> RadiositySlopes::shares(std::uint32_t side, Vec3 place) const {
  const auto& [i, j, k] = mesh_.elements[side / 2];
  const Vec3 a = mesh_.vertices[i], ab = mesh_.vertices[j] - a, ac = mesh_.vertices[k] - a;
  const Vec3 across = cross(ab, ac);
  const double whole = dot(across, across);
  const double of_b = dot(cross(place - a, ac), across) / whole;
  const double of_c = dot(cross(ab, place - a), across) / whole;
  const auto held = [](double share) { return share > 0.0 ? std::min(share, 1.0) : 0.0; };
  return {held(1.0 - of_b - of_c), held(of_b), held(of_c)};
}

Rgb RadiositySlopes::beyond_mean(std::uint32_t side, Vec3 place) const {
  const std::array<double, 3> share = shares(side, place);
  Rgb sum{};
  for (std::size_t c = 0; c < 3; ++c) sum = sum + share[c] * corner_[side][c];
  return sum;
}

double RadiositySlopes::daylight_lux(std::uint32_t side, Vec3 place) const {
  const std::array<double, 3> share = shares(side, place);
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t i = points_.corner[side][c];
    sum += share[c] * (light_.sun_lux[i] + light_.sky_lux[i]);
  }
  return sum;
}

}  // namespace tenku
