#include "visibility/caster_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tenku {
namespace {

constexpr std::uint32_t kChunk = 128;  // casters in one box

/// Bits of a number of 16 bits, each with two zeros after it.
std::uint64_t spread(std::uint64_t bits) {
  std::uint64_t wide = 0;
  for (unsigned k = 0; k < 16; ++k) wide |= (bits >> k & 1U) << (3 * k);
  return wide;
}

/// Place on the Z-shaped curve through the bounds: near numbers are near in space.
std::uint64_t curve_place(Vec3 p, const Extent& bounds) {
  const auto step = [](double x, double low, double high) {
    const double share = high > low ? (x - low) / (high - low) : 0.0;
    return spread(static_cast<std::uint64_t>(65535.0 * std::clamp(share, 0.0, 1.0)));
  };
  return step(p.x, bounds.min.x, bounds.max.x) | step(p.y, bounds.min.y, bounds.max.y) << 1U |
         step(p.z, bounds.min.z, bounds.max.z) << 2U;
}

double half_extent(Vec3 axis, Vec3 half) {
  return std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
}

}  // namespace

LightAxes::LightAxes(Vec3 direction) : w(direction) {
  const double level = std::hypot(w.x, w.y);
  u = level > 1e-9 ? Vec3{-w.y / level, w.x / level, 0.0} : Vec3{1.0, 0.0, 0.0};
  v = cross(w, u);
}

LightCells::LightCells(double low_u, double low_v, double high_u, double high_v)
    : low_u_(low_u),
      low_v_(low_v),
      per_u_(kSide / (high_u - low_u)),
      per_v_(kSide / (high_v - low_v)),
      count_((kSide + 1) * (kSide + 1)) {}

void LightCells::add(double u, double v) {
  const int i = cell((u - low_u_) * per_u_), j = cell((v - low_v_) * per_v_);
  ++count_[static_cast<std::size_t>((j + 1) * (kSide + 1) + i + 1)];
}

void LightCells::sum_up() {
  constexpr std::size_t kRow = kSide + 1;
  for (std::size_t k = kRow; k < count_.size(); ++k) {
    if (k % kRow != 0) count_[k] += count_[k - 1] + count_[k - kRow] - count_[k - kRow - 1];
  }
}

bool LightCells::has_points(double low_u, double low_v, double high_u, double high_v) const {
  const int left = cell((low_u - low_u_) * per_u_), right = cell((high_u - low_u_) * per_u_) + 1;
  const int low = cell((low_v - low_v_) * per_v_), high = cell((high_v - low_v_) * per_v_) + 1;
  const auto sum = [&](int i, int j) {
    return count_[static_cast<std::size_t>(j * (kSide + 1) + i)];
  };
  return sum(right, high) + sum(left, low) > sum(left, high) + sum(right, low);
}

CasterSet::CasterSet(const TriangleSoup& soup, const std::vector<Material>& materials)
    : soup_(soup), adjacency_(soup), plane_(soup.size()) {
  Extent all;
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
    Extent bounds;
    for (std::uint32_t k = 0; k < 3 * range.count; ++k) {
      bounds.add(corner(order_[first + k / 3], k % 3));
    }
    chunk_.push_back({range, bounds.middle(), 0.5 * bounds.size()});
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

Cover CasterSet::cover(std::uint32_t triangle, Vec3 point, const LightAxes& axes,
                       double tolerance_m) const {
  constexpr int kSteps = 12;
  struct Seen {
    double u, v;  // from the point, as the light sees it
  };
  const auto seen = [&](std::uint32_t t, unsigned k) {
    const Vec3 from_point = corner(t, k) - point;
    return Seen{dot(axes.u, from_point), dot(axes.v, from_point)};
  };
  // The sign tells the side of an edge; it is the same for both triangles that share the edge.
  const auto turn = [](Seen a, Seen b) { return a.u * b.v - a.v * b.u; };
  for (int step = 0; step < kSteps; ++step) {
    const std::array<Seen, 3> at{seen(triangle, 0), seen(triangle, 1), seen(triangle, 2)};
    const std::array<double, 3> side{turn(at[0], at[1]), turn(at[1], at[2]), turn(at[2], at[0])};
    const double area = side[0] + side[1] + side[2];
    if (area == 0.0) return Cover::Beside;  // seen edge-on
    const double sense = area > 0.0 ? 1.0 : -1.0;
    unsigned out = 0;
    while (out < 3 && sense * side[out] >= 0.0) ++out;
    if (out == 3) {
      return is_behind(triangle, point, axes.w, tolerance_m) ? Cover::Hides : Cover::Beside;
    }
    const std::uint32_t opposite = adjacency_.opposite(triangle, out);
    if (opposite == MeshAdjacency::kNone || !is_caster(opposite / 3)) return Cover::Beside;
    triangle = opposite / 3;
    const Seen a = at[out], b = at[(out + 1) % 3];
    const Seen c = seen(triangle, (opposite + 2) % 3);
    const double beyond = turn({a.u - c.u, a.v - c.v}, {b.u - c.u, b.v - c.v});
    if (!(sense * beyond < 0.0)) return Cover::Beside;  // where the mesh turns back is its outline
  }
  return Cover::Unknown;
}

bool CasterSet::shades_points(const Chunk& chunk, const LightBox& box) {
  const double u = dot(box.axes.u, chunk.centre), v = dot(box.axes.v, chunk.centre);
  const double wide = half_extent(box.axes.u, chunk.half),
               high = half_extent(box.axes.v, chunk.half);
  return box.cells->has_points(u - wide, v - high, u + wide, v + high);
}

CasterSet::Selection CasterSet::before(const LightBox& box, const Extent& reach) const {
  Selection found{{}, box.high.z};
  const auto is_within = [&](const Chunk& chunk) {
    const Vec3 from = chunk.centre - chunk.half, to = chunk.centre + chunk.half;
    return to.x >= reach.min.x && to.y >= reach.min.y && to.z >= reach.min.z &&
           from.x <= reach.max.x && from.y <= reach.max.y && from.z <= reach.max.z;
  };
  for (const Chunk& chunk : chunk_) {
    if (!is_within(chunk)) continue;
    const auto overlaps = [&](Vec3 axis, double low, double high) {
      const double at = dot(axis, chunk.centre), about = half_extent(axis, chunk.half);
      return at + about >= low && at - about <= high;
    };
    if (!overlaps(box.axes.u, box.low.x, box.high.x) ||
        !overlaps(box.axes.v, box.low.y, box.high.y)) {
      continue;
    }
    if (box.cells != nullptr && !shades_points(chunk, box)) continue;
    const double top = dot(box.axes.w, chunk.centre) + half_extent(box.axes.w, chunk.half);
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
