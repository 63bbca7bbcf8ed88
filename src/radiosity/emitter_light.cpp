#include "radiosity/emitter_light.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/parallel.h"
#include "core/random.h"
#include "form_factors/contour_factor.h"

namespace tenku {
namespace {

constexpr int kFirstRays = 16;  // at most, that must agree
constexpr int kMoreRays = 4;    // times as many where they do not
constexpr double kFar = 4.0;    // radii, beyond which a lamp is a point for the first look
constexpr std::size_t kGrain = 64;
constexpr double kEdgeVariance = 0.19;
constexpr double kFlush = 1e-4;  // of the distance: what is met so near the lamp is part of it

std::array<Vec3, 3> corners_of(const ElementMesh& mesh, std::size_t element) {
  const auto& [a, b, c] = mesh.elements[element];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// Source  E. Heitz, "A low-distortion map between triangle and square", 2019.
Vec3 on_triangle(const std::array<Vec3, 3>& t, double u, double v) {
  const double a = v > u ? 0.5 * u : u - 0.5 * v, b = v > u ? v - 0.5 * u : 0.5 * v;
  return a * t[0] + b * t[1] + (1.0 - a - b) * t[2];
}

/// Edges of only one element.
std::vector<std::array<Vec3, 2>> outline_of(const ElementMesh& mesh,
                                            std::span<const std::uint32_t> elements) {
  std::map<std::uint32_t, std::set<std::uint32_t>> next;
  for (const std::uint32_t e : elements) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.elements[e][k], b = mesh.elements[e][(k + 1) % 3];
      if (next[b].erase(a) == 0) next[a].insert(b);
    }
  }
  std::vector<std::array<Vec3, 2>> outline;
  for (const auto& [a, ends] : next) {
    for (const std::uint32_t b : ends) outline.push_back({mesh.vertices[a], mesh.vertices[b]});
  }
  return outline;
}

/// Van der Corput's sequence.
double radical_inverse(std::uint32_t k) {
  double result = 0.0, digit = 0.5;
  for (; k > 0; k >>= 1U, digit *= 0.5) {
    if ((k & 1U) != 0) result += digit;
  }
  return result;
}

}  // namespace

bool EmitterLight::Direct::has(std::uint32_t one) const {
  return std::binary_search(lamp.begin(), lamp.end(), one);
}

EmitterLight::EmitterLight(const ElementMesh& mesh, const SidePoints& points,
                           const SurfaceLight& surfaces, std::uint64_t seed)
    : mesh_(mesh), seed_(seed), lamp_of_(mesh.size(), kNoLamp) {
  if (!surfaces.any_emits) return;
  find_lamps(points, surfaces);
  if (lamp_.size() > kMostLamps) {
    lamp_.clear();
    lamp_of_.assign(mesh.size(), kNoLamp);
    return;
  }
  soup_ = soup_of(mesh);
  rays_ = std::make_unique<RayVisibility>(soup_.soup, soup_.materials);
}

void EmitterLight::find_lamps(const SidePoints& points, const SurfaceLight& surfaces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number;
  for (std::uint32_t e = 0; e < mesh_.size(); ++e) {
    if (!surfaces.emits(e)) continue;
    const std::pair key{points.plane[points.corner[2 * e][0]], mesh_.material[e]};
    const auto [found, is_new] = number.emplace(key, static_cast<std::uint32_t>(lamp_.size()));
    if (is_new) lamp_.emplace_back();
    Lamp& lamp = lamp_[found->second];
    const double before = is_new ? 0.0 : lamp.area_m2();
    lamp_of_[e] = found->second;
    lamp.element.push_back(e);
    lamp.area_to.push_back(before + surfaces.area_m2[e]);
    lamp.centre = lamp.centre + surfaces.area_m2[e] * mesh_.centre(e);
    lamp.normal = mesh_.normal(2 * e);
    lamp.exitance = surfaces.emission_lm_m2[e];
  }
  for (Lamp& lamp : lamp_) {
    lamp.outline = outline_of(mesh_, lamp.element);
    lamp.centre = (1.0 / lamp.area_m2()) * lamp.centre;
    for (const std::uint32_t e : lamp.element) {
      for (const Vec3 corner : corners_of(mesh_, e)) {
        lamp.radius_m = std::max(lamp.radius_m, length(corner - lamp.centre));
      }
    }
  }
}

double EmitterLight::rough_factor(const Lamp& lamp, Vec3 position, Vec3 normal) const {
  const Vec3 way = lamp.centre - position;
  const double away = length(way), height = dot(way, normal);
  if (height < -lamp.radius_m) return 0.0;
  if (away < kFar * lamp.radius_m || height < lamp.radius_m) return factor(lamp, position, normal);
  return lamp.area_m2() * height * std::abs(dot(way, lamp.normal)) / (kPi * std::pow(away, 4));
}

double EmitterLight::factor(const Lamp& lamp, Vec3 position, Vec3 normal) const {
  const bool is_whole =
      std::all_of(lamp.outline.begin(), lamp.outline.end(),
                  [&](const auto& edge) { return dot(edge[0] - position, normal) >= 0.0; });
  if (is_whole) return contour_factor_of_edges(position, normal, lamp.outline);
  double sum = 0.0;
  for (const std::uint32_t e : lamp.element) {
    sum += contour_factor(position, normal, corners_of(mesh_, e));
  }
  return sum;
}

bool EmitterLight::hides(std::uint32_t element, std::uint32_t lamp, Vec3 point, double away) const {
  if (element == RayVisibility::kNoTriangle || lamp_of_[element] == lamp) return false;
  const Vec3 of_lamp = point - mesh_.vertices[mesh_.elements[element][0]];
  return std::abs(dot(mesh_.normal(2 * std::size_t{element}), of_lamp)) > kFlush * away;
}

double EmitterLight::seen(std::uint32_t number, Vec3 position, Vec3 normal, int rays) const {
  const Lamp& lamp = lamp_[number];
  std::uint64_t key = mix_bits(seed_ + number);
  for (const double x : {position.x, position.y, position.z}) {
    key = mix_bits(key + std::bit_cast<std::uint64_t>(x + 0.0));
  }
  SampleRandom random(key, static_cast<std::uint64_t>(rays), 0);
  const double start = random.uniform(), turn = random.uniform();
  std::vector<Vec3> point, direction;
  std::vector<double> weight;
  // A regular row of points along the areas of all elements, across them by van der Corput's.
  for (int k = 0; k < rays; ++k) {
    const double area = lamp.area_m2() * (k + start) / rays;
    const auto found = std::upper_bound(lamp.area_to.begin(), lamp.area_to.end(), area);
    const auto i = static_cast<std::size_t>(
        std::min(found - lamp.area_to.begin(), std::ssize(lamp.area_to) - 1));
    const double before = i == 0 ? 0.0 : lamp.area_to[i - 1];
    const double u = std::clamp((area - before) / (lamp.area_to[i] - before), 0.0, 1.0);
    double v = radical_inverse(static_cast<std::uint32_t>(k)) + turn;
    v -= std::floor(v);
    const Vec3 at = on_triangle(corners_of(mesh_, lamp.element[i]), u, v), way = at - position;
    if (!(dot(way, normal) > 0.0)) continue;
    const double away = length(way);
    point.push_back(at);
    direction.push_back((1.0 / away) * way);
    weight.push_back(dot(way, normal) * std::abs(dot(way, lamp.normal)) /
                     (away * away * away * away));
  }
  std::vector<std::uint32_t> met(direction.size());
  rays_->first_triangles(position, direction, met);
  double all = 0.0, lit = 0.0;
  for (std::size_t k = 0; k < met.size(); ++k) {
    all += weight[k];
    const double away = length(point[k] - position);
    if (hides(met[k], number, point[k], away)) continue;
    lit += weight[k] * rays_->glass_transmission(position, direction[k], away);
  }
  return all > 0.0 ? lit / all : 0.0;
}

EmitterLight::Direct EmitterLight::at(Vec3 position, Vec3 normal, int rays,
                                      std::span<const std::uint8_t> in_sight) const {
  std::vector<double> rough;
  double sum = 0.0;
  for (std::size_t k = 0; k < lamp_.size(); ++k) {
    const bool is_hidden = !in_sight.empty() && in_sight[k] == 0;
    rough.push_back(is_hidden ? 0.0 : rough_factor(lamp_[k], position, normal));
    sum += rough.back() * luminance_of(lamp_[k].exitance);
  }
  Direct direct;
  const int first = std::min(kFirstRays, rays / 8);
  if (std::accumulate(rough.begin(), rough.end(), 0.0) > kMostView) return direct;
  for (std::uint32_t k = 0; k < lamp_.size(); ++k) {
    const double lm = luminance_of(lamp_[k].exitance);
    if (!(rough[k] * lm > 0.0) || rough[k] * lm < kFaint * sum) continue;
    add_lamp(k, position, normal, {first, rays}, direct);
  }
  return direct;
}

void EmitterLight::add_lamp(std::uint32_t number, Vec3 position, Vec3 normal, Rays rays,
                            Direct& direct) const {
  const Lamp& lamp = lamp_[number];
  const double lm = luminance_of(lamp.exitance);
  direct.lamp.push_back(number);
  double share = seen(number, position, normal, rays.first);
  if (!(share > 0.0)) return;
  const double whole = factor(lamp, position, normal);
  if (share < 1.0 - 1e-12) {
    double deviation = 0.0;
    for (int n = kMoreRays * rays.first;; n *= kMoreRays) {
      share = seen(number, position, normal, n);
      deviation = whole * std::sqrt(kEdgeVariance / std::pow(n, 1.5));
      const double light = whole * share * lm + luminance_of(direct.lux);
      if (n >= rays.most || deviation * lm <= kSettled * light) break;
    }
    direct.variance += std::pow(deviation * lm, 2);
  }
  direct.lux = direct.lux + (whole * share) * lamp.exitance;
}

EmitterLight::Direct EmitterLight::at_pixel(Vec3 position, Vec3 normal, PixelLook look) const {
  const Rays rays =
      look == PixelLook::OnEdges ? Rays{kEdgeFirst, kEdgeMost} : Rays{kPixelFirst, kPixelMost};
  std::vector<double> rough_lm;
  for (const Lamp& lamp : lamp_) {
    rough_lm.push_back(rough_factor(lamp, position, normal) * luminance_of(lamp.exitance));
  }
  const double sum = std::accumulate(rough_lm.begin(), rough_lm.end(), 0.0);
  Direct direct;
  for (std::uint32_t k = 0; k < lamp_.size(); ++k) {
    const double share = rough_lm[k] / sum;
    if (!(rough_lm[k] > 0.0) || share < kFaint) continue;
    if (look == PixelLook::Names) {
      direct.lamp.push_back(k);
      continue;
    }
    const int first = std::max(rays.first / 8, static_cast<int>(share * rays.first));
    add_lamp(k, position, normal, {first, rays.most}, direct);
  }
  return direct;
}

std::vector<EmitterLight::Direct> EmitterLight::at_pixels(const Sensors& points, double lift_m,
                                                          PixelLook look) const {
  std::vector<Direct> light(points.size());
  if (!is_any()) return light;
  parallel_for(points.size(), kGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      light[i] = at_pixel(points.position[i] + lift_m * points.normal[i], points.normal[i], look);
    }
  });
  return light;
}

}  // namespace tenku
