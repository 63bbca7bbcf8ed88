#include "beams/beam_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

namespace tenku {
namespace {

constexpr std::size_t kMostCorners = 12;
constexpr double kFlatness = 1e-9;  ///< off a plane, per metre of the scene's largest coordinate

struct PointHash {
  std::size_t operator()(const Vec3& p) const {
    const std::hash<double> hash;
    return hash(p.x) * 0x9e3779b97f4a7c15U ^ hash(p.y) * 0xc2b2ae3d27d4eb4fU ^ hash(p.z);
  }
};

/// A face in the making: a ring of welded vertices.
struct Ring {
  std::vector<std::uint32_t> vertex;
  std::vector<std::uint32_t> triangles;
  Plane plane;
};

class FaceJoiner {
 public:
  FaceJoiner(const TriangleSoup& soup, const std::vector<Material>& materials, double extent)
      : soup_(soup), materials_(materials), slack_(kFlatness * extent) {
    weld();
    for (std::uint32_t t = 0; t < soup.size(); ++t) add_triangle(t);
    // A ring may be joined at several of its edges; what is new borders on what was there.
    for (std::size_t k = 0; k < inner_.size(); ++k) join_across(inner_[k]);
  }

  std::vector<BeamFace> faces() const {
    std::vector<BeamFace> made;
    for (const Ring& ring : rings_) {
      if (ring.vertex.empty()) continue;
      const std::uint32_t t = ring.triangles.front();
      BeamFace face{{}, ring.plane, soup_.object[t], soup_.material[t], ring.triangles};
      for (const std::uint32_t v : ring.vertex) face.corners.push_back(soup_.vertices[v]);
      face.is_pane = materials_[face.material].is_glass();
      face.is_mirror = face.is_pane || materials_[face.material].mirror > 0.0;
      made.push_back(std::move(face));
    }
    return made;
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  void weld() {
    std::unordered_map<Vec3, std::uint32_t, PointHash> first;
    weld_.resize(soup_.vertices.size());
    for (std::uint32_t v = 0; v < weld_.size(); ++v) {
      weld_[v] = first.emplace(soup_.vertices[v], v).first->second;
    }
  }

  void add_triangle(std::uint32_t t) {
    const auto& [i, j, k] = soup_.triangles[t];
    const Vec3 a = soup_.vertices[i], b = soup_.vertices[j], c = soup_.vertices[k];
    const Vec3 across = cross(b - a, c - a);
    const double size = length(across);
    if (!(size > 0.0) || !std::isfinite(size)) return;
    const Vec3 normal = (1.0 / size) * across;
    const auto ring = static_cast<std::uint32_t>(rings_.size());
    rings_.push_back({{weld_[i], weld_[j], weld_[k]}, {t}, {normal, dot(normal, a)}});
    for (std::size_t e = 0; e < 3; ++e) {
      const Edge edge{rings_[ring].vertex[e], rings_[ring].vertex[(e + 1) % 3]};
      ring_at_.emplace(edge, ring);
      if (ring_at_.contains({edge.second, edge.first})) inner_.push_back(edge);
    }
  }

  bool is_in_plane(const Ring& ring, const Plane& plane) const {
    return std::all_of(ring.vertex.begin(), ring.vertex.end(), [&](std::uint32_t v) {
      return std::abs(plane.height(soup_.vertices[v])) <= slack_;
    });
  }

  bool are_one_surface(const Ring& a, const Ring& b) const {
    const std::uint32_t s = a.triangles.front(), t = b.triangles.front();
    return soup_.object[s] == soup_.object[t] && soup_.material[s] == soup_.material[t] &&
           dot(a.plane.normal, b.plane.normal) > 0.0 && is_in_plane(a, b.plane) &&
           is_in_plane(b, a.plane);
  }

  /// How far the ring turns left at corner k, as the distance of that corner from the straight
  /// line between its neighbours.
  double bulge(const std::vector<std::uint32_t>& ring, std::size_t k, Vec3 normal) const {
    const std::size_t n = ring.size();
    const Vec3 before = soup_.vertices[ring[(k + n - 1) % n]], at = soup_.vertices[ring[k]],
               after = soup_.vertices[ring[(k + 1) % n]];
    const double width = length(after - before);
    return width > 0.0 ? dot(normal, cross(at - before, after - at)) / width : -1.0;
  }

  /// The ring of both without the edge between them; empty where it is not convex.
  std::vector<std::uint32_t> joined(const Ring& a, const Ring& b, Edge edge) const {
    std::vector<std::uint32_t> left = a.vertex, right = b.vertex;
    std::rotate(left.begin(), std::find(left.begin(), left.end(), edge.second), left.end());
    std::rotate(right.begin(), std::find(right.begin(), right.end(), edge.first), right.end());
    // left: second ... first; right: first ... second.
    std::vector<std::uint32_t> ring(left.begin(), left.end());
    ring.insert(ring.end(), right.begin() + 1, right.end() - 1);
    for (const std::uint32_t corner : {edge.first, edge.second}) {
      const auto k =
          static_cast<std::size_t>(std::find(ring.begin(), ring.end(), corner) - ring.begin());
      const double out = bulge(ring, k, a.plane.normal);
      if (out < -slack_) return {};
      if (out <= slack_) ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k));
    }
    return ring.size() < 3 || ring.size() > kMostCorners ? std::vector<std::uint32_t>{} : ring;
  }

  void join_across(Edge edge) {
    const auto here = ring_at_.find(edge), there = ring_at_.find({edge.second, edge.first});
    if (here == ring_at_.end() || there == ring_at_.end() || here->second == there->second) return;
    const std::uint32_t kept = here->second, gone = there->second;
    if (!are_one_surface(rings_[kept], rings_[gone])) return;
    const std::vector<std::uint32_t> ring = joined(rings_[kept], rings_[gone], edge);
    if (ring.empty()) return;
    ring_at_.erase(here);
    ring_at_.erase(there);
    const auto take = [&](const std::vector<std::uint32_t>& from) {
      for (std::size_t k = 0; k < from.size(); ++k) {
        const auto at = ring_at_.find({from[k], from[(k + 1) % from.size()]});
        if (at != ring_at_.end() && (at->second == gone || at->second == kept)) {
          ring_at_.erase(at);
        }
      }
    };
    take(rings_[kept].vertex);
    take(rings_[gone].vertex);
    Ring& into = rings_[kept];
    into.vertex = ring;
    into.triangles.insert(into.triangles.end(), rings_[gone].triangles.begin(),
                          rings_[gone].triangles.end());
    rings_[gone] = {};
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Edge border{ring[k], ring[(k + 1) % ring.size()]};
      ring_at_.insert_or_assign(border, kept);
      // A straight run of corners that has become one edge may have its like on the other side.
      if (ring_at_.contains({border.second, border.first})) inner_.push_back(border);
    }
  }

  const TriangleSoup& soup_;
  const std::vector<Material>& materials_;
  double slack_;
  std::vector<std::uint32_t> weld_;
  std::vector<Ring> rings_;
  std::map<Edge, std::uint32_t> ring_at_;
  std::vector<Edge> inner_;
};

double extent_of(const TriangleSoup& soup) {
  double extent = 0.0;
  for (const Vec3& v : soup.vertices) {
    extent = std::max({extent, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  }
  return extent > 0.0 ? extent : 1.0;
}

}  // namespace

BeamFaces::BeamFaces(const TriangleSoup& soup, const std::vector<Material>& materials)
    : materials_(materials), extent_m_(extent_of(soup)) {
  faces_ = FaceJoiner(soup, materials, extent_m_).faces();
  std::vector<FaceBox> boxes;
  for (const BeamFace& face : faces_) {
    boxes.push_back(FaceBox::around(face.corners));
    mirrors_ += face.is_mirror;
  }
  tree_ = FaceTree(std::move(boxes));
}

}  // namespace tenku
