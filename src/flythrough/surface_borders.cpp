#include "flythrough/surface_borders.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tenku {
namespace {

constexpr double kFlat = 0.9999;            // cosine between triangles of one plane
constexpr std::size_t kMostTriangles = 12;  // of the plane that are looked at
constexpr double kOneLine = 0.98;           // cosine between borders that count as one

struct Border {
  Vec3 inward;
  double distance;
};

class BorderSearch {
 public:
  BorderSearch(const RayVisibility& rays, Vec3 point, Vec3 normal, double reach)
      : rays_(rays), point_(point), normal_(normal), reach_(reach) {}

  std::vector<Border> find(std::uint32_t triangle) {
    known_.push_back(triangle);
    for (std::size_t k = 0; k < known_.size(); ++k) visit(known_[k]);
    std::sort(found_.begin(), found_.end(),
              [](const Border& a, const Border& b) { return a.distance < b.distance; });
    return std::move(found_);
  }

 private:
  void visit(std::uint32_t triangle) {
    const TriangleSoup& soup = rays_.soup();
    const auto& corner = soup.triangles[triangle];
    for (unsigned e = 0; e < 3; ++e) {
      const Vec3 a = soup.vertices[corner[e]], b = soup.vertices[corner[(e + 1) % 3]],
                 c = soup.vertices[corner[(e + 2) % 3]];
      const Vec3 along = b - a;
      const double whole = dot(along, along);
      if (!(whole > 0.0)) continue;
      const double at = std::clamp(dot(point_ - a, along) / whole, 0.0, 1.0);
      if (length(point_ - a - at * along) > reach_) continue;
      const std::uint32_t across = rays_.adjacency().opposite(triangle, e);
      if (across != MeshAdjacency::kNone && goes_on(triangle, across / 3)) {
        enter(across / 3);
        continue;
      }
      Vec3 inward = normalized(cross(normal_, along));
      if (dot(inward, c - a) < 0.0) inward = -inward;
      found_.push_back({inward, std::max(0.0, dot(point_ - a, inward))});
    }
  }

  bool goes_on(std::uint32_t from, std::uint32_t to) const {
    const TriangleSoup& soup = rays_.soup();
    return soup.material[from] == soup.material[to] &&
           std::abs(dot(rays_.normal(from), rays_.normal(to))) > kFlat;
  }

  void enter(std::uint32_t triangle) {
    if (known_.size() >= kMostTriangles) return;
    if (std::find(known_.begin(), known_.end(), triangle) == known_.end()) {
      known_.push_back(triangle);
    }
  }

  const RayVisibility& rays_;
  Vec3 point_, normal_;
  double reach_;
  std::vector<std::uint32_t> known_;
  std::vector<Border> found_;
};

}  // namespace

PointBorders borders_near(const RayVisibility& rays, std::uint32_t triangle, Vec3 point,
                          Vec3 normal, double footprint_m) {
  PointBorders borders;
  const double reach = PointBorders::kReach * footprint_m;
  const TangentFrame frame = tangent_frame(normal);
  std::vector<Border> kept;
  for (const Border& b : BorderSearch(rays, point, normal, reach).find(triangle)) {
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const Border& other) {
      return dot(other.inward, b.inward) > kOneLine;
    });
    if (is_known || kept.size() == 2 || b.distance > reach) continue;
    borders.set(kept.size(),
                std::atan2(dot(b.inward, frame.bitangent), dot(b.inward, frame.tangent)),
                b.distance / footprint_m);
    kept.push_back(b);
  }
  return borders;
}

}  // namespace tenku
