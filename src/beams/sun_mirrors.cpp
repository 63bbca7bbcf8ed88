#include "beams/sun_mirrors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "beams/first_met.h"
#include "beams/mirror_reflectance.h"
#include "visibility/ray_visibility.h"

namespace tenku {
namespace {

constexpr double kOnePanel = 1.7e-3;      // sine of a tenth of a degree
constexpr double kFlat = 1e-6;            // sine: parts are joined where they are flat to that
constexpr std::size_t kMostJoined = 200;  // parts of a panel: joining tries every pair

std::uint32_t neighbour(const MeshAdjacency& adjacency, std::uint32_t triangle, unsigned edge) {
  const std::uint32_t across = adjacency.opposite(triangle, edge);
  return across == MeshAdjacency::kNone ? across : across / 3;
}

/// Two flat convex parts with an edge in common as one, if that is convex.
std::optional<MirrorPart> joined(const MirrorPart& a, const MirrorPart& b) {
  if (!(length(cross(a.normal, b.normal)) < kFlat)) return std::nullopt;
  const std::size_t n = a.corners.size(), m = b.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < m; ++j) {
      if (!(a.corners[i] == b.corners[(j + 1) % m] && a.corners[(i + 1) % n] == b.corners[j])) {
        continue;
      }
      MirrorPart both{{}, a.normal};
      for (std::size_t k = 1; k <= n; ++k) both.corners.push_back(a.corners[(i + k) % n]);
      for (std::size_t k = 2; k < m; ++k) both.corners.push_back(b.corners[(j + k) % m]);
      const std::size_t all = both.corners.size();
      for (std::size_t k = 0; k < all; ++k) {
        const Vec3 p = both.corners[k], q = both.corners[(k + 1) % all],
                   r = both.corners[(k + 2) % all];
        if (dot(cross(q - p, r - q), a.normal) < 0.0) return std::nullopt;
      }
      return both;
    }
  }
  return std::nullopt;
}

void join(std::vector<MirrorPart>& parts) {
  if (parts.size() > kMostJoined) return;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size();) {
      if (auto both = joined(parts[i], parts[j])) {
        parts[i] = std::move(*both);
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
        j = i + 1;
      } else {
        ++j;
      }
    }
  }
}

class PanelFinder {
 public:
  PanelFinder(const TriangleSoup& soup, const std::vector<Material>& materials,
              const MeshAdjacency& adjacency)
      : soup_(soup), materials_(materials), adjacency_(adjacency), is_taken_(soup.size()) {
    take_repeated();
  }

  std::vector<MirrorPanel> panels() {
    std::vector<MirrorPanel> result;
    for (std::uint32_t t = 0; t < soup_.size(); ++t) {
      if (is_free(t)) result.push_back(panel_from(t));
    }
    return result;
  }

 private:
  bool is_free(std::uint32_t t) const {
    return !is_taken_[t] && is_mirror(materials_[soup_.material[t]]) &&
           is_finite(normal_of(soup_, t));
  }

  /// A mirror that is there twice throws its light once.
  void take_repeated() {
    std::set<std::array<std::array<double, 3>, 3>> known;
    for (std::uint32_t t = 0; t < soup_.size(); ++t) {
      if (!is_free(t)) continue;
      std::array<std::array<double, 3>, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& v = soup_.vertices[soup_.triangles[t][k]];
        corners[k] = {v.x, v.y, v.z};
      }
      std::sort(corners.begin(), corners.end());
      if (!known.insert(corners).second) is_taken_[t] = true;
    }
  }

  MirrorPanel panel_from(std::uint32_t first) {
    MirrorPanel panel{soup_.object[first], soup_.material[first], {}, {}, 0.0, {}};
    const Vec3 normal = normal_of(soup_, first);
    std::vector<std::uint32_t> members{first};
    is_taken_[first] = true;
    for (std::size_t k = 0; k < members.size(); ++k) {
      for (unsigned edge = 0; edge < 3; ++edge) {
        const std::uint32_t t = neighbour(adjacency_, members[k], edge);
        if (t == MeshAdjacency::kNone || !is_free(t)) continue;
        if (soup_.object[t] != panel.object || soup_.material[t] != panel.material) continue;
        const Vec3 other = normal_of(soup_, t);
        if (!(length(cross(normal, other)) < kOnePanel && dot(normal, other) > 0.0)) continue;
        is_taken_[t] = true;
        members.push_back(t);
      }
    }
    fill(panel, members);
    return panel;
  }

  void fill(MirrorPanel& panel, const std::vector<std::uint32_t>& members) const {
    Vec3 sum{}, moment{};
    for (const std::uint32_t t : members) {
      const auto& [a, b, c] = soup_.triangles[t];
      const auto& v = soup_.vertices;
      const Vec3 area = 0.5 * cross(v[b] - v[a], v[c] - v[a]);
      sum = sum + area;
      panel.area_m2 += length(area);
      moment = moment + (length(area) / 3.0) * (v[a] + v[b] + v[c]);
      panel.parts.push_back({{v[a], v[b], v[c]}, normalized(area)});
    }
    panel.normal = normalized(sum);
    panel.middle = (1.0 / panel.area_m2) * moment;
    join(panel.parts);
  }

  const TriangleSoup& soup_;
  const std::vector<Material>& materials_;
  const MeshAdjacency& adjacency_;
  std::vector<bool> is_taken_;
};

}  // namespace

bool is_mirror(const Material& material) { return material.mirror > 0.0 || material.is_glass(); }

double mirrored_share(const Material& material, double cos_incidence) {
  return luminance_of(mirror_reflectance(material, cos_incidence));
}

std::vector<MirrorPanel> mirror_panels(const TriangleSoup& soup,
                                       const std::vector<Material>& materials,
                                       const MeshAdjacency& adjacency) {
  return PanelFinder(soup, materials, adjacency).panels();
}

}  // namespace tenku
