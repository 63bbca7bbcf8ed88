#include "scene/repair.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "core/random.h"
#include "scene/geometry_checks.h"
#include "scene/triangulation.h"

namespace tenku {
namespace {

constexpr double kFlat_m = 1e-6;  // surfaces narrower than this have no area to speak of

/// Open-addressing table of points, for finding equal ones.
class PointTable {
 public:
  PointTable(std::size_t points, const std::vector<Vec3>& vertices)
      : vertices_(vertices), slots_(std::bit_ceil(2 * points + 2), kNone) {}

  /// The first index that came with the coordinates of `v`; `v` itself if there was none.
  std::uint32_t first_like(std::uint32_t v) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash(vertices_[v]) & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] == kNone) slots_[slot] = v;
      if (vertices_[slots_[slot]] == vertices_[v]) return slots_[slot];
    }
  }

 private:
  static std::uint64_t hash(Vec3 p) {
    // Adding zero makes -0 and +0, which are equal, the same bits.
    std::uint64_t h = mix_bits(std::bit_cast<std::uint64_t>(p.x + 0.0));
    h = mix_bits(h ^ std::bit_cast<std::uint64_t>(p.y + 0.0));
    return mix_bits(h ^ std::bit_cast<std::uint64_t>(p.z + 0.0));
  }

  const std::vector<Vec3>& vertices_;
  std::vector<std::uint32_t> slots_;
};

/// Rewrites surfaces in place, which never grow, as they are read from the front.
class SurfaceRewriter {
 public:
  explicit SurfaceRewriter(Surfaces& surfaces) : s_(surfaces) {}

  void put_vertex(std::uint32_t v) { s_.vertex[vertex_++] = v; }
  std::size_t vertices_in_ring() const { return vertex_ - s_.first_vertex[ring_]; }
  void drop_last_vertex() { --vertex_; }
  std::uint32_t first_in_ring() const { return s_.vertex[s_.first_vertex[ring_]]; }
  std::uint32_t last_in_ring() const { return s_.vertex[vertex_ - 1]; }
  void end_ring() { s_.first_vertex[++ring_] = static_cast<std::uint32_t>(vertex_); }
  void forget_ring() { vertex_ = s_.first_vertex[ring_]; }
  bool has_rings() const { return ring_ > s_.first_ring[surface_]; }

  void end_surface(std::size_t from) {
    s_.type[surface_] = s_.type[from];
    s_.lod[surface_] = s_.lod[from];
    s_.object[surface_] = s_.object[from];
    s_.material[surface_] = s_.material[from];
    s_.shell[surface_] = s_.shell[from];
    s_.first_ring[++surface_] = static_cast<std::uint32_t>(ring_);
  }

  void finish() {
    s_.vertex.resize(vertex_);
    s_.first_vertex.resize(ring_ + 1);
    s_.first_ring.resize(surface_ + 1);
    s_.type.resize(surface_);
    s_.lod.resize(surface_);
    s_.object.resize(surface_);
    s_.material.resize(surface_);
    s_.shell.resize(surface_);
  }

 private:
  Surfaces& s_;
  std::size_t vertex_ = 0, ring_ = 0, surface_ = 0;
};

/// @param ring  one of the surface, for the place
Finding about(const RawScene& raw, std::size_t s, std::span<const std::uint32_t> ring,
              const char* code, Severity severity, const char* what, const char* repair) {
  const Scene& scene = raw.scene;
  std::string where = ring.empty() ? "" : place_in_file(scene, scene.vertices[ring[0]]);
  return {code, severity, raw.object_of(s), std::move(where), what, repair};
}

/// Copies a ring without repeated vertices; true if it lost some.
bool put_tidied(SurfaceRewriter& out, const std::vector<std::uint32_t>& ring) {
  for (const std::uint32_t v : ring) {
    if (out.vertices_in_ring() == 0 || out.last_in_ring() != v) out.put_vertex(v);
  }
  while (out.vertices_in_ring() > 1 && out.last_in_ring() == out.first_in_ring()) {
    out.drop_last_vertex();
  }
  return out.vertices_in_ring() < ring.size();
}

bool has_three_distinct(const std::vector<std::uint32_t>& ring) {
  const auto other = std::find_if(ring.begin(), ring.end(), [&](auto v) { return v != ring[0]; });
  return other != ring.end() &&
         std::any_of(other, ring.end(), [&](auto v) { return v != ring[0] && v != *other; });
}

bool is_flat(const Scene& scene, std::size_t s) {
  const auto ring = scene.surfaces.outer_ring(s);
  const Vec3 start = scene.vertices[ring[0]];
  Vec3 along{};
  for (const std::uint32_t v : ring) {
    const Vec3 d = scene.vertices[v] - start;
    if (dot(d, d) > dot(along, along)) along = d;
  }
  const double longest = length(along);
  if (longest <= kFlat_m) return true;
  return std::all_of(ring.begin(), ring.end(), [&](std::uint32_t v) {
    return length(cross(along, scene.vertices[v] - start)) <= kFlat_m * longest;
  });
}

}  // namespace

void merge_vertices(RawScene& raw) {
  std::vector<Vec3>& vertices = raw.scene.vertices;
  std::vector<std::uint32_t>& used = raw.scene.surfaces.vertex;
  PointTable table(vertices.size(), vertices);
  std::vector<std::uint32_t> new_index(vertices.size(), kNone);
  std::vector<Vec3> kept;
  kept.reserve(vertices.size());
  std::size_t duplicates = 0;
  for (std::uint32_t& v : used) {
    if (new_index[v] == kNone) {
      const std::uint32_t first = table.first_like(v);
      if (first != v) {
        ++duplicates;
      } else {
        new_index[v] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(vertices[v]);
      }
      new_index[v] = new_index[first];
    }
    v = new_index[v];
  }
  const auto unused =
      static_cast<std::size_t>(std::count(new_index.begin(), new_index.end(), kNone));
  vertices = std::move(kept);
  vertices.shrink_to_fit();
  if (!raw.shares_vertices) return;
  if (duplicates > 0) {
    raw.findings.add({"duplicate_vertices", Severity::Note, "", "",
                      "vertices have the same coordinates as others", "made one", duplicates});
  }
  // In a city model they may be those of another level of detail.
  if (unused > 0 && raw.is_mesh) {
    raw.findings.add({"unused_vertices", Severity::Note, "", "", "vertices that no face names",
                      "left out", unused});
  }
}

void tidy_rings(RawScene& raw) {
  const Surfaces& in = raw.scene.surfaces;
  SurfaceRewriter out(raw.scene.surfaces);
  const std::size_t surfaces = in.size();
  std::vector<std::uint32_t> ring;
  // The rewriter overwrites first_ring[s + 1] and first_vertex[r + 1] at the latest when s and r
  // are done, so the ends are carried along.
  std::size_t ring_end = 0, vertex_end = 0;
  for (std::size_t s = 0, r = 0; s < surfaces; ++s) {
    bool keep = true;
    for (ring_end = in.first_ring[s + 1]; r < ring_end; ++r) {
      const std::size_t vertex_begin = vertex_end;
      const bool is_outer = !out.has_rings();
      vertex_end = in.first_vertex[r + 1];
      if (!keep) continue;
      ring.assign(in.vertex.begin() + static_cast<std::ptrdiff_t>(vertex_begin),
                  in.vertex.begin() + static_cast<std::ptrdiff_t>(vertex_end));
      if (put_tidied(out, ring)) {
        raw.findings.add(about(raw, s, ring, "repeated_vertex", Severity::Note,
                               "rings name a vertex twice in a row", "named once"));
      }
      if (has_three_distinct(ring)) {
        out.end_ring();
        continue;
      }
      out.forget_ring();
      raw.findings.add(about(raw, s, ring, "degenerate_ring", Severity::Warning,
                             "rings have fewer than three distinct vertices", "left out"));
      keep = !is_outer;
    }
    if (out.has_rings()) out.end_surface(s);
  }
  out.finish();
}

std::size_t drop_surfaces(RawScene& raw, const std::function<bool(std::size_t)>& is_dropped) {
  const Surfaces& in = raw.scene.surfaces;
  SurfaceRewriter out(raw.scene.surfaces);
  const std::size_t surfaces = in.size();
  std::vector<std::uint8_t> drop(surfaces);
  for (std::size_t s = 0; s < surfaces; ++s) drop[s] = is_dropped(s) ? 1 : 0;
  const auto dropped = static_cast<std::size_t>(std::count(drop.begin(), drop.end(), 1));
  if (dropped == 0) return 0;
  std::size_t ring_end = 0, vertex_end = 0;
  for (std::size_t s = 0, r = 0, v = 0; s < surfaces; ++s) {
    for (ring_end = in.first_ring[s + 1]; r < ring_end; ++r) {
      for (vertex_end = in.first_vertex[r + 1]; v < vertex_end; ++v) {
        if (drop[s] == 0) out.put_vertex(in.vertex[v]);
      }
      if (drop[s] == 0) out.end_ring();
    }
    if (drop[s] == 0) out.end_surface(s);
  }
  out.finish();
  return dropped;
}

void drop_flat_surfaces(RawScene& raw) {
  drop_surfaces(raw, [&](std::size_t s) {
    if (!is_flat(raw.scene, s)) return false;
    raw.findings.add(about(raw, s, raw.scene.surfaces.outer_ring(s), "zero_area_face",
                           Severity::Note, "faces have no area", "left out"));
    return true;
  });
}

void type_building_surfaces(RawScene& raw) {
  Surfaces& surfaces = raw.scene.surfaces;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces.type[s] != SurfaceType::Unknown) continue;
    if (raw.is_building[surfaces.object[s]] == 0) continue;
    surfaces.type[s] = type_by_normal(area_vector(raw.scene, s));
  }
}

void check_polygons(RawScene& raw) {
  const Surfaces& surfaces = raw.scene.surfaces;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces.rings(s) == 1 && surfaces.outer_ring(s).size() == 3) continue;
    const PolygonShape shape = shape_of(raw.scene, s);
    if (shape.off_plane_m > 0.1) {
      raw.findings.add(about(raw, s, raw.scene.surfaces.outer_ring(s), "nonplanar_over_10cm",
                             Severity::Warning, "faces are more than 10 cm off their plane",
                             "triangulated as they are"));
    } else if (shape.off_plane_m > 0.01) {
      raw.findings.add(about(raw, s, raw.scene.surfaces.outer_ring(s), "nonplanar_over_1cm",
                             Severity::Note, "faces are more than 1 cm off their plane",
                             "triangulated as they are"));
    }
    if (!shape.is_simple) {
      raw.findings.add(about(raw, s, raw.scene.surfaces.outer_ring(s), "self_intersecting_ring",
                             Severity::Warning, "rings cut or touch themselves",
                             "filled by the odd-even rule"));
    }
    if (shape.has_stray_hole) {
      raw.findings.add(about(
          raw, s, raw.scene.surfaces.outer_ring(s), "stray_hole", Severity::Warning,
          "holes leave their outer ring or lie in one another", "filled by the odd-even rule"));
    }
  }
}

}  // namespace tenku
