#include "meshing/flat_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/extent.h"
#include "core/parallel.h"
#include "meshing/point_tree.h"
#include "meshing/polygon_outline.h"
#include "meshing/soup_faces.h"

namespace tenku {
namespace {

constexpr std::uint32_t kNoGroup = 0xffffffffU;

/// @param tan  of the angle allowed between the lines of `a` and `b`
bool are_nearly_parallel(Vec3 a, Vec3 b, double tan) {
  return length(cross(a, b)) <= tan * std::abs(dot(a, b));
}
constexpr double kTan = 0.02;  // about a degree, past which neighbours bend

/// Joins triangles group by group.
class Joiner {
 public:
  Joiner(std::span<const Vec3> vertices, std::vector<Face> faces, const JoinTolerance& tolerance)
      : vertices_(vertices), faces_(std::move(faces)), tolerance_(tolerance) {
    find_borders();
  }

  std::vector<FlatPolygon> polygons() {
    std::vector<std::uint32_t> order(faces_.size());
    std::iota(order.begin(), order.end(), 0U);
    // The plane of a group is that of its largest triangle, which rounding tilts least.
    std::vector<double> size(faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) size[f] = length(faces_[f].doubled_area);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return size[a] > size[b]; });
    group_.assign(faces_.size(), kNoGroup);
    std::vector<std::vector<std::uint32_t>> groups;
    for (const std::uint32_t seed : order) {
      if (group_[seed] != kNoGroup) continue;
      groups.push_back(grown(seed, static_cast<std::uint32_t>(groups.size())));
    }
    // In the order of the file, so that what belongs together stays together.
    std::sort(groups.begin(), groups.end(),
              [](const auto& a, const auto& b) { return a.front() < b.front(); });
    std::vector<FlatPolygon> made(groups.size());
    parallel_for(groups.size(), 64, [&](IndexRange range) {
      for (std::size_t g = range.begin; g < range.end; ++g) made[g] = outlined(groups[g]);
    });
    return made;
  }

 private:
  void find_borders() {
    std::vector<Border> whole;
    whole.reserve(3 * faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const auto& corner = faces_[f].corner;
      for (unsigned e = 0; e < 3; ++e) whole.push_back({corner[e], corner[(e + 1) % 3], f});
    }
    std::sort(whole.begin(), whole.end(), comes_before);
    std::vector<std::uint32_t> used;
    for (const Face& f : faces_) used.insert(used.end(), f.corner.begin(), f.corner.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    split_at_vertices(whole, used);
    std::sort(borders_.begin(), borders_.end(), comes_before);
    first_of_face_.assign(faces_.size() + 1, 0);
    for (const Border& b : borders_) ++first_of_face_[b.face + 1];
    std::partial_sum(first_of_face_.begin(), first_of_face_.end(), first_of_face_.begin());
    of_face_.resize(borders_.size());
    run_.resize(borders_.size());
    std::vector<std::uint32_t> next(first_of_face_.begin(), first_of_face_.end() - 1);
    for (std::uint32_t i = 0; i < borders_.size(); ++i) {
      of_face_[next[borders_[i].face]++] = i;
      run_[i] = i > 0 && borders_[i].key() == borders_[i - 1].key() ? run_[i - 1] : i;
    }
  }

  bool is_matched(const std::vector<Border>& sorted, std::size_t i) const {
    const auto fits = [&](std::size_t j) {
      return sorted[j].key() == sorted[i].key() &&
             faces_[sorted[j].face].is_like(faces_[sorted[i].face]) &&
             are_nearly_parallel(faces_[sorted[j].face].doubled_area,
                                 faces_[sorted[i].face].doubled_area, kTan);
    };
    return (i > 0 && fits(i - 1)) || (i + 1 < sorted.size() && fits(i + 1));
  }

  /// Parts the edges on which vertices of others lie: there only a piece of an edge is shared.
  void split_at_vertices(const std::vector<Border>& whole, const std::vector<std::uint32_t>& used) {
    std::vector<Vec3> points;
    points.reserve(used.size());
    for (const std::uint32_t v : used) points.push_back(vertices_[v]);
    const PointTree tree(points);
    std::vector<std::vector<std::uint32_t>> inside(whole.size());
    parallel_for(whole.size(), 256, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        if (is_matched(whole, i)) continue;
        const Vec3 a = vertices_[whole[i].from], b = vertices_[whole[i].to];
        const auto near = tree.near_segment(a, b, tolerance_.weld_m);
        if (near.size() <= 2) continue;
        std::vector<std::pair<double, std::uint32_t>> along;
        for (const std::uint32_t n : near) {
          const std::uint32_t v = used[n];
          if (v == whole[i].from || v == whole[i].to) continue;
          along.emplace_back(dot(vertices_[v] - a, b - a), v);
        }
        std::sort(along.begin(), along.end());
        for (const auto& [t, v] : along) inside[i].push_back(v);
      }
    });
    borders_.reserve(whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      std::uint32_t from = whole[i].from;
      for (const std::uint32_t v : inside[i]) {
        borders_.push_back({from, v, whole[i].face});
        from = v;
      }
      borders_.push_back({from, whole[i].to, whole[i].face});
    }
  }

  /// Whether a face lies in the plane through `origin` with the unit `normal`.
  bool is_in_plane(const Face& face, Vec3 origin, Vec3 normal) const {
    double longest = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
      const Vec3 p = vertices_[face.corner[k]];
      if (!(std::abs(dot(p - origin, normal)) <= tolerance_.plane_m)) return false;
      longest = std::max(longest, length(vertices_[face.corner[(k + 1) % 3]] - p));
    }
    // Rounding tilts a narrow triangle more.
    constexpr double kMostTan = 0.5;
    const double height = length(face.doubled_area) / longest;
    return are_nearly_parallel(face.doubled_area, normal,
                               std::min(kMostTan, kTan + tolerance_.plane_m / height));
  }

  std::span<const std::uint32_t> borders_of(std::uint32_t face) const {
    return {of_face_.data() + first_of_face_[face], of_face_.data() + first_of_face_[face + 1]};
  }

  std::vector<std::uint32_t> grown(std::uint32_t seed, std::uint32_t number) {
    const Vec3 normal = normalized(faces_[seed].doubled_area);
    const Vec3 origin = vertices_[faces_[seed].corner[0]];
    std::vector<std::uint32_t> members{seed};
    group_[seed] = number;
    for (std::size_t next = 0; next < members.size(); ++next) {
      for (const std::uint32_t b : borders_of(members[next])) {
        for (std::uint32_t i = run_[b]; i < borders_.size() && run_[i] == run_[b]; ++i) {
          const std::uint32_t f = borders_[i].face;
          if (group_[f] != kNoGroup || !faces_[f].is_like(faces_[seed])) continue;
          if (!is_in_plane(faces_[f], origin, normal)) continue;
          group_[f] = number;
          members.push_back(f);
        }
      }
    }
    std::sort(members.begin(), members.end());
    return members;
  }

  FlatPolygon outlined(const std::vector<std::uint32_t>& members) const;
  std::vector<Border> borders_about(const std::vector<std::uint32_t>& members, Vec3 normal) const;

  std::span<const Vec3> vertices_;
  std::vector<Face> faces_;
  JoinTolerance tolerance_;
  std::vector<Border> borders_;               ///< sorted by key
  std::vector<std::uint32_t> of_face_;        ///< index into `borders_`, face by face
  std::vector<std::uint32_t> first_of_face_;  ///< [face + 1] in `of_face_`
  std::vector<std::uint32_t> run_;            ///< [border] first with the same key
  std::vector<std::uint32_t> group_;
};

/// Borders of all members, with the surface to their left.
std::vector<Border> Joiner::borders_about(const std::vector<std::uint32_t>& members,
                                          Vec3 normal) const {
  std::vector<Border> all;
  for (const std::uint32_t f : members) {
    const bool is_turned = dot(faces_[f].doubled_area, normal) < 0.0;
    for (const std::uint32_t b : borders_of(f)) {
      Border border = borders_[b];
      if (is_turned) std::swap(border.from, border.to);
      all.push_back(border);
    }
  }
  return all;
}

FlatPolygon Joiner::outlined(const std::vector<std::uint32_t>& members) const {
  FlatPolygon polygon;
  polygon.material = faces_[members[0]].material;
  polygon.object = faces_[members[0]].object;
  Vec3 front{}, any{};
  for (const std::uint32_t f : members) {
    const Vec3 a = faces_[f].doubled_area;
    front = front + a;
    any = any + (dot(a, any) < 0.0 ? -a : a);
    polygon.triangles.push_back(faces_[f].triangle);
  }
  polygon.normal = normalized(dot(front, any) < 0.0 ? -any : any);
  for (const std::uint32_t f : members) {
    polygon.area_m2 += 0.5 * std::abs(dot(faces_[f].doubled_area, polygon.normal));
  }
  Outline about = outline(borders_about(members, polygon.normal), vertices_, tolerance_.weld_m);
  polygon.rings = std::move(about.rings);
  polygon.layers = about.layers;
  polygon.area_m2 /= polygon.layers;
  set_frame(polygon);
  return polygon;
}

/// Corners of all rings in an order of their own.
std::vector<std::array<double, 3>> sorted_corners(const FlatPolygon& polygon) {
  std::vector<std::array<double, 3>> corners;
  for (const auto& ring : polygon.rings) {
    for (const Vec3 p : ring) corners.push_back({p.x, p.y, p.z});
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Leaves out the later of polygons with the same corners: those of which the triangles differ.
void drop_coincident(std::vector<FlatPolygon>& polygons, std::vector<SurfaceFlaw>& flaws) {
  std::vector<std::pair<std::vector<std::array<double, 3>>, std::size_t>> keys;
  keys.reserve(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    keys.emplace_back(sorted_corners(polygons[i]), i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint8_t> is_dropped(polygons.size());
  for (std::size_t k = 1, first = 0; k < keys.size(); ++k) {
    // Without corners it is a heap of triangles, to be divided one by one.
    if (keys[k].first.empty() || keys[k].first != keys[first].first) first = k;
    if (first == k) continue;
    const FlatPolygon &polygon = polygons[keys[k].second], &other = polygons[keys[first].second];
    is_dropped[keys[k].second] = 1;
    const auto kind = polygon.material == other.material ? SurfaceFlaw::Kind::Duplicate
                                                         : SurfaceFlaw::Kind::Coincident;
    flaws.push_back({kind, polygon.object, polygon.origin, 0.0, other.object});
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (is_dropped[i] != 0) continue;
    if (kept != i) polygons[kept] = std::move(polygons[i]);
    ++kept;
  }
  polygons.resize(kept);
}

}  // namespace

JoinTolerance JoinTolerance::of(std::span<const Vec3> vertices) {
  const Extent extent = extent_of(vertices);
  double reach = 0.0;
  for (const Vec3 p : {extent.min, extent.max}) {
    reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  constexpr double kFloatSteps = 0x1.0p-22;  // two steps of a float of 24 bits
  JoinTolerance tolerance;
  constexpr double kLeast_m = 1e-12;
  tolerance.weld_m = std::max({1e-6 * extent.longest_side(), kFloatSteps * reach, kLeast_m});
  tolerance.plane_m = 10.0 * tolerance.weld_m;
  return tolerance;
}

JoinedSurfaces join_coplanar(const TriangleSoup& soup, std::span<const Material> materials,
                             const JoinTolerance& tolerance) {
  JoinedSurfaces joined;
  if (soup.triangles.empty()) return joined;
  joined.weld = welded(soup.vertices, tolerance.weld_m);
  std::vector<Face> faces = faces_of(soup, materials, joined.weld, tolerance.weld_m, joined.flaws);
  joined.polygons = Joiner(soup.vertices, std::move(faces), tolerance).polygons();
  for (const FlatPolygon& p : joined.polygons) {
    if (p.layers == 1) continue;
    joined.flaws.push_back({SurfaceFlaw::Kind::Duplicate, p.object, p.origin, 0.0, p.object});
  }
  drop_coincident(joined.polygons, joined.flaws);
  return joined;
}

FlatPolygon triangle_polygon(const TriangleSoup& soup, std::span<const std::uint32_t> weld,
                             std::uint32_t t) {
  const std::uint32_t a = weld[soup.triangles[t][0]], b = weld[soup.triangles[t][1]],
                      c = weld[soup.triangles[t][2]];
  FlatPolygon polygon;
  polygon.material = soup.material[t];
  polygon.object = soup.object[t];
  polygon.triangles = {t};
  polygon.rings = {{soup.vertices[a], soup.vertices[b], soup.vertices[c]}};
  const Vec3 doubled_area =
      cross(soup.vertices[b] - soup.vertices[a], soup.vertices[c] - soup.vertices[a]);
  polygon.normal = normalized(doubled_area);
  polygon.area_m2 = 0.5 * length(doubled_area);
  set_frame(polygon);
  return polygon;
}

}  // namespace tenku
