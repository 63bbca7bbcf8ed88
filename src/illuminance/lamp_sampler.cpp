#include "illuminance/lamp_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/soup_triangle.h"

namespace tenku {

LampSampler::LampSampler(const RayVisibility& rays) : rays_(rays) {
  const TriangleSoup& soup = rays.soup();
  for (std::uint32_t t = 0; t < soup.size(); ++t) {
    if (!(luminance_of(rays.materials()[soup.material[t]].emission_lm_m2) > 0.0)) continue;
    if (!(area_m2(soup, t) > 0.0)) continue;
    triangle_.push_back(t);
  }
  if (triangle_.empty()) return;
  divide(0, static_cast<std::uint32_t>(triangle_.size()), kMostGroups);
  place_of_.assign(soup.size(), kNone);
  for (std::uint32_t k = 0; k < triangle_.size(); ++k) place_of_[triangle_[k]] = k;
}

/// At the middle of the longest side, again and again.
void LampSampler::divide(std::uint32_t begin, std::uint32_t end, std::size_t most) {
  if (most == 1 || end - begin == 1) {
    const Group group = group_of(begin, end);
    group_of_.insert(group_of_.end(), end - begin, static_cast<std::uint32_t>(group_.size()));
    group_.push_back(group);
    return;
  }
  const TriangleSoup& soup = rays_.soup();
  Vec3 low = middle_of(soup, triangle_[begin]), high = low;
  for (std::uint32_t k = begin; k < end; ++k) {
    const Vec3 at = middle_of(soup, triangle_[k]);
    low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
  }
  const Vec3 size = high - low;
  const auto along = [&](std::uint32_t t) {
    const Vec3 at = middle_of(soup, t);
    return size.x >= std::max(size.y, size.z) ? at.x : size.y >= size.z ? at.y : at.z;
  };
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(triangle_.begin() + begin, triangle_.begin() + half, triangle_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return along(a) != along(b) ? along(a) < along(b) : a < b;
                   });
  divide(begin, half, most / 2);
  divide(half, end, most - most / 2);
}

LampSampler::Group LampSampler::group_of(std::uint32_t begin, std::uint32_t end) {
  const TriangleSoup& soup = rays_.soup();
  Group group{begin, end, {}, 0.0, 0.0, 0.0};
  for (std::uint32_t k = begin; k < end; ++k) {
    const double area = area_m2(soup, triangle_[k]);
    const Material& material = rays_.materials()[soup.material[triangle_[k]]];
    group.area_m2 += area;
    group.flux_lm += area * luminance_of(material.emission_lm_m2);
    group.centre = group.centre + area * middle_of(soup, triangle_[k]);
    flux_to_lm_.push_back(group.flux_lm);
  }
  group.centre = (1.0 / group.area_m2) * group.centre;
  for (std::uint32_t k = begin; k < end; ++k) {
    for (const Vec3 corner : corners_of(soup, triangle_[k])) {
      group.radius_m = std::max(group.radius_m, length(corner - group.centre));
    }
  }
  return group;
}

LampSampler::View::View(const LampSampler& lamps, Vec3 position, Vec3 normal) : lamps_(lamps) {
  for (const Group& group : lamps.group_) {
    const Vec3 way = group.centre - position;
    const double away = std::max(length(way), group.radius_m),
                 height = std::min(dot(way, normal) + group.radius_m, away);
    const double per_m2 = std::max(height, 0.0) / (kPi * away * away * away);
    weight_.push_back(per_m2 * group.flux_lm);
    sum_ += weight_.back();
    fill_ += per_m2 * group.area_m2;
  }
}

LampSampler::Point LampSampler::View::choose(double u, double v) const {
  double rest = u * sum_;
  std::size_t g = 0;
  while (g + 1 < weight_.size() && rest >= weight_[g]) rest -= weight_[g++];
  while (!(weight_[g] > 0.0)) --g;  // rounding has led past the last that counts
  const Group& group = lamps_.group_[g];
  const double lm = std::clamp(rest / weight_[g], 0.0, 1.0) * group.flux_lm;
  const auto begin = lamps_.flux_to_lm_.begin() + group.begin;
  const auto found = std::min(std::upper_bound(begin, begin + (group.end - group.begin), lm),
                              begin + (group.end - group.begin - 1));
  const double before = found == begin ? 0.0 : *(found - 1);
  const double within = std::clamp((lm - before) / (*found - before), 0.0, 1.0);
  const std::uint32_t triangle =
      lamps_.triangle_[group.begin + static_cast<std::uint32_t>(found - begin)];
  const auto [a, b, c] = corners_of(lamps_.rays_.soup(), triangle);
  const double root = std::sqrt(within);
  return {triangle, a + root * (1.0 - v) * (b - a) + root * v * (c - a)};
}

double LampSampler::View::density(std::uint32_t triangle, Vec3 way) const {
  const std::uint32_t place = lamps_.place_of_[triangle];
  if (place == kNone) return 0.0;
  const std::uint32_t g = lamps_.group_of_[place];
  const RayVisibility& rays = lamps_.rays_;
  const double exitance =
      luminance_of(rays.materials()[rays.soup().material[triangle]].emission_lm_m2);
  const double per_m2 = weight_[g] / sum_ * exitance / lamps_.group_[g].flux_lm;
  const double away = length(way), across = std::abs(dot(way, rays.normal(triangle)));
  return per_m2 * away * away * away / across;
}

}  // namespace tenku
