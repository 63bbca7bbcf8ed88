/// Light of lamps in a scene by path tracing, for comparison: no radiosity, no sharing.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/low_discrepancy.h"
#include "core/random.h"
#include "core/rgb.h"
#include "visibility/ray_visibility.h"

namespace tenku::testing_support {

/// RGB illuminance with all reflections between diffuse surfaces. Every vertex of a path asks for a
/// point of a lamp, in proportion to area; a path ends by chance in proportion to reflectance.
class LampPaths {
 public:
  explicit LampPaths(const RayVisibility& rays) : rays_(rays) {
    for (std::uint32_t t = 0; t < rays.soup().size(); ++t) {
      if (!emits(t)) continue;
      const auto [a, b, c] = corners(t);
      area_m2_ += 0.5 * length(cross(b - a, c - a));
      lamp_.push_back(t);
      area_to_.push_back(area_m2_);
    }
  }

  /// Mean of `samples` paths from a point on a surface, one scramble of a sequence.
  Rgb illuminance(Vec3 position, Vec3 normal, std::uint64_t scramble, std::uint32_t samples) const {
    Rgb sum{};
    for (std::uint32_t k = 0; k < samples; ++k) sum = sum + path(position, normal, scramble, k);
    return (1.0 / samples) * sum;
  }

  Rgb emission(std::uint32_t triangle) const { return material(triangle).emission_lm_m2; }
  Rgb reflectance(std::uint32_t triangle) const { return material(triangle).reflectance; }

 private:
  static constexpr int kCertain = 3;  // reflections before chance ends a path

  const Material& material(std::uint32_t triangle) const {
    return rays_.materials()[rays_.soup().material[triangle]];
  }
  bool emits(std::uint32_t triangle) const { return luminance_of(emission(triangle)) > 0.0; }
  std::array<Vec3, 3> corners(std::uint32_t t) const {
    const auto& [a, b, c] = rays_.soup().triangles[t];
    return {rays_.soup().vertices[a], rays_.soup().vertices[b], rays_.soup().vertices[c]};
  }

  Rgb path(Vec3 position, Vec3 normal, std::uint64_t scramble, std::uint32_t index) const {
    unsigned dimension = 0;
    const auto next = [&] { return sobol_owen(index, dimension++, scramble); };
    SampleRandom chance(scramble, index, 3);
    Rgb sum{}, weight = Rgb::grey(1.0);
    for (int order = 0;; ++order) {
      const Vec3 origin = position + rays_.lift_m() * normal;
      const double u = next(), v = next();
      sum = sum + weight * direct(origin, normal, chance.uniform(), u, v);
      const auto [tangent, bitangent] = tangent_frame(normal);
      const double r = next(), turn = 2.0 * std::numbers::pi * next(), out = std::sqrt(r);
      const Vec3 way = normalized(out * std::cos(turn) * tangent +
                                  out * std::sin(turn) * bitangent + std::sqrt(1.0 - r) * normal);
      const auto hit = rays_.first_hit(origin, way);
      if (!hit) return sum;
      const Vec3 face = rays_.normal(hit->triangle);
      normal = dot(face, way) < 0.0 ? face : -face;
      position = rays_.on_plane(hit->triangle, origin + hit->distance_m * way);
      weight = weight * reflectance(hit->triangle);
      if (order < kCertain) continue;
      const double on = std::max({weight.r, weight.g, weight.b, 0.0});
      const double goes_on = std::min(on, 0.95);
      if (!(chance.uniform() < goes_on)) return sum;
      weight = (1.0 / goes_on) * weight;
    }
  }

  Rgb direct(Vec3 origin, Vec3 normal, double which, double u, double v) const {
    std::size_t k = 0;
    while (k + 1 < lamp_.size() && area_to_[k] < which * area_m2_) ++k;
    const auto [a, b, c] = corners(lamp_[k]);
    const double s = std::sqrt(u);
    const Vec3 to = (1.0 - s) * a + s * (1.0 - v) * b + s * v * c - origin;
    const double away = length(to);
    const Vec3 way = (1.0 / away) * to;
    const double cosine = dot(way, normal);
    if (!(cosine > 0.0)) return {};
    const auto hit = rays_.first_hit(origin, way);
    if (!hit || !emits(hit->triangle) || std::abs(hit->distance_m - away) > 1e-3 * away) return {};
    const double factor =
        cosine * std::abs(dot(way, rays_.normal(lamp_[k]))) / (std::numbers::pi * away * away);
    return (factor * area_m2_) * emission(lamp_[k]);
  }

  const RayVisibility& rays_;
  std::vector<std::uint32_t> lamp_;
  std::vector<double> area_to_;
  double area_m2_ = 0.0;
};

}  // namespace tenku::testing_support
