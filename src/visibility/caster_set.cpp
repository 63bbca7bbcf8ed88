#include "visibility/caster_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tenku {
namespace {

constexpr std::uint32_t kChunk = 128;  // casters in one box

struct Bounds {
  Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

/// Bits of a number of 16 bits, each with two zeros after it.
std::uint64_t spread(std::uint64_t bits) {
  std::uint64_t wide = 0;
  for (unsigned k = 0; k < 16; ++k) wide |= (bits >> k & 1U) << (3 * k);
  return wide;
}

/// Place on the Z-shaped curve through the bounds: near numbers are near in space.
std::uint64_t curve_place(Vec3 p, const Bounds& bounds) {
  const auto step = [](double x, double low, double high) {
    const double share = high > low ? (x - low) / (high - low) : 0.0;
    return spread(static_cast<std::uint64_t>(65535.0 * std::clamp(share, 0.0, 1.0)));
  };
  return step(p.x, bounds.low.x, bounds.high.x) | step(p.y, bounds.low.y, bounds.high.y) << 1U |
         step(p.z, bounds.low.z, bounds.high.z) << 2U;
}

double reach(Vec3 axis, Vec3 half) {
  return std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
}

}  // namespace

CasterSet::CasterSet(const TriangleSoup& soup, const std::vector<Material>& materials)
    : soup_(soup), adjacency_(soup), plane_(soup.size()) {
  Bounds all;
  for (const Vec3& v : soup.vertices) all.add(v);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places;
  for (std::uint32_t t = 0; t < soup.size(); ++t) {
    if (materials[soup.material[t]].is_glass()) continue;
    const Vec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
    const Vec3 normal = normalized(cross(b - a, c - a));
    if (!is_finite(normal)) continue;
    plane_[t] = {normal, dot(normal, a)};
    places.emplace_back(curve_place((1.0 / 3.0) * (a + b + c), all), t);
  }
  std::sort(places.begin(), places.end());
  for (const auto& [place, t] : places) order_.push_back(t);
  const auto count = static_cast<std::uint32_t>(order_.size());
  for (std::uint32_t first = 0; first < count; first += kChunk) {
    const CasterRange range{first, std::min(kChunk, count - first)};
    Bounds bounds;
    for (std::uint32_t k = 0; k < 3 * range.count; ++k) {
      bounds.add(corner(order_[first + k / 3], k % 3));
    }
    chunk_.push_back({range, 0.5 * (bounds.low + bounds.high), 0.5 * (bounds.high - bounds.low)});
  }
}

std::vector<CasterVertex> CasterSet::vertices(Vec3 origin) const {
  std::vector<CasterVertex> made;
  made.reserve(3 * order_.size());
  for (const std::uint32_t t : order_) {
    for (unsigned k = 0; k < 3; ++k) {
      const Vec3 p = corner(t, k) - origin;
      made.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), t + 1});
    }
  }
  return made;
}

Cover CasterSet::cover(std::uint32_t triangle, Vec3 point, Vec3 toward_light,
                       double tolerance_m) const {
  constexpr int kSteps = 12;
  // Where the light sees `at` to an edge: the sign tells the side, and is the same for both of the
  // triangles that share it.
  const auto side = [&](Vec3 a, Vec3 b, Vec3 at) {
    return dot(toward_light, cross(a - at, b - at));
  };
  for (int step = 0; step < kSteps; ++step) {
    unsigned out = 3;
    for (unsigned e = 0; e < 3 && out == 3; ++e) {
      const Vec3 a = corner(triangle, e), b = corner(triangle, (e + 1) % 3);
      const double inner = side(a, b, corner(triangle, (e + 2) % 3)), outer = side(a, b, point);
      if (inner == 0.0) return Cover::Beside;  // seen edge-on
      if (inner > 0.0 ? outer < 0.0 : outer > 0.0) out = e;
    }
    if (out == 3) {
      const CasterPlane& p = plane_[triangle];
      const double before = dot(p.normal, point) - p.offset;
      const bool is_behind = (dot(p.normal, toward_light) < 0.0 ? -before : before) < -tolerance_m;
      return is_behind ? Cover::Hides : Cover::Beside;
    }
    const std::uint32_t opposite = adjacency_.opposite(triangle, out);
    if (opposite == MeshAdjacency::kNone || !is_caster(opposite / 3)) return Cover::Beside;
    const Vec3 a = corner(triangle, out), b = corner(triangle, (out + 1) % 3);
    triangle = opposite / 3;
    const double beyond = side(a, b, corner(triangle, (opposite + 2) % 3));
    // Where the mesh turns back is its outline.
    if (!(beyond > 0.0 ? side(a, b, point) > 0.0 : side(a, b, point) < 0.0)) return Cover::Beside;
  }
  return Cover::Unknown;
}

double CasterSet::width_m(std::uint32_t triangle, Vec3 direction) const {
  double longest = 0.0;
  for (unsigned k = 0; k < 3; ++k) {
    longest = std::max(
        longest, length(cross(direction, corner(triangle, (k + 1) % 3) - corner(triangle, k))));
  }
  const double twice_area =
      std::abs(dot(direction, cross(corner(triangle, 1) - corner(triangle, 0),
                                    corner(triangle, 2) - corner(triangle, 0))));
  return longest > 0.0 ? twice_area / longest : 0.0;
}

CasterSet::Selection CasterSet::before(const LightBox& box) const {
  Selection found{{}, box.high.z};
  for (const Chunk& chunk : chunk_) {
    const auto overlaps = [&](Vec3 axis, double low, double high) {
      const double at = dot(axis, chunk.centre), about = reach(axis, chunk.half);
      return at + about >= low && at - about <= high;
    };
    if (!overlaps(box.u, box.low.x, box.high.x) || !overlaps(box.v, box.low.y, box.high.y)) {
      continue;
    }
    const double top = dot(box.w, chunk.centre) + reach(box.w, chunk.half);
    if (top < box.low.z) continue;
    found.nearest = std::max(found.nearest, top);
    auto& ranges = found.casters;
    if (!ranges.empty() && ranges.back().first + ranges.back().count == chunk.range.first) {
      ranges.back().count += chunk.range.count;
    } else {
      ranges.push_back(chunk.range);
    }
  }
  return found;
}

}  // namespace tenku
