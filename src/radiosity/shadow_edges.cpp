#include "radiosity/shadow_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr std::size_t kMostLines = 2000;
constexpr double kAside = 1e-3;      // metres to either side of a line, where it is looked from
constexpr double kShortest = 0.01;   // metres: shorter parts are left out
constexpr double kInPlane = 1e-5;    // metres: an edge that touches
constexpr double kReached = 1e-4;    // metres: a ray that comes so near to a lamp is not stopped
constexpr double kDrawnIn = 1e-3;    // of a lamp's size
constexpr double kFlatLight = 1e-3;  // sine of the least altitude of light that throws edges

struct Edge {
  Vec3 a, b;
  std::uint32_t polygon;
};

/// The sun (a direction) or a lamp (its corners and middle).
struct Source {
  std::vector<Vec3> point;
  std::optional<Vec3> direction;
  std::uint32_t polygon = 0;
};

/// A line in the plane of a polygon, and the source whose light it may stop.
struct Line {
  ConstraintSegment segment;
  const Source* source;  ///< none: a contact
};

std::vector<Edge> edges_of(std::span<const FlatPolygon> polygons) {
  std::vector<Edge> edges;
  for (std::uint32_t p = 0; p < polygons.size(); ++p) {
    for (const auto& ring : polygons[p].rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        edges.push_back({ring[i], ring[(i + 1) % ring.size()], p});
      }
    }
  }
  return edges;
}

std::vector<Source> sources_of(std::span<const FlatPolygon> polygons,
                               std::span<const Material> materials,
                               const std::optional<Vec3>& sun) {
  std::vector<Source> sources;
  if (sun) sources.push_back({{}, sun, ~0U});
  for (std::uint32_t p = 0; p < polygons.size(); ++p) {
    if (!(luminance_of(materials[polygons[p].material].emission_lm_m2) > 0.0)) continue;
    Source lamp{{}, {}, p};
    Vec3 sum;
    for (const auto& ring : polygons[p].rings) {
      for (const Vec3 corner : ring) {
        lamp.point.push_back(corner);
        sum = sum + corner;
      }
    }
    lamp.point.push_back((1.0 / static_cast<double>(lamp.point.size())) * sum);
    sources.push_back(std::move(lamp));
  }
  return sources;
}

double side_of(const ConstraintSegment& s, PlanePoint p) {
  return (s.b.x - s.a.x) * (p.y - s.a.y) - (s.b.y - s.a.y) * (p.x - s.a.x);
}

PlanePoint along(const ConstraintSegment& s, double t) {
  return {s.a.x + t * (s.b.x - s.a.x), s.a.y + t * (s.b.y - s.a.y)};
}

double length_of(const ConstraintSegment& s) { return std::hypot(s.b.x - s.a.x, s.b.y - s.a.y); }

/// Where along `s` it crosses `other`, if it does.
std::optional<double> crossing(const ConstraintSegment& s, const ConstraintSegment& other) {
  const double a = side_of(other, s.a), b = side_of(other, s.b);
  if ((a > 0.0) == (b > 0.0)) return {};
  const double t = a / (a - b);
  const PlanePoint p = along(s, t);
  const double dx = other.b.x - other.a.x, dy = other.b.y - other.a.y;
  const double u = ((p.x - other.a.x) * dx + (p.y - other.a.y) * dy) / (dx * dx + dy * dy);
  if (u < 0.0 || u > 1.0) return {};
  return t;
}

/// Where along `s` a point lies, if it lies on it: lines may run along one another.
std::optional<double> place_on(const ConstraintSegment& s, PlanePoint p) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, whole = dx * dx + dy * dy;
  const double t = ((p.x - s.a.x) * dx + (p.y - s.a.y) * dy) / whole;
  const PlanePoint near = along(s, t);
  if (t < 0.0 || t > 1.0 || std::hypot(near.x - p.x, near.y - p.y) > kInPlane) return {};
  return t;
}

/// Lines on one polygon.
class Receiver {
 public:
  Receiver(const FlatPolygon& polygon, std::uint32_t number, const RayVisibility& rays)
      : polygon_(polygon), number_(number), rays_(rays) {
    for (const auto& ring : polygon.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        outline_.push_back({polygon.flat(ring[i]), polygon.flat(ring[(i + 1) % ring.size()])});
      }
    }
  }

  ShadowEdges found(std::span<const Edge> edges, std::span<const Source> sources) {
    for (const Edge& edge : edges) {
      if (edge.polygon == number_) continue;
      touch(edge);
      for (const Source& source : sources) {
        if (source.polygon == number_ || source.polygon == edge.polygon) continue;
        if (source.direction) {
          project(edge, source, *source.direction, true);
        } else {
          for (std::size_t k = 0; k + 1 < source.point.size(); ++k) {
            project(edge, source, source.point[k], false);
          }
        }
      }
      if (lines_.size() > kMostLines) return {};
    }
    return kept();
  }

 private:
  double height(Vec3 p) const { return dot(p - polygon_.origin, polygon_.normal); }

  void touch(const Edge& edge) {
    if (std::abs(height(edge.a)) > kInPlane || std::abs(height(edge.b)) > kInPlane) return;
    add({{polygon_.flat(edge.a), polygon_.flat(edge.b)}, nullptr});
  }

  /// The shadow of the part of the edge that stands between the source and the plane.
  void project(Edge edge, const Source& source, Vec3 light, bool is_direction) {
    const double above = is_direction ? dot(light, polygon_.normal) : height(light);
    if (std::abs(above) < (is_direction ? kFlatLight : kInPlane)) return;
    const double up = above > 0.0 ? 1.0 : -1.0;
    double a = up * height(edge.a), b = up * height(edge.b);
    const double ceiling =
        is_direction ? std::numeric_limits<double>::infinity() : up * above - kInPlane;
    if (std::max(a, b) < kInPlane || std::min(a, b) > ceiling) return;
    const auto cut = [&](Vec3& end, double& at, Vec3 other, double other_at, double limit) {
      end = other + (other_at - limit) / (other_at - at) * (end - other);
      at = limit;
    };
    if (a < 0.0) cut(edge.a, a, edge.b, b, 0.0);
    if (b < 0.0) cut(edge.b, b, edge.a, a, 0.0);
    if (a > ceiling) cut(edge.a, a, edge.b, b, ceiling);
    if (b > ceiling) cut(edge.b, b, edge.a, a, ceiling);
    const auto shadow = [&](Vec3 p, double high) {
      const Vec3 way = is_direction ? -1.0 * light : p - light;
      const double fall = is_direction ? up * above : up * above - high;
      return polygon_.flat(p + high / fall * way);
    };
    add({{shadow(edge.a, a), shadow(edge.b, b)}, &source});
  }

  void add(const Line& line) {
    if (length_of(line.segment) < kShortest) return;
    for (const ConstraintSegment& part : parts(line.segment, outline_)) {
      if (is_inside(along(part, 0.5)) && is_inside_beside(part)) {
        lines_.push_back({part, line.source});
      }
    }
  }

  static std::vector<ConstraintSegment> parts(const ConstraintSegment& s,
                                              std::span<const ConstraintSegment> others) {
    std::vector<double> at{0.0, 1.0};
    for (const ConstraintSegment& other : others) {
      if (const auto t = crossing(s, other)) at.push_back(*t);
      for (const PlanePoint end : {other.a, other.b}) {
        if (const auto t = place_on(s, end)) at.push_back(*t);
      }
    }
    std::sort(at.begin(), at.end());
    std::vector<ConstraintSegment> cut;
    const double least = kShortest / length_of(s);
    double from = 0.0;
    for (const double to : at) {
      if (to - from < least) continue;
      cut.push_back({along(s, from), along(s, to)});
      from = to;
    }
    return cut;
  }

  bool is_inside(PlanePoint p) const {
    bool inside = false;
    for (const auto& [a, b] : outline_) {
      if ((a.y <= p.y) == (b.y <= p.y)) continue;
      if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) inside = !inside;
    }
    return inside;
  }
  std::array<PlanePoint, 2> beside(const ConstraintSegment& s, double t) const {
    const double scale = kAside / length_of(s), dx = scale * (s.b.x - s.a.x),
                 dy = scale * (s.b.y - s.a.y);
    const PlanePoint p = along(s, t);
    return {{{p.x - dy, p.y + dx}, {p.x + dy, p.y - dx}}};
  }
  bool is_inside_beside(const ConstraintSegment& s) const {
    const auto [left, right] = beside(s, 0.5);
    return is_inside(left) && is_inside(right);
  }

  /// How much of the source is seen from a place, on the face that the light comes to.
  enum class Seen { None, Part, All };
  Seen seen(PlanePoint at, const Source& source) const {
    const Vec3 place = polygon_.lifted(at);
    if (source.direction) {
      const double up = dot(*source.direction, polygon_.normal) > 0.0 ? 1.0 : -1.0;
      const Vec3 from = place + up * rays_.lift_m() * polygon_.normal;
      return rays_.is_occluded(from, *source.direction) ? Seen::None : Seen::All;
    }
    const auto is_seen = [&](Vec3 lamp) {
      const double up = height(lamp) > 0.0 ? 1.0 : -1.0;
      const Vec3 from = place + up * rays_.lift_m() * polygon_.normal;
      // Corners of a lamp are drawn in a little: a ray to its edge may pass it.
      const Vec3 to = lamp + kDrawnIn * (source.point.back() - lamp), way = to - from;
      const auto hit = rays_.first_hit(from, normalized(way));
      return !hit || hit->distance_m > length(way) - kReached;
    };
    const auto count = std::count_if(source.point.begin(), source.point.end(), is_seen);
    if (count == 0) return Seen::None;
    return count == std::ssize(source.point) ? Seen::All : Seen::Part;
  }

  bool is_border(const Line& line) const {
    if (line.source == nullptr) return true;
    int differ = 0;
    for (const double t : {0.25, 0.5, 0.75}) {
      const auto [left, right] = beside(line.segment, t);
      differ += seen(left, *line.source) != seen(right, *line.source);
    }
    return differ >= 2;
  }

  /// The parts between crossings that are borders of light.
  ShadowEdges kept() const {
    std::vector<ConstraintSegment> all;
    for (const Line& line : lines_) all.push_back(line.segment);
    ShadowEdges edges;
    for (const Line& line : lines_) {
      for (const ConstraintSegment& part : parts(line.segment, all)) {
        if (!is_border({part, line.source})) continue;
        auto& list = line.source == nullptr ? edges.contacts : edges.shadows;
        if (!is_known(part, edges)) list.push_back(part);
      }
    }
    return edges;
  }

  /// Two faces of a box throw one edge twice.
  static bool is_known(const ConstraintSegment& s, const ShadowEdges& edges) {
    const auto same = [&](const ConstraintSegment& o) {
      const auto near = [](PlanePoint p, PlanePoint q) {
        return std::hypot(p.x - q.x, p.y - q.y) < kAside;
      };
      return (near(s.a, o.a) && near(s.b, o.b)) || (near(s.a, o.b) && near(s.b, o.a));
    };
    return std::any_of(edges.contacts.begin(), edges.contacts.end(), same) ||
           std::any_of(edges.shadows.begin(), edges.shadows.end(), same);
  }

  const FlatPolygon& polygon_;
  std::uint32_t number_;
  const RayVisibility& rays_;
  std::vector<ConstraintSegment> outline_;
  std::vector<Line> lines_;
};

}  // namespace

std::vector<ShadowEdges> shadow_edges(std::span<const FlatPolygon> polygons,
                                      std::span<const Material> materials,
                                      const RayVisibility& rays, const std::optional<Vec3>& sun) {
  const std::vector<Edge> edges = edges_of(polygons);
  const std::vector<Source> sources = sources_of(polygons, materials, sun);
  std::vector<ShadowEdges> found(polygons.size());
  parallel_for(polygons.size(), 1, [&](IndexRange range) {
    for (std::size_t p = range.begin; p < range.end; ++p) {
      found[p] = Receiver(polygons[p], static_cast<std::uint32_t>(p), rays).found(edges, sources);
    }
  });
  return found;
}

}  // namespace tenku
