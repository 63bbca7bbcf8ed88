#include "scene/geometry_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/mixed_key_sort.h"
#include "core/parallel.h"
#include "core/random.h"

namespace tenku {

std::string place_in_file(const Scene& scene, Vec3 local) {
  const Vec3 at = scene.frame.to_file(local);
  const int digits = scene.frame.is_geographic() ? 7 : 2;
  return fmt::format("{:.{}f} {:.{}f} {:.2f}", at.x, digits, at.y, digits, at.z);
}

namespace {

/// Vertices of all rings of a surface.
std::span<const std::uint32_t> vertices_of(const Surfaces& surfaces, std::size_t s) {
  const std::uint32_t first = surfaces.first_vertex[surfaces.first_ring[s]];
  const std::uint32_t end = surfaces.first_vertex[surfaces.first_ring[s + 1]];
  return {surfaces.vertex.data() + first, end - first};
}

double largest_coordinate(Vec3 p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

template <class Value>
Value median_of(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Coincident faces.

bool have_same_vertices(const Surfaces& surfaces, std::size_t a, std::size_t b) {
  const auto sorted = [&](std::size_t s) {
    const auto all = vertices_of(surfaces, s);
    std::vector<std::uint32_t> made(all.begin(), all.end());
    std::sort(made.begin(), made.end());
    return made;
  };
  return sorted(a) == sorted(b);
}

std::optional<Finding> coincident_faces(const RawScene& raw) {
  const Scene& scene = raw.scene;
  const Surfaces& surfaces = scene.surfaces;
  struct Face {
    std::uint64_t key;
    std::size_t surface;

    auto operator<=>(const Face&) const = default;
  };
  std::vector<Face> faces;
  faces.reserve(surfaces.size());
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    std::uint64_t sum = 0;  // the same in whatever order the vertices come
    for (const std::uint32_t v : vertices_of(surfaces, s)) sum += mix_bits(v + 1ULL);
    faces.push_back({sum, s});
  }
  sort_by_mixed_key(faces);
  std::size_t count = 0, first = surfaces.size(), other = 0;
  for (std::size_t k = 0, group = 0; k < faces.size(); ++k) {
    if (faces[k].key != faces[group].key) group = k;
    const std::size_t here = faces[group].surface, again = faces[k].surface;
    if (surfaces.object[here] == surfaces.object[again]) continue;
    if (!have_same_vertices(surfaces, here, again)) continue;
    ++count;
    if (here < first) first = here, other = again;
  }
  if (count == 0) return std::nullopt;
  return Finding{"coincident_faces",
                 Severity::Note,
                 raw.object_of(first),
                 place_in_file(scene, scene.vertices[surfaces.outer_ring(first)[0]]),
                 fmt::format("faces lie where another object has the same face (first: [{}])",
                             raw.object_of(other)),
                 "both are kept and shade as one; a sensor between them sees nothing",
                 count};
}

// Far parts.

Vec3 median_vertex(const std::vector<Vec3>& vertices) {
  std::vector<double> x, y, z;
  for (const Vec3& v : vertices) x.push_back(v.x), y.push_back(v.y), z.push_back(v.z);
  return {median_of(std::move(x)), median_of(std::move(y)), median_of(std::move(z))};
}

std::optional<Finding> far_parts(const RawScene& raw) {
  constexpr double kExact_m = 16384.0;  // floats lie 1 mm apart up to here
  constexpr double kFar_m = 100'000.0;  // no sight is longer
  constexpr double kCoarse_m = 0.01;
  constexpr double kLift = 4.0 * 0x1.0p-24;  // of the largest coordinate, as RayVisibility does
  const Scene& scene = raw.scene;
  double reach = 0.0;
  for (const Vec3& v : scene.vertices) reach = std::max(reach, largest_coordinate(v));
  if (!(reach > kExact_m)) return std::nullopt;
  const Vec3 middle = median_vertex(scene.vertices);
  double farthest = -1.0;
  std::size_t surface = 0, count = 0;
  Vec3 place{};
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    bool is_far = false;
    for (const std::uint32_t v : vertices_of(scene.surfaces, s)) {
      is_far = is_far || largest_coordinate(scene.vertices[v]) > kExact_m;
      const double away = length(scene.vertices[v] - middle);
      if (away <= farthest) continue;
      farthest = away, surface = s, place = scene.vertices[v];
    }
    count += is_far ? 1 : 0;
  }
  const auto as_float = static_cast<float>(reach);
  const double step = std::nextafter(as_float, std::numeric_limits<float>::infinity()) - as_float;
  const bool is_apart = farthest > kFar_m;
  return Finding{
      "far_from_origin",
      is_apart || step > kCoarse_m ? Severity::Warning : Severity::Note,
      raw.object_of(surface),
      place_in_file(scene, place),
      fmt::format("faces lie up to {:.0f} km from the local origin, where the ray engine's "
                  "positions lie {:.3g} mm apart, and all sensors stand {:.3g} mm off their "
                  "surfaces; this object reaches {:.0f} km from the middle of the scene",
                  reach / 1000.0, 1000.0 * step, 1000.0 * kLift * reach, farthest / 1000.0),
      is_apart ? "take what is far off out of the scene, or calculate it apart"
               : "details finer than that are lost; read the scene in parts to keep them",
      std::max<std::size_t>(1, count)};
}

// Flat buildings.

std::uint32_t root_of(const Scene& scene, std::uint32_t object) {
  for (std::size_t step = 0; step < scene.objects.size(); ++step) {
    if (scene.objects[object].parent == kNone) break;
    object = scene.objects[object].parent;
  }
  return object;
}

std::optional<Finding> flat_buildings(const RawScene& raw) {
  constexpr double kFlat_m = 0.01;
  const Scene& scene = raw.scene;
  const Surfaces& surfaces = scene.surfaces;
  struct Heights {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::size_t first = 0;
    bool is_building = false;
  };
  std::vector<Heights> heights(scene.objects.size());
  // In a plain mesh all that has no other name is a building; grounds and roads by name are typed
  // so.
  const bool by_type = raw.is_mesh;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (raw.is_building[surfaces.object[s]] == 0) continue;
    Heights& h = heights[root_of(scene, surfaces.object[s])];
    if (h.high < h.low) h.first = s;
    h.is_building |= !by_type || surfaces.type[s] == SurfaceType::Roof;
    for (const std::uint32_t v : vertices_of(surfaces, s)) {
      h.low = std::min(h.low, scene.vertices[v].z);
      h.high = std::max(h.high, scene.vertices[v].z);
    }
  }
  Finding flat{"flat_city",
               Severity::Warning,
               "",
               "",
               "buildings have no height: they shade nothing",
               "give the file with heights, or choose a level of detail that has them; they lie "
               "flat as they are",
               0};
  for (const Heights& h : heights) {
    if (!h.is_building || h.high - h.low > kFlat_m) continue;
    if (flat.count++ > 0) continue;
    flat.object = raw.object_of(h.first);
    flat.where = place_in_file(scene, scene.vertices[surfaces.outer_ring(h.first)[0]]);
  }
  return flat.count > 0 ? std::optional(flat) : std::nullopt;
}

// Huge triangles.

double longest_edge(const Scene& scene, std::size_t s) {
  double longest = 0.0;
  const auto ring = scene.surfaces.outer_ring(s);
  std::uint32_t from = ring.back();
  for (const std::uint32_t to : ring) {
    longest = std::max(longest, length(scene.vertices[to] - scene.vertices[from]));
    from = to;
  }
  return longest;
}

std::optional<Finding> huge_triangles(const RawScene& raw) {
  constexpr double kHuge_m = 5000.0, kTimesUsual = 100.0;
  const Scene& scene = raw.scene;
  std::vector<std::pair<double, std::size_t>> huge;
  std::vector<double> usual;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const double edge = longest_edge(scene, s);
    if (edge > kHuge_m) huge.emplace_back(edge, s);
    if (edge <= kHuge_m) usual.push_back(edge);
  }
  if (huge.empty() || usual.empty()) return std::nullopt;
  const double median = median_of(std::move(usual));
  std::erase_if(huge, [&](const auto& one) { return one.first <= kTimesUsual * median; });
  if (huge.empty()) return std::nullopt;
  const auto [edge, s] = huge.front();
  return Finding{
      "huge_triangle",
      Severity::Note,
      raw.object_of(s),
      place_in_file(scene, scene.vertices[scene.surfaces.outer_ring(s)[0]]),
      fmt::format("faces have edges beyond 5 km (here {:.1f} km), where the others have {:.3g} m",
                  edge / 1000.0, median),
      "taken as they are; rounding moves all sensors a quarter of a millimetre off their surfaces "
      "for each kilometre: cut such faces where the rest ends",
      huge.size()};
}

/// Terrain and water are measured as coarsely as they are even: their faces tell no unit.
bool may_be_of_any_size(const Scene& scene, std::size_t s) {
  return scene.surfaces.type[s] == SurfaceType::Ground ||
         scene.surfaces.type[s] == SurfaceType::Water;
}

/// A model in millimetres is a thousand times too large, one in kilometres too small to see.
std::optional<Finding> unlikely_size(const RawScene& raw) {
  constexpr double kLarge_m = 200.0, kSmall_m = 0.02;
  const Scene& scene = raw.scene;
  std::vector<double> edges;
  edges.reserve(scene.surfaces.size());
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    if (!may_be_of_any_size(scene, s)) edges.push_back(longest_edge(scene, s));
  }
  if (edges.empty()) return std::nullopt;
  const double longest = *std::max_element(edges.begin(), edges.end());
  const double median = median_of(std::move(edges));
  if (median <= kLarge_m && longest >= kSmall_m) return std::nullopt;
  return Finding{"unlikely_size",
                 Severity::Note,
                 raw.object_of(0),
                 place_in_file(scene, scene.vertices[scene.surfaces.outer_ring(0)[0]]),
                 fmt::format("half of the faces have edges beyond {:.3g} m, none beyond {:.3g} m",
                             median, longest),
                 median > kLarge_m
                     ? "taken as metres; for a model in millimetres give --scale 0.001"
                     : "taken as metres; for a model in kilometres give --scale 1000",
                 1};
}

}  // namespace

void check_geometry(RawScene& raw) {
  constexpr std::array kChecks{coincident_faces, far_parts, flat_buildings, huge_triangles,
                               unlikely_size};
  std::array<std::optional<Finding>, kChecks.size()> found;
  parallel_for(kChecks.size(), 1, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) found[k] = kChecks[k](raw);
  });
  for (std::optional<Finding>& finding : found) {
    if (finding) raw.findings.add(std::move(*finding));
  }
}

}  // namespace tenku
