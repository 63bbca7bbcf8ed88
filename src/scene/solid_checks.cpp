#include "scene/solid_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "scene/geometry_checks.h"

namespace tenku {
namespace {

constexpr double kDeep_m = 0.2;     // below its face a point is inside of a solid
constexpr double kOverlap_m = 0.2;  // of boxes
constexpr double kCorner = 0.2;     // of the way along both edges
constexpr double kLeastCorner_m = 0.2;
constexpr std::size_t kGrain = 64;
constexpr double kUpright = 1e-6;  // cosine of the slope of a wall

using SurfaceList = std::vector<std::uint32_t>;

Extent box_of(const Scene& scene, const SurfaceList& surfaces) {
  Extent box;
  for (const std::uint32_t s : surfaces) {
    for (const std::uint32_t v : scene.surfaces.outer_ring(s)) box.add(scene.vertices[v]);
  }
  return box;
}

bool is_in(const Extent& box, Vec3 p) {
  return p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y &&
         p.z > box.min.z && p.z < box.max.z;
}

/// Faces that enclose a space.
class Shell {
 public:
  Shell(const Scene& scene, SurfaceList surfaces)
      : scene_(&scene), surfaces_(std::move(surfaces)), box_(box_of(scene, surfaces_)) {
    for (const std::uint32_t s : surfaces_) {
      normal_.push_back(area_vector(scene, s));
      const bool is_upright = !(std::abs(normal_.back().z) > kUpright * length(normal_.back()));
      span_.push_back(is_upright ? Extent{} : box_of(scene, {s}));
    }
  }

  const Extent& box() const { return box_; }
  const SurfaceList& surfaces() const { return surfaces_; }
  Vec3 normal(std::size_t k) const { return normal_[k]; }

  /// Whether an odd number of faces lies straight above.
  bool holds(Vec3 p) const {
    if (!is_in(box_, p)) return false;
    bool is_inside = false;
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
      const Extent& span = span_[k];
      const bool is_beside = !(p.x > span.min.x && p.x < span.max.x && p.y > span.min.y &&
                               p.y < span.max.y && p.z < span.max.z);
      if (is_beside || !is_over(surfaces_[k], p)) continue;
      if (height(k, p) > p.z) is_inside = !is_inside;
    }
    return is_inside;
  }

 private:
  /// Seen from above, by the odd-even rule.
  bool is_over(std::uint32_t s, Vec3 p) const {
    bool is_inside = false;
    const Surfaces& surfaces = scene_->surfaces;
    for (std::uint32_t r = surfaces.first_ring[s]; r < surfaces.first_ring[s + 1]; ++r) {
      const auto ring = surfaces.ring(r);
      Vec3 a = scene_->vertices[ring.back()];
      for (const std::uint32_t v : ring) {
        const Vec3 b = scene_->vertices[v];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
          is_inside = !is_inside;
        }
        a = b;
      }
    }
    return is_inside;
  }

  double height(std::size_t k, Vec3 p) const {
    const Vec3 n = normal_[k], a = scene_->vertices[scene_->surfaces.outer_ring(surfaces_[k])[0]];
    return a.z - ((p.x - a.x) * n.x + (p.y - a.y) * n.y) / n.z;
  }

  const Scene* scene_;
  SurfaceList surfaces_;
  Extent box_;
  std::vector<Vec3> normal_;
  std::vector<Extent> span_;  // [surface of the shell]; inside out: upright
};

/// Points just inside of a solid, below the corners and the middle of a face.
std::vector<Vec3> points_below(const Scene& scene, const Shell& shell, std::size_t k) {
  std::vector<Vec3> points;
  const auto ring = scene.surfaces.outer_ring(shell.surfaces()[k]);
  const Vec3 n = shell.normal(k);
  if (!(length(n) > 0.0)) return points;
  const Vec3 inward = (-kDeep_m / length(n)) * n;
  Vec3 middle{};
  const std::size_t count = ring.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 at = scene.vertices[ring[i]];
    const auto step = [&](std::uint32_t to) {
      const Vec3 way = scene.vertices[to] - at;
      const double whole = length(way);
      return whole > 0.0 ? std::max(kCorner, std::min(0.5, kLeastCorner_m / whole)) * way : Vec3{};
    };
    points.push_back(at + step(ring[(i + count - 1) % count]) + step(ring[(i + 1) % count]) +
                     inward);
    middle = middle + at;
  }
  points.push_back((1.0 / static_cast<double>(count)) * middle + inward);
  return points;
}

bool overlap(const Extent& a, const Extent& b) {
  const auto by = [](double a0, double a1, double b0, double b1) {
    return std::min(a1, b1) - std::max(a0, b0) > kOverlap_m;
  };
  return by(a.min.x, a.max.x, b.min.x, b.max.x) && by(a.min.y, a.max.y, b.min.y, b.max.y) &&
         by(a.min.z, a.max.z, b.min.z, b.max.z);
}

/// A place of `one` that lies in both.
std::optional<Vec3> place_in_both(const Scene& scene, const Shell& one, const Shell& other) {
  for (std::size_t k = 0; k < one.surfaces().size(); ++k) {
    for (const Vec3 p : points_below(scene, one, k)) {
      if (is_in(other.box(), p) && one.holds(p) && other.holds(p)) return p;
    }
  }
  return std::nullopt;
}

bool is_whole_building(const RawScene& raw, std::uint32_t object) {
  const std::string& type = raw.scene.objects[object].type;
  return raw.is_building[object] != 0 &&
         (type.empty() || type == "Building" || type == "BuildingPart");
}

void tell_overlaps(RawScene& raw) {
  const Scene& scene = raw.scene;
  std::unordered_map<std::uint32_t, SurfaceList> of_object;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    if (is_whole_building(raw, scene.surfaces.object[s])) {
      of_object[scene.surfaces.object[s]].push_back(s);
    }
  }
  struct Building {
    std::uint32_t object;
    Shell shell;
  };
  struct Overlap {
    std::uint32_t object, other;
    Vec3 place;
  };
  std::vector<Building> buildings;
  for (auto& [object, list] : of_object) buildings.push_back({object, Shell(scene, list)});
  std::sort(buildings.begin(), buildings.end(), [](const Building& a, const Building& b) {
    return std::pair(a.shell.box().min.x, a.object) < std::pair(b.shell.box().min.x, b.object);
  });
  std::vector<std::vector<Overlap>> found(buildings.size());
  parallel_for(buildings.size(), kGrain, [&](IndexRange range) {
    for (std::size_t a = range.begin; a < range.end; ++a) {
      const Building& one = buildings[a];
      for (std::size_t b = a + 1; b < buildings.size(); ++b) {
        const Building& other = buildings[b];
        if (other.shell.box().min.x > one.shell.box().max.x) break;
        if (!overlap(one.shell.box(), other.shell.box())) continue;
        if (const auto place = place_in_both(scene, one.shell, other.shell)) {
          found[a].push_back({one.object, other.object, *place});
        } else if (const auto back = place_in_both(scene, other.shell, one.shell)) {
          found[a].push_back({other.object, one.object, *back});
        }
      }
    }
  });
  for (const auto& list : found) {
    for (const Overlap& o : list) {
      raw.findings.add({"overlapping_buildings", Severity::Warning, scene.objects[o.object].id,
                        place_in_file(scene, o.place),
                        "the building lies in part in [" + scene.objects[o.other].id + "]",
                        "read as they are"});
    }
  }
}

/// Surfaces of one shell of a solid, in a row.
struct ShellRun {
  SurfaceList surfaces;
  bool is_inner;
};

std::vector<ShellRun> shells_of(const RawScene& raw) {
  const Surfaces& surfaces = raw.scene.surfaces;
  std::vector<ShellRun> runs;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces.shell[s] == kNone) continue;
    const bool goes_on = s > 0 && !runs.empty() && surfaces.shell[s - 1] == surfaces.shell[s] &&
                         surfaces.object[s - 1] == surfaces.object[s];
    if (!goes_on) runs.push_back({{}, raw.is_inner_shell[surfaces.shell[s]] != 0});
    runs.back().surfaces.push_back(s);
  }
  return runs;
}

/// How many parts have no vertex in common.
std::size_t parts_of(const Scene& scene, const SurfaceList& shell) {
  std::unordered_map<std::uint32_t, std::uint32_t> surface_at;  // [vertex] the first
  std::vector<std::uint32_t> root(shell.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
  };
  for (std::uint32_t k = 0; k < shell.size(); ++k) {
    const Surfaces& surfaces = scene.surfaces;
    for (std::uint32_t r = surfaces.first_ring[shell[k]]; r < surfaces.first_ring[shell[k] + 1];
         ++r) {
      for (const std::uint32_t v : surfaces.ring(r)) {
        const auto [known, is_new] = surface_at.emplace(v, k);
        if (!is_new) root[find(k)] = find(known->second);
      }
    }
  }
  std::size_t count = 0;
  for (std::uint32_t k = 0; k < shell.size(); ++k) count += find(k) == k ? 1 : 0;
  return count;
}

void tell_shells(RawScene& raw) {
  const Scene& scene = raw.scene;
  const SurfaceList* outer = nullptr;
  const std::vector<ShellRun> runs = shells_of(raw);
  for (const ShellRun& run : runs) {
    const std::string& id = raw.object_of(run.surfaces[0]);
    if (const std::size_t parts = parts_of(scene, run.surfaces); parts > 1) {
      raw.findings.add(
          {"shell_in_parts", Severity::Warning, id,
           place_in_file(scene, scene.vertices[scene.surfaces.outer_ring(run.surfaces[0])[0]]),
           fmt::format("a shell of a solid is in {} parts that do not touch", parts),
           "read as it is"});
    }
    if (!run.is_inner) {
      outer = &run.surfaces;
      continue;
    }
    if (outer == nullptr) continue;
    const Shell around(scene, *outer);
    for (const std::uint32_t s : run.surfaces) {
      const auto ring = scene.surfaces.outer_ring(s);
      const auto out = std::find_if(ring.begin(), ring.end(), [&](std::uint32_t v) {
        return !around.holds(scene.vertices[v]);
      });
      if (out == ring.end()) continue;
      raw.findings.add({"inner_shell_outside", Severity::Warning, id,
                        place_in_file(scene, scene.vertices[*out]),
                        "a cavity of a solid is not inside of it", "read as it is"});
      break;
    }
  }
}

/// Objects of a city without surfaces of their own or of their parts.
void tell_empty(RawScene& raw) {
  if (!raw.scene.format.starts_with("City")) return;
  std::vector<std::uint8_t> has_surfaces(raw.scene.objects.size());
  for (const std::uint32_t object : raw.scene.surfaces.object) {
    for (std::uint32_t k = object; k != kNone && has_surfaces[k] == 0;
         k = raw.scene.objects[k].parent) {
      has_surfaces[k] = 1;
    }
  }
  for (std::size_t k = 0; k < has_surfaces.size(); ++k) {
    const SceneObject& object = raw.scene.objects[k];
    if (has_surfaces[k] != 0 || object.type == "CityObjectGroup") continue;
    raw.findings.add({"no_geometry", Severity::Note, object.id, "",
                      "objects have no surfaces that could be used", "nothing is there"});
  }
}

}  // namespace

void check_solids(RawScene& raw) {
  tell_shells(raw);
  tell_overlaps(raw);
  tell_empty(raw);
}

}  // namespace tenku
