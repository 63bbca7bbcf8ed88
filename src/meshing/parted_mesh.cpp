#include "meshing/parted_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace tenku {
namespace {

constexpr double kOnLine = 1e-6;  // metres

using Edge = std::pair<std::uint32_t, std::uint32_t>;

bool is_on(const ConstraintSegment& line, PlanePoint p) {
  const double dx = line.b.x - line.a.x, dy = line.b.y - line.a.y, whole = std::hypot(dx, dy);
  const double along = ((p.x - line.a.x) * dx + (p.y - line.a.y) * dy) / whole;
  return along >= -kOnLine && along <= whole + kOnLine &&
         std::abs(dx * (p.y - line.a.y) - dy * (p.x - line.a.x)) <= kOnLine * whole;
}

/// Edges of elements that run along a line.
std::set<Edge> edges_on(const FlatPolygon& polygon, const PolygonMesh& mesh,
                        std::span<const ConstraintSegment> lines) {
  std::set<Edge> found;
  std::vector<std::uint8_t> on(mesh.vertices.size());
  for (const ConstraintSegment& line : lines) {
    for (std::size_t v = 0; v < on.size(); ++v) on[v] = is_on(line, polygon.flat(mesh.vertices[v]));
    for (const auto& t : mesh.elements) {
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (on[a] != 0 && on[b] != 0) found.insert(std::minmax(a, b));
      }
    }
  }
  return found;
}

/// Elements about a vertex in groups that hang together by edges which are not on a line.
class Fan {
 public:
  explicit Fan(const PolygonMesh& mesh, const std::set<Edge>& cut) : mesh_(mesh), cut_(cut) {}

  std::vector<std::vector<std::uint32_t>> groups(std::uint32_t vertex,
                                                 std::vector<std::uint32_t> elements) const {
    std::vector<std::vector<std::uint32_t>> all;
    while (!elements.empty()) {
      std::vector<std::uint32_t> group{elements.back()};
      elements.pop_back();
      for (std::size_t k = 0; k < group.size(); ++k) {
        for (std::size_t i = elements.size(); i-- > 0;) {
          if (!hang_together(vertex, group[k], elements[i])) continue;
          group.push_back(elements[i]);
          elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(i));
        }
      }
      all.push_back(std::move(group));
    }
    return all;
  }

 private:
  bool hang_together(std::uint32_t vertex, std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t v : mesh_.elements[a]) {
      if (v == vertex) continue;
      const auto& other = mesh_.elements[b];
      if (std::find(other.begin(), other.end(), v) == other.end()) continue;
      if (!cut_.contains(std::minmax(v, vertex))) return true;
    }
    return false;
  }

  const PolygonMesh& mesh_;
  const std::set<Edge>& cut_;
};

}  // namespace

PolygonMesh parted_along(const FlatPolygon& polygon, PolygonMesh mesh,
                         std::span<const ConstraintSegment> lines) {
  const std::set<Edge> cut = edges_on(polygon, mesh, lines);
  std::map<std::uint32_t, std::vector<std::uint32_t>> about;  // vertices of cut edges
  for (const auto& [a, b] : cut) about[a], about[b];
  for (std::uint32_t e = 0; e < mesh.elements.size(); ++e) {
    for (const std::uint32_t v : mesh.elements[e]) {
      if (const auto found = about.find(v); found != about.end()) found->second.push_back(e);
    }
  }
  PolygonMesh parted = mesh;
  const Fan fan(mesh, cut);
  for (const auto& [vertex, elements] : about) {
    const auto groups = fan.groups(vertex, elements);
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const auto copy = static_cast<std::uint32_t>(parted.vertices.size());
      parted.vertices.push_back(mesh.vertices[vertex]);
      for (const std::uint32_t e : groups[g]) {
        std::replace(parted.elements[e].begin(), parted.elements[e].end(), vertex, copy);
      }
    }
  }
  return parted;
}

}  // namespace tenku
