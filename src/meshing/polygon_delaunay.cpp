#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "meshing/polygon_mesh.h"
#include "scene/constrained_delaunay.h"

namespace tenku {
namespace {

// Points stand closer than the longest edge allowed, for those that are not in a regular place.
constexpr double kSpacing = 0.8;
// Of the spacing: nearer to the outline than this, points would make flat triangles with it.
constexpr double kLeastFromOutline = 0.55;

struct Segment {
  PlanePoint a, b;
};

double distance(PlanePoint p, const Segment& s) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
  const double whole = dx * dx + dy * dy;
  const double t =
      whole > 0.0 ? std::clamp(((p.x - s.a.x) * dx + (p.y - s.a.y) * dy) / whole, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - s.a.x - t * dx, p.y - s.a.y - t * dy);
}

std::vector<Segment> outline_of(const FlatPolygon& polygon) {
  std::vector<Segment> outline;
  for (const auto& ring : polygon.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      outline.push_back({polygon.flat(ring[i]), polygon.flat(ring[(i + 1) % ring.size()])});
    }
  }
  return outline;
}

/// Where a level line enters and leaves the surface, in rising order.
std::vector<double> crossings(const std::vector<Segment>& outline, double y) {
  std::vector<double> at;
  for (const auto& [a, b] : outline) {
    if ((a.y <= y) == (b.y <= y)) continue;
    at.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::sort(at.begin(), at.end());
  return at;
}

std::vector<Segment> segments_near_level(const std::vector<Segment>& outline, double y,
                                         double reach) {
  std::vector<Segment> near;
  for (const Segment& s : outline) {
    const auto [low, high] = std::minmax(s.a.y, s.b.y);
    if (low <= y + reach && high >= y - reach) near.push_back(s);
  }
  return near;
}

/// Appends the points of one row, `spacing` apart, that are inside and clear of the outline.
void append_row(const std::vector<Segment>& outline, double y, double shift, double spacing,
                std::vector<PlanePoint>& points) {
  const double clear = kLeastFromOutline * spacing;
  const auto near = segments_near_level(outline, y, clear);
  const auto at = crossings(near, y);
  for (std::size_t i = 0; i + 1 < at.size(); i += 2) {
    for (double k = std::ceil(at[i] / spacing - shift); (k + shift) * spacing < at[i + 1]; ++k) {
      const PlanePoint p{(k + shift) * spacing, y};
      const bool is_clear = std::all_of(near.begin(), near.end(),
                                        [&](const Segment& s) { return distance(p, s) >= clear; });
      if (is_clear) points.push_back(p);
    }
  }
}

/// Corners of equilateral triangles inside a polygon, clear of its outline.
std::vector<PlanePoint> lattice(const std::vector<Segment>& outline, double spacing) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Segment& s : outline) low = std::min(low, s.a.y), high = std::max(high, s.a.y);
  const double row_height = spacing * std::numbers::sqrt3 / 2.0;
  const double rows = std::max(1.0, std::round((high - low) / row_height));
  std::vector<PlanePoint> points;
  for (double row = 1.0; row < rows; ++row) {
    const double shift = std::fmod(row, 2.0) * 0.5;
    append_row(outline, low + row * (high - low) / rows, shift, spacing, points);
  }
  return points;
}

/// The mesh while it grows: vertices keep their place in space.
class Builder {
 public:
  Builder(const FlatPolygon& polygon, double element_m)
      : polygon_(polygon), element_m_(element_m) {}

  PolygonMesh mesh() {
    for (const auto& ring : polygon_.rings) add_ring(ring);
    for (const PlanePoint p : lattice(outline_of(polygon_), kSpacing * element_m_)) add_inner(p);
    mesh_.number_crossings();
    while (made_.vertices.size() < mesh_.size()) {
      const auto [x, y] = mesh_.place(static_cast<Vertex>(made_.vertices.size()));
      made_.vertices.push_back(polygon_.lifted({x, y}));
    }
    split_long_edges();
    for (const auto& face : mesh_.inside()) append_element(face.corner);
    return std::move(made_);
  }

 private:
  using Vertex = ConstrainedDelaunay::Vertex;

  Vertex add(Vec3 place) {
    const PlanePoint p = polygon_.flat(place);
    const Vertex vertex = mesh_.insert(p.x, p.y);
    if (vertex == made_.vertices.size()) made_.vertices.push_back(place);
    return vertex;
  }

  void add_inner(PlanePoint p) { add(polygon_.lifted(p)); }

  void add_ring(const std::vector<Vec3>& ring) {
    std::vector<Vertex> vertices;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 from = ring[i], to = ring[(i + 1) % ring.size()];
      const double n = std::max(1.0, std::ceil(length(to - from) / (kSpacing * element_m_)));
      for (double k = 0.0; k < n; ++k) vertices.push_back(add(from + (k / n) * (to - from)));
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      mesh_.keep_bound(vertices[i], vertices[(i + 1) % vertices.size()]);
    }
  }

  /// Leaves out what rounding makes of three points on a line, which has no normal.
  void append_element(const std::array<Vertex, 3>& element) {
    const Vec3 a = made_.vertices[element[0]], ab = made_.vertices[element[1]] - a,
               ac = made_.vertices[element[2]] - a;
    constexpr double kFlat = 1e-9;
    const Vec3 doubled_area = cross(ab, ac);
    if (dot(doubled_area, polygon_.normal) > kFlat * (dot(ab, ab) + dot(ac, ac))) {
      made_.elements.push_back(element);
    }
  }

  using Middles = std::map<std::pair<Vertex, Vertex>, PlanePoint>;

  /// Of edges inside that are too long, in an order that does not hang on where things lie in
  /// memory.
  Middles middles_of_long_edges() {
    Middles middles;
    for (const auto& [corner, is_kept] : mesh_.inside()) {
      for (unsigned i = 0; i < 3; ++i) {
        if (is_kept[i]) continue;
        const Vertex a = corner[(i + 1) % 3], b = corner[(i + 2) % 3];
        const auto p = mesh_.place(a), q = mesh_.place(b);
        if (std::hypot(p[0] - q[0], p[1] - q[1]) <= element_m_) continue;
        middles[std::minmax(a, b)] = {(p[0] + q[0]) / 2.0, (p[1] + q[1]) / 2.0};
      }
    }
    return middles;
  }

  void split_long_edges() {
    for (;;) {
      const Middles middles = middles_of_long_edges();
      if (middles.empty()) return;
      for (const auto& [edge, middle] : middles) add_inner(middle);
    }
  }

  const FlatPolygon& polygon_;
  double element_m_;
  ConstrainedDelaunay mesh_;
  PolygonMesh made_;
};

}  // namespace

PolygonMesh delaunay_mesh(const FlatPolygon& polygon, double element_m) {
  if (polygon.rings.size() == 1 && polygon.rings[0].size() == 3) {
    const std::vector<Vec3>& p = polygon.rings[0];
    const double longest =
        std::max({length(p[1] - p[0]), length(p[2] - p[1]), length(p[0] - p[2])});
    if (longest <= element_m) return {p, {{0, 1, 2}}, 1};
  }
  return Builder(polygon, element_m).mesh();
}

}  // namespace tenku
