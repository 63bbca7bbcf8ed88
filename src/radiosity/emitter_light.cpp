#include "radiosity/emitter_light.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/random.h"
#include "radiosity/contour_factor.h"
#include "radiosity/mesh_soup.h"

namespace tenku {
namespace {

constexpr int kFirstRays = 4;  // squared: rays that must agree
constexpr double kFar = 4.0;   // radii, beyond which a small source is a point
constexpr double kEdgeVariance = 0.19;

std::array<Vec3, 3> corners_of(const ElementMesh& mesh, std::size_t element) {
  const auto& [a, b, c] = mesh.elements[element];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// Source  E. Heitz, "A low-distortion map between triangle and square", 2019.
Vec3 on_triangle(const std::array<Vec3, 3>& t, double u, double v) {
  const double a = v > u ? 0.5 * u : u - 0.5 * v, b = v > u ? v - 0.5 * u : 0.5 * v;
  return a * t[0] + b * t[1] + (1.0 - a - b) * t[2];
}

}  // namespace

bool EmitterLight::Direct::has(std::uint32_t patch) const {
  return std::binary_search(bright.begin(), bright.end(), patch);
}

EmitterLight::EmitterLight(const ElementMesh& mesh, const SurfaceLight& surfaces,
                           std::uint64_t seed)
    : mesh_(mesh), seed_(seed), patch_of_(mesh.size()) {
  for (std::uint32_t p = 0; p < mesh.patches(); ++p) {
    const std::size_t first = mesh.patch_begin[p], end = mesh.patch_begin[p + 1];
    std::fill(patch_of_.begin() + static_cast<std::ptrdiff_t>(first),
              patch_of_.begin() + static_cast<std::ptrdiff_t>(end), p);
    if (!surfaces.emits(first)) continue;
    Emitter emitter{p, {}, mesh.normal(2 * first), 0.0, 0.0, surfaces.emission_lm_m2[first]};
    for (std::size_t e = first; e < end; ++e) {
      emitter.area_m2 += surfaces.area_m2[e];
      emitter.centre = emitter.centre + surfaces.area_m2[e] * mesh.centre(e);
    }
    emitter.centre = (1.0 / emitter.area_m2) * emitter.centre;
    for (std::size_t e = first; e < end; ++e) {
      for (const Vec3 corner : corners_of(mesh, e)) {
        emitter.radius_m = std::max(emitter.radius_m, length(corner - emitter.centre));
      }
    }
    patch_.push_back(emitter);
  }
  if (2 * patch_.size() > kMostEmitters) patch_.clear();
  if (patch_.empty()) return;
  soup_ = soup_of(mesh);
  rays_ = std::make_unique<RayVisibility>(soup_, materials_);
}

double EmitterLight::factor(const Emitter& emitter, Vec3 position, Vec3 normal) const {
  const Vec3 way = emitter.centre - position;
  const double away = length(way), height = dot(way, normal);
  if (height < -emitter.radius_m) return 0.0;
  if (away > kFar * emitter.radius_m && height > emitter.radius_m) {
    const double turned = std::abs(dot(way, emitter.normal));
    return emitter.area_m2 * height * turned / (kPi * std::pow(away, 4));
  }
  double sum = 0.0;
  for (std::size_t e = mesh_.patch_begin[emitter.patch]; e < mesh_.patch_begin[emitter.patch + 1];
       ++e) {
    sum += contour_factor(position, normal, corners_of(mesh_, e));
  }
  return sum;
}

double EmitterLight::seen(const Emitter& emitter, Vec3 position, Vec3 normal, int rays) const {
  const std::size_t first = mesh_.patch_begin[emitter.patch],
                    end = mesh_.patch_begin[emitter.patch + 1];
  const int cells = std::max(
      1, static_cast<int>(
             std::lround(std::sqrt(static_cast<double>(rays) / static_cast<double>(end - first)))));
  std::uint64_t key = mix_bits(seed_ + emitter.patch);
  for (const double x : {position.x, position.y, position.z}) {
    key = mix_bits(key + std::bit_cast<std::uint64_t>(x + 0.0));
  }
  SampleRandom random(key, static_cast<std::uint64_t>(rays), 0);
  std::vector<Vec3> direction;
  std::vector<double> weight;
  for (std::size_t e = first; e < end; ++e) {
    const auto corners = corners_of(mesh_, e);
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        const double u = random.uniform(), v = random.uniform();
        const Vec3 way = on_triangle(corners, (i + u) / cells, (j + v) / cells) - position;
        const double away = length(way);
        if (!(dot(way, normal) > 0.0)) continue;
        direction.push_back((1.0 / away) * way);
        weight.push_back(mesh_.area_m2(e) * dot(way, normal) * std::abs(dot(way, emitter.normal)) /
                         std::pow(away, 4));
      }
    }
  }
  std::vector<std::uint32_t> met(direction.size());
  rays_->first_triangles(position, direction, met);
  double all = 0.0, lit = 0.0;
  for (std::size_t k = 0; k < met.size(); ++k) {
    all += weight[k];
    if (met[k] >= first && met[k] < end) lit += weight[k];
  }
  return all > 0.0 ? lit / all : 0.0;
}

EmitterLight::Direct EmitterLight::at(Vec3 position, Vec3 normal, int rays) const {
  std::vector<double> whole;
  double sum = 0.0;
  for (const Emitter& emitter : patch_) {
    whole.push_back(factor(emitter, position, normal));
    sum += whole.back() * luminance_of(emitter.exitance);
  }
  Direct direct;
  for (std::size_t k = 0; k < patch_.size(); ++k) {
    const Emitter& emitter = patch_[k];
    const double lm = luminance_of(emitter.exitance);
    if (!(whole[k] * lm > 0.0) || whole[k] * lm < kBright * sum) continue;
    direct.bright.push_back(emitter.patch);
    double exact = 0.0;
    for (std::size_t e = mesh_.patch_begin[emitter.patch]; e < mesh_.patch_begin[emitter.patch + 1];
         ++e) {
      exact += contour_factor(position, normal, corners_of(mesh_, e));
    }
    double share = seen(emitter, position, normal, kFirstRays * kFirstRays);
    if (share > 0.0 && share < 1.0 - 1e-12) {
      share = seen(emitter, position, normal, rays);
      direct.variance += kEdgeVariance / std::pow(rays, 1.5) * std::pow(exact * lm, 2);
    }
    direct.lux = direct.lux + (exact * share) * emitter.exitance;
  }
  return direct;
}

}  // namespace tenku
