#include "scene/citygml_member.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/error.h"
#include "scene/citygml_types.h"

namespace tenku {
namespace {

constexpr int kLods = 5;

/// The highest of the levels given as bits; -1 if there is none.
int highest_of(unsigned lods) { return std::bit_width(lods) - 1; }

Vec3 transformed(const std::array<double, 16>& m, Vec3 p) {
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}

}  // namespace

void GmlMember::begin_polygon(const GmlPlace& place) {
  const auto ring = static_cast<std::uint32_t>(rings_.size());
  polygons_.push_back({place, ring, ring});
}

void GmlMember::add_ring(const std::vector<Vec3>& points, bool inner) {
  expects(!polygons_.empty(), "a ring stands in a polygon");
  Polygon& polygon = polygons_.back();
  const auto first = static_cast<std::uint32_t>(points_.size());
  points_.insert(points_.end(), points.begin(), points.end());
  const Ring ring{first, static_cast<std::uint32_t>(points_.size())};
  // The outer ring is the first, in whatever order the file has them.
  const auto at = inner ? rings_.end() : rings_.begin() + polygon.first_ring;
  rings_.insert(at, ring);
  ++polygon.end_ring;
}

std::uint32_t GmlMember::add_shell(bool inner) {
  shells_.push_back({inner});
  return static_cast<std::uint32_t>(shells_.size() - 1);
}

void GmlMember::add_reference(std::string_view id, const GmlPlace& place) {
  if (id.starts_with('#')) id.remove_prefix(1);
  references_.push_back({std::string(id), place});
}

bool GmlMember::name_polygons(std::string_view id, std::size_t first) {
  if (first == polygons_.size()) return true;
  const Range range{static_cast<std::uint32_t>(first),
                    static_cast<std::uint32_t>(polygons_.size())};
  return named_.try_emplace(std::string(id), range).second;
}

void GmlMember::transform_polygons(std::size_t first, const std::array<double, 16>& matrix,
                                   Vec3 by) {
  if (first >= polygons_.size()) return;
  for (std::size_t r = polygons_[first].first_ring; r < rings_.size(); ++r) {
    for (std::uint32_t p = rings_[r].first; p < rings_[r].end; ++p) {
      points_[p] = transformed(matrix, points_[p]) + by;
      if (!is_finite(points_[p])) throw InputError("a template is placed at infinity");
    }
  }
}

void GmlMember::add_copies(const GmlMember& from, const GmlPlace& place) {
  std::vector<Vec3> points;
  for (const Polygon& polygon : from.polygons_) {
    begin_polygon(place);
    polygons_.back().place.is_turned = polygon.place.is_turned;
    for (std::uint32_t r = polygon.first_ring; r < polygon.end_ring; ++r) {
      const Ring ring = from.rings_[r];
      points.assign(from.points_.begin() + ring.first, from.points_.begin() + ring.end);
      add_ring(points, r > polygon.first_ring);
    }
  }
}

void GmlMember::refer(std::uint32_t p, const GmlPlace& place) {
  Shell* shell = place.shell == kNone ? nullptr : &shells_[place.shell];
  if (polygons_[p].place.lod != place.lod) {
    // A level may borrow a face of another: it is there once in each.
    Polygon copy = polygons_[p];
    copy.place = place;
    copy.place.is_turned = copy.place.is_turned != polygons_[p].place.is_turned;
    polygons_.push_back(copy);
    return;
  }
  GmlPlace& own = polygons_[p].place;
  if (place.is_surface && !own.is_surface) {
    own.surface = place.surface;
    own.is_surface = true;
  }
  if (shell == nullptr) return;
  if (own.shell == kNone && own.object == place.object && !place.is_turned) {
    own.shell = place.shell;
  } else {
    shell->is_whole = false;
  }
}

void GmlMember::resolve(const Reference& reference) {
  const auto at = named_.find(reference.id);
  if (at != named_.end()) {
    for (std::uint32_t p = at->second.first; p < at->second.end; ++p) refer(p, reference.place);
    return;
  }
  if (reference.place.shell != kNone) shells_[reference.place.shell].is_whole = false;
  raw_.findings.add({"unresolved_xlink", Severity::Warning,
                     raw_.scene.objects[reference.place.object].id, "",
                     "geometry is named that is not in the same member of the model ('" +
                         reference.id.substr(0, 60) + "')",
                     "left out"});
}

int GmlMember::chosen_lod(std::uint32_t object, int highest_of_parts, unsigned lods) {
  const int highest = highest_of(lods);
  if (highest < 0) return -1;
  int chosen = highest;
  if (!wanted_lod_.empty()) {
    for (int lod = 0; lod < kLods; ++lod) {
      if (wanted_lod_ == std::to_string(lod) && (lods >> static_cast<unsigned>(lod) & 1U) != 0) {
        chosen = lod;
      }
    }
    const bool is_found = wanted_lod_ == std::to_string(chosen);
    if (!is_found && raw_.is_building[object] != 0 && highest_of_parts < 0) {
      raw_.findings.add({"missing_lod", Severity::Warning, raw_.scene.objects[object].id, "",
                         "the object has no LOD " + wanted_lod_,
                         "its LOD " + std::to_string(highest) + " is used"});
    }
  }
  // A footprint or block whose parts are given in more detail would only double them.
  const bool is_doubled =
      (wanted_lod_.empty() && highest_of_parts > chosen) || (chosen < 1 && highest_of_parts >= 1);
  return is_doubled ? -1 : chosen;
}

void GmlMember::choose_lods(std::uint32_t first_object) {
  const auto& objects = raw_.scene.objects;
  const std::size_t count = objects.size() - first_object;
  std::vector<unsigned> lods(count, 0);
  std::vector<int> of_parts(count, -1);
  for (const Polygon& polygon : polygons_) {
    lods[polygon.place.object - first_object] |= 1U << static_cast<unsigned>(polygon.place.lod);
  }
  // Parts come after what they are parts of, so that parts of parts are known first.
  for (std::size_t o = count; o-- > 0;) {
    const SceneObject& object = objects[first_object + o];
    if (object.parent == kNone || !object.type.ends_with("Part")) continue;
    int& highest = of_parts[object.parent - first_object];
    highest = std::max({highest, highest_of(lods[o]), of_parts[o]});
  }
  chosen_.resize(count);
  for (std::uint32_t o = 0; o < count; ++o) {
    chosen_[o] = chosen_lod(first_object + o, of_parts[o], lods[o]);
  }
}

std::uint8_t GmlMember::lod_index(int lod) {
  auto& labels = raw_.scene.lods;
  const std::string label = std::to_string(lod);
  const auto at = std::find(labels.begin(), labels.end(), label);
  const auto index = static_cast<std::uint8_t>(at - labels.begin());
  if (at == labels.end()) labels.push_back(label);
  return index;
}

SurfaceFacts GmlMember::facts_of(const Polygon& polygon) {
  const SceneObject& object = raw_.scene.objects[polygon.place.object];
  const CityObjectKind kind = citygml_object_kind(object.type).value_or(CityObjectKind{});
  raw_.scene.has_terrain |= kind.is_terrain;
  raw_.scene.is_city |= kind.is_building;
  SurfaceFacts facts;
  facts.object = polygon.place.object;
  facts.lod = lod_index(polygon.place.lod);
  facts.type = kind.type;
  if (polygon.place.surface.type != SurfaceType::Unknown) facts.type = polygon.place.surface.type;
  if (raw_.is_building[facts.object] != 0 && polygon.place.lod == 0) {
    facts.type = SurfaceType::Ground;
    raw_.findings.add({"footprint_only", Severity::Warning, object.id, "",
                       "the building has only a footprint (LOD 0)", "read as flat ground"});
  }
  if (polygon.place.shell == kNone || !shells_[polygon.place.shell].is_whole) return facts;
  Shell& shell = shells_[polygon.place.shell];
  if (shell.in_scene == kNone) {
    shell.in_scene = static_cast<std::uint32_t>(raw_.is_inner_shell.size());
    raw_.is_inner_shell.push_back(shell.is_inner ? 1 : 0);
  }
  facts.shell = shell.in_scene;
  return facts;
}

void GmlMember::append_ring(const Ring& ring, bool reversed) {
  Scene& scene = raw_.scene;
  const std::uint32_t length = ring.end - ring.first;
  for (std::uint32_t k = 0; k < length; ++k) {
    scene.surfaces.vertex.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
    scene.vertices.push_back(points_[reversed ? ring.end - 1 - k : ring.first + k]);
  }
  if (scene.vertices.size() >= kNone) throw InputError("more than 4 billion vertices");
  end_ring(scene.surfaces);
}

void GmlMember::append(const Polygon& polygon) {
  if (polygon.place.surface.is_virtual) {
    raw_.findings.add({"closure_surface", Severity::Note,
                       raw_.scene.objects[polygon.place.object].id, "",
                       "closure surfaces close a volume but are not there in reality",
                       "left out, so that light passes"});
    return;
  }
  if (polygon.first_ring == polygon.end_ring) {
    raw_.findings.add({"degenerate_ring", Severity::Warning,
                       raw_.scene.objects[polygon.place.object].id, "",
                       "a ring has fewer than three distinct vertices", "left out"});
    return;
  }
  for (std::uint32_t r = polygon.first_ring; r < polygon.end_ring; ++r) {
    append_ring(rings_[r], polygon.place.is_turned);
  }
  end_surface(raw_.scene.surfaces, facts_of(polygon));
}

void GmlMember::append_chosen(std::uint32_t first_object) {
  std::vector<std::uint32_t> order(polygons_.size());
  std::iota(order.begin(), order.end(), 0U);
  // The faces of a shell stand together in a scene.
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const GmlPlace &first = polygons_[a].place, &second = polygons_[b].place;
    return std::pair(first.object, first.shell) < std::pair(second.object, second.shell);
  });
  for (const std::uint32_t p : order) {
    const Polygon& polygon = polygons_[p];
    if (polygon.place.lod == chosen_[polygon.place.object - first_object]) append(polygon);
  }
}

void GmlMember::finish(std::uint32_t first_object) {
  for (const Reference& reference : references_) resolve(reference);
  for (const Polygon& polygon : polygons_) {
    const std::size_t rings = polygon.end_ring - polygon.first_ring;
    if (rings == 0) continue;
    std::size_t vertices = 0;
    for (std::uint32_t r = polygon.first_ring; r < polygon.end_ring; ++r) {
      vertices += rings_[r].end - rings_[r].first;
    }
    // A surface of n vertices in all and h inner rings makes n + 2 h - 2 triangles.
    const std::size_t triangles = vertices + 2 * rings;
    raw_.scene.lod_triangles[std::to_string(polygon.place.lod)] +=
        triangles > 4 ? triangles - 4 : 0;
  }
  choose_lods(first_object);
  append_chosen(first_object);
  clear();
}

void GmlMember::clear() {
  points_.clear();
  rings_.clear();
  polygons_.clear();
  shells_.clear();
  references_.clear();
  named_.clear();
}

}  // namespace tenku
