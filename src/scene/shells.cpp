#include <algorithm>
#include <vector>

#include "scene/repair.h"

namespace tenku {
namespace {

/// Consecutive surfaces of one shell, or of one building without shells.
struct Run {
  std::size_t begin = 0, end = 0;
  bool is_shell = false, is_inner = false;
};

enum class Closure { Closed, Misoriented, Open };

struct HalfEdge {
  std::uint64_t key;       ///< both vertices, the smaller one first
  std::int32_t direction;  ///< +1 from the smaller to the larger
};

void add_half_edges(const Surfaces& surfaces, std::size_t s, std::vector<HalfEdge>& edges) {
  for (std::size_t r = surfaces.first_ring[s]; r < surfaces.first_ring[s + 1]; ++r) {
    const auto ring = surfaces.ring(r);
    std::uint64_t from = ring.back();
    for (const std::uint64_t to : ring) {
      edges.push_back({(std::min(from, to) << 32U) | std::max(from, to), from < to ? 1 : -1});
      from = to;
    }
  }
}

/// Closed: every edge is passed as often one way as the other.
Closure closure_of(std::vector<HalfEdge>& edges) {
  std::sort(edges.begin(), edges.end(),
            [](const HalfEdge& a, const HalfEdge& b) { return a.key < b.key; });
  bool balanced = true;
  for (std::size_t i = 0; i < edges.size();) {
    std::int64_t sum = 0;
    std::size_t k = i;
    for (; k < edges.size() && edges[k].key == edges[i].key; ++k) sum += edges[k].direction;
    if ((k - i) % 2 != 0) return Closure::Open;
    balanced = balanced && sum == 0;
    i = k;
  }
  return balanced ? Closure::Closed : Closure::Misoriented;
}

/// Six times the enclosed volume, positive if the normals point outwards.
double signed_volume(const Scene& scene, const Run& run) {
  const Vec3 reference = scene.vertices[scene.surfaces.outer_ring(run.begin)[0]];
  double volume = 0.0;
  for (std::size_t s = run.begin; s < run.end; ++s) {
    const Vec3 p = scene.vertices[scene.surfaces.outer_ring(s)[0]];
    volume += 2.0 * dot(p - reference, area_vector(scene, s));
  }
  return volume;
}

void turn(Surfaces& surfaces, const Run& run) {
  const std::size_t first = surfaces.first_ring[run.begin], last = surfaces.first_ring[run.end];
  for (std::size_t r = first; r < last; ++r) {
    std::reverse(surfaces.vertex.begin() + surfaces.first_vertex[r],
                 surfaces.vertex.begin() + surfaces.first_vertex[r + 1]);
  }
}

/// A run that begins at surface `s`; empty shells and plain meshes make runs that are passed over.
Run run_from(const RawScene& raw, std::size_t s) {
  const Surfaces& surfaces = raw.scene.surfaces;
  Run run{s, s + 1, surfaces.shell[s] != kNone};
  run.is_inner = run.is_shell && raw.is_inner_shell[surfaces.shell[s]] != 0;
  while (run.end < surfaces.size() && surfaces.shell[run.end] == surfaces.shell[s] &&
         surfaces.object[run.end] == surfaces.object[s]) {
    ++run.end;
  }
  return run;
}

void tell(RawScene& raw, const Run& run, const char* code, const char* what, const char* repair) {
  raw.findings.add({code, Severity::Warning, raw.object_of(run.begin), "", what, repair});
}

}  // namespace

void orient_shells(RawScene& raw) {
  Surfaces& surfaces = raw.scene.surfaces;
  std::vector<HalfEdge> edges;
  for (std::size_t s = 0; s < surfaces.size();) {
    const Run run = run_from(raw, s);
    s = run.end;
    if (!run.is_shell && raw.is_building[surfaces.object[run.begin]] == 0) continue;
    edges.clear();
    for (std::size_t k = run.begin; k < run.end; ++k) add_half_edges(surfaces, k, edges);
    const Closure closure = closure_of(edges);
    if (closure == Closure::Closed && (signed_volume(raw.scene, run) < 0.0) != run.is_inner) {
      turn(surfaces, run);
      tell(raw, run, "inverted_shell", "a closed shell is inside out", "turned");
    } else if (closure == Closure::Open && run.is_shell) {
      tell(raw, run, "open_shell", "the shell of a solid is not closed", "read as it is");
    } else if (closure == Closure::Misoriented && run.is_shell) {
      tell(raw, run, "misoriented_faces", "faces of a shell look to different sides",
           "read as they are");
    }
  }
}

}  // namespace tenku
