#include "visibility/floating_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr double kAir_m = 0.3;                // under what floats
constexpr double kFeet_m = 0.3;               // up from the lowest point
constexpr double kReachesOut = 0.1;           // of its width, and
constexpr double kReachesOut_m = 0.3;         // at least so far
constexpr double kCovers = 1.2;               // times the box of its plan: two sides of it
constexpr double kTwoSided = 0.5;             // of what lies above the feet faces up and down alike
constexpr std::size_t kMostTriangles = 1000;  // of a part
constexpr double kCell_m = 50.0;

/// The triangles of each connected part, one part after the other.
struct Connected {
  std::vector<std::uint32_t> triangle, end;
  std::vector<std::uint32_t> part_of;  ///< [triangle of the soup]
};

Connected connected_parts(const TriangleSoup& soup, const MeshAdjacency& adjacency,
                          const std::vector<bool>& is_opaque) {
  Connected parts;
  parts.triangle.reserve(soup.size());
  parts.part_of.resize(soup.size());
  std::vector<bool> is_taken(soup.size(), false);
  for (std::uint32_t first = 0; first < soup.size(); ++first) {
    if (is_taken[first] || !is_opaque[first]) continue;
    is_taken[first] = true;
    std::size_t next = parts.triangle.size();
    parts.triangle.push_back(first);
    for (; next < parts.triangle.size(); ++next) {
      for (unsigned e = 0; e < 3; ++e) {
        const std::uint32_t opposite = adjacency.opposite(parts.triangle[next], e);
        if (opposite == MeshAdjacency::kNone) continue;
        const std::uint32_t other = opposite / 3;
        if (is_taken[other] || !is_opaque[other]) continue;
        is_taken[other] = true;
        parts.triangle.push_back(other);
      }
    }
    const std::size_t begin = parts.end.empty() ? 0 : parts.end.back();
    for (std::size_t k = begin; k < parts.triangle.size(); ++k) {
      parts.part_of[parts.triangle[k]] = static_cast<std::uint32_t>(parts.end.size());
    }
    parts.end.push_back(static_cast<std::uint32_t>(parts.triangle.size()));
  }
  return parts;
}

/// A box in plan.
struct Plan {
  double west = std::numeric_limits<double>::infinity(), east = -west, south = west, north = -west;

  void add(Vec3 p) {
    west = std::min(west, p.x), east = std::max(east, p.x);
    south = std::min(south, p.y), north = std::max(north, p.y);
  }
  double width() const { return std::max(east - west, north - south); }
  double area() const { return (east - west) * (north - south); }
  double beyond(const Plan& other) const {
    return std::max(
        {other.west - west, east - other.east, other.south - south, north - other.north});
  }
};

/// Positive where the corners run counter-clockwise, seen from above.
double area_in_plan(Vec3 p, Vec3 q, Vec3 r) {
  return 0.5 * ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
}

/// What one part is like, before it is known whether it floats.
FloatingPart measured(const TriangleSoup& soup, std::span<const std::uint32_t> triangles,
                      Vec3& foot) {
  FloatingPart part;
  Plan whole, feet;
  part.lowest = std::numeric_limits<double>::infinity(), part.highest = -part.lowest;
  double covered = 0.0;
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = soup.triangles[t];
    const Vec3 &p = soup.vertices[a], &q = soup.vertices[b], &r = soup.vertices[c];
    covered += std::abs(area_in_plan(p, q, r));
    for (const Vec3& v : {p, q, r}) {
      whole.add(v);
      part.lowest = std::min(part.lowest, v.z), part.highest = std::max(part.highest, v.z);
    }
  }
  Vec3 sum;
  double count = 0.0, up = 0.0, down = 0.0;
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = soup.triangles[t];
    bool is_above = true;
    for (const std::uint32_t v : {a, b, c}) {
      const Vec3& p = soup.vertices[v];
      if (p.z > part.lowest + kFeet_m) continue;
      is_above = false;
      feet.add(p);
      sum = sum + p, count += 1.0;
    }
    if (!is_above) continue;
    const double area = area_in_plan(soup.vertices[a], soup.vertices[b], soup.vertices[c]);
    (area > 0.0 ? up : down) += std::abs(area);
  }
  foot = (1.0 / count) * sum;
  foot.z = part.lowest;
  part.middle = {0.5 * (whole.west + whole.east), 0.5 * (whole.south + whole.north),
                 0.5 * (part.lowest + part.highest)};
  part.radius = 0.5 * std::hypot(whole.east - whole.west, whole.north - whole.south);
  const bool reaches_out =
      whole.beyond(feet) > std::max(kReachesOut_m, kReachesOut * whole.width()) &&
      covered > kCovers * whole.area();
  // A bridge stands on both of its ends; a house has one roof above its feet.
  const bool spans = 2.0 * std::min(up, down) > kTwoSided * (up + down);
  part.overhangs = reaches_out || spans;
  return part;
}

/// Whether nothing else lies within kAir_m below the foot of a part.
bool has_air_below(Vec3 foot, std::uint32_t part, const Connected& all,
                   const FloatingParts::LookDown& look_down) {
  constexpr double kAbove_m = 0.02, kPast_m = 1e-3;
  constexpr int kMostOwn = 8;  // surfaces of its own on the way
  Vec3 from = foot + Vec3{0.0, 0.0, kAbove_m};
  for (int k = 0; k < kMostOwn; ++k) {
    const auto below = look_down(from);
    if (!below) return true;
    if (all.part_of[below->triangle] != part) {
      return from.z - below->distance_m < foot.z - kAir_m;
    }
    from.z -= below->distance_m + kPast_m;
  }
  return true;
}

}  // namespace

FloatingParts::FloatingParts(const TriangleSoup& soup, const MeshAdjacency& adjacency,
                             const std::vector<bool>& is_opaque, const LookDown& look_down) {
  const Connected all = connected_parts(soup, adjacency, is_opaque);
  std::vector<FloatingPart> found(all.end.size());
  std::vector<char> floats(all.end.size(), 0);
  constexpr std::size_t kGrain = 64;
  parallel_for(found.size(), kGrain, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      const std::uint32_t begin = k == 0 ? 0 : all.end[k - 1];
      const std::span<const std::uint32_t> triangles(all.triangle.data() + begin,
                                                     all.end[k] - begin);
      if (triangles.size() > kMostTriangles) continue;
      Vec3 foot;
      found[k] = measured(soup, triangles, foot);
      found[k].begin = begin, found[k].end = all.end[k];
      floats[k] =
          found[k].overhangs || has_air_below(foot, static_cast<std::uint32_t>(k), all, look_down);
    }
  });
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (floats[k] == 0) continue;
    FloatingPart part = found[k];
    part.begin = static_cast<std::uint32_t>(triangle_.size());
    triangle_.insert(triangle_.end(), all.triangle.begin() + found[k].begin,
                     all.triangle.begin() + found[k].end);
    part.end = static_cast<std::uint32_t>(triangle_.size());
    parts_.push_back(part);
  }
  put_in_cells();
}

void FloatingParts::put_in_cells() {
  const auto cell_of = [](const FloatingPart& part) {
    return std::pair(std::llround(part.middle.x / kCell_m), std::llround(part.middle.y / kCell_m));
  };
  std::stable_sort(parts_.begin(), parts_.end(),
                   [&](const auto& a, const auto& b) { return cell_of(a) < cell_of(b); });
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    if (i == 0 || cell_of(parts_[i]) != cell_of(parts_[i - 1])) {
      const auto [column, row] = cell_of(parts_[i]);
      Cell& made = cells_.emplace_back();
      made.middle = {kCell_m * static_cast<double>(column), kCell_m * static_cast<double>(row),
                     0.0};
      made.begin = i;
    }
    Cell& cell = cells_.back();
    cell.end = i + 1;
    const Vec3& m = parts_[i].middle;
    cell.radius = std::max(cell.radius, std::hypot(m.x - cell.middle.x, m.y - cell.middle.y));
    cell.seen_below =
        std::max(cell.seen_below, parts_[i].overhangs ? parts_[i].highest : parts_[i].lowest);
    const double height = 0.5 * (parts_[i].highest - parts_[i].lowest);
    cell.largest = std::max(cell.largest, std::hypot(parts_[i].radius, height));
  }
}

void FloatingParts::around(Vec3 origin, std::size_t most, double least_rad,
                           std::vector<std::uint32_t>& found) const {
  const auto square = [](double x) { return x * x; };
  std::vector<std::pair<double, std::uint32_t>> seen;
  for (const Cell& cell : cells_) {
    if (cell.seen_below <= origin.z) continue;
    const double reach = cell.largest / least_rad + cell.radius;
    if (square(cell.middle.x - origin.x) + square(cell.middle.y - origin.y) > square(reach)) {
      continue;
    }
    for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
      const FloatingPart& part = parts_[i];
      if (part.highest <= origin.z || (!part.overhangs && part.lowest <= origin.z)) continue;
      const Vec3 to = part.middle - origin;
      const double size = square(part.radius) + square(0.5 * (part.highest - part.lowest));
      const double distance = dot(to, to);
      if (size > square(least_rad) * distance) {
        seen.emplace_back(-size / std::max(distance, 1e-18), i);
      }
    }
  }
  if (seen.size() > most) {
    std::nth_element(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(most), seen.end());
    seen.resize(most);
  }
  for (const auto& [size, i] : seen) found.push_back(i);
}

}  // namespace tenku
