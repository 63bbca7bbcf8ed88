#include "meshing/polygon_outline.h"

#include <cstddef>
#include <cstdlib>
#include <set>

#include "meshing/point_tree.h"

namespace tenku {
namespace {

/// Leaves out the vertices between which a ring runs straight on.
std::vector<Vec3> corners_of(const std::vector<Vec3>& ring, double reach_m) {
  std::vector<Vec3> corners;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 before = corners.empty() ? ring[(i + n - 1) % n] : corners.back();
    const Vec3 after = ring[(i + 1) % n];
    const bool is_straight = distance_to_segment(ring[i], before, after) <= reach_m &&
                             dot(ring[i] - before, after - ring[i]) > 0.0;
    if (!is_straight) corners.push_back(ring[i]);
  }
  return corners;
}

/// Borders from end to end.
std::vector<std::vector<Vec3>> rings(std::vector<Border> once, std::span<const Vec3> vertices,
                                     double weld_m) {
  std::sort(once.begin(), once.end(), [](const Border& a, const Border& b) {
    return std::pair(a.from, a.to) < std::pair(b.from, b.to);
  });
  std::vector<std::uint8_t> is_used(once.size());
  const auto next_from = [&](std::uint32_t v) {
    auto i = static_cast<std::size_t>(
        std::lower_bound(once.begin(), once.end(), v,
                         [](const Border& b, std::uint32_t key) { return b.from < key; }) -
        once.begin());
    while (i < once.size() && once[i].from == v && is_used[i] != 0) ++i;
    return i < once.size() && once[i].from == v ? i : once.size();
  };
  std::vector<std::vector<Vec3>> made;
  for (std::size_t start = 0; start < once.size(); ++start) {
    std::vector<Vec3> ring;
    for (std::size_t i = start; i < once.size() && is_used[i] == 0; i = next_from(once[i].to)) {
      is_used[i] = 1;
      ring.push_back(vertices[once[i].from]);
    }
    ring = corners_of(ring, weld_m);
    if (ring.size() >= 3) made.push_back(std::move(ring));
  }
  return made;
}

}  // namespace

bool comes_before(const Border& a, const Border& b) {
  return a.key() != b.key() ? a.key() < b.key() : a.face < b.face;
}

Outline outline(std::vector<Border> borders, std::span<const Vec3> vertices, double weld_m) {
  std::sort(borders.begin(), borders.end(), comes_before);
  std::vector<Border> odd, layered;
  std::set<int> layers;
  for (std::size_t i = 0, end = 0; i < borders.size(); i = end) {
    int net = 0;  // times that it runs as the first of its kind, less those the other way
    for (end = i; end < borders.size() && borders[end].key() == borders[i].key(); ++end) {
      net += borders[end].from == borders[i].from ? 1 : -1;
    }
    if ((end - i) % 2 == 1) odd.push_back(borders[i]);
    if (net == 0) continue;
    layers.insert(std::abs(net));
    layered.push_back(borders[i]);
    if (net < 0) std::swap(layered.back().from, layered.back().to);
  }
  const bool is_layered = layers.size() == 1 && *layers.begin() > 1;
  return {rings(std::move(is_layered ? layered : odd), vertices, weld_m),
          is_layered ? *layers.begin() : 1};
}

void set_frame(FlatPolygon& polygon) {
  double longest = 0.0;
  for (const auto& ring : polygon.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 edge = ring[(i + 1) % ring.size()] - ring[i];
      // An edge must be clearly longer to be preferred, lest rounding choose.
      if (!(length(edge) > (1.0 + 1e-6) * longest)) continue;
      longest = length(edge);
      polygon.origin = ring[i];
      polygon.along = edge;
    }
  }
  polygon.along = normalized(polygon.along - dot(polygon.along, polygon.normal) * polygon.normal);
  polygon.across = cross(polygon.normal, polygon.along);
}

}  // namespace tenku
