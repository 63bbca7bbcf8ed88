#include "scene/honeybee_reader.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scene/honeybee_modifiers.h"
#include "scene/input_file.h"
#include "scene/text_cursor.h"

namespace tenku {
namespace {

using Ring = std::vector<Vec3>;

/// Twice the area, along the normal.
Vec3 doubled_area(const Ring& ring) {
  Vec3 sum{};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    sum = sum + cross(ring[k] - ring[0], ring[(k + 1) % ring.size()] - ring[0]);
  }
  return sum;
}

struct UnitRow {
  std::string_view name;
  double metres;
};
constexpr std::array<UnitRow, 5> kUnits{{{"Meters", 1.0},
                                         {"Millimeters", 0.001},
                                         {"Centimeters", 0.01},
                                         {"Feet", 0.3048},
                                         {"Inches", 0.0254}}};

/// What is handed down from a room to all in it.
struct Surroundings {
  std::string set;  ///< identifier of the room's modifier set
  std::uint32_t parent = kNone;
};

class HoneybeeReader {
 public:
  HoneybeeReader(std::string bytes, const std::string& file)
      : source_(file),
        bytes_(std::move(bytes)),
        model_(parse_json(parser_, bytes_, source_)),
        modifiers_(model_, source_, raw_) {}

  RawScene read(Progress& progress);

 private:
  void read_units();
  std::uint32_t add_object(JsonElement element, std::uint32_t parent);
  Ring ring_of(JsonElement points, const std::string& id) const;
  std::vector<Ring> rings_of(JsonElement element, const std::string& id) const;
  std::string boundary_of(JsonElement element) const;
  bool is_read_already(JsonElement element, const std::vector<Ring>& rings);
  void add_polygon(std::vector<Ring> rings, const SurfaceFacts& facts);
  void add_room(JsonElement room);
  void add_face(JsonElement face, const Surroundings& around);
  void add_aperture(JsonElement aperture, const std::string& face_type, const Surroundings& around);
  void add_door(JsonElement door, const std::string& face_type, const Surroundings& around);
  void add_shades_of(JsonElement element, const Surroundings& around);
  void add_shade(JsonElement shade, const char* where, const Surroundings& around);
  void add_shade_mesh(JsonElement mesh);

  JsonSource source_;
  std::string bytes_;
  simdjson::dom::parser parser_;
  JsonElement model_;
  RawScene raw_;
  HoneybeeModifiers modifiers_;
  std::unordered_map<std::string, double> shared_;  ///< type and id of what two rooms share -> area
};

void HoneybeeReader::read_units() {
  const std::string units = source_.text(model_, "units");
  if (units.empty()) return;
  const auto* row =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitRow& r) { return r.name == units; });
  if (row == kUnits.end()) source_.refuse("the units " + tenku::quoted(units) + " are not known");
  raw_.metres_per_unit = row->metres;
}

std::uint32_t HoneybeeReader::add_object(JsonElement element, std::uint32_t parent) {
  const std::string id = source_.text(element, "identifier");
  if (id.empty()) source_.refuse("an object has no 'identifier'");
  raw_.scene.objects.push_back({id, source_.text(element, "type"), parent});
  raw_.is_building.push_back(0);
  return static_cast<std::uint32_t>(raw_.scene.objects.size() - 1);
}

Ring HoneybeeReader::ring_of(JsonElement points, const std::string& id) const {
  Ring ring;
  for (const JsonElement point : source_.items(points, "boundary")) {
    ring.push_back(source_.point(point, "boundary"));
  }
  if (ring.size() < 3)
    source_.refuse(tenku::quoted(id) + ": a polygon has fewer than three points");
  return ring;
}

/// The outer ring of a Face3D, and its holes turned against it.
std::vector<Ring> HoneybeeReader::rings_of(JsonElement element, const std::string& id) const {
  const auto geometry = JsonSource::member(element, "geometry");
  const auto boundary = geometry ? JsonSource::member(*geometry, "boundary") : std::nullopt;
  if (!boundary) source_.refuse(tenku::quoted(id) + " has no 'boundary' in its 'geometry'");
  std::vector<Ring> rings{ring_of(*boundary, id)};
  for (const JsonElement hole : source_.list(*geometry, "holes")) {
    rings.push_back(ring_of(hole, id));
  }
  return rings;
}

std::string HoneybeeReader::boundary_of(JsonElement element) const {
  const auto condition = JsonSource::member(element, "boundary_condition");
  return condition ? source_.text(*condition, "type") : "Outdoors";
}

/// Two rooms that touch each have the wall between them: the second is the first again.
bool HoneybeeReader::is_read_already(JsonElement element, const std::vector<Ring>& rings) {
  if (boundary_of(element) != "Surface") return false;
  const std::string type = source_.text(element, "type") + "/";
  const double area = length(doubled_area(rings[0]));
  shared_[type + source_.text(element, "identifier")] = area;
  const auto others = source_.list(*JsonSource::member(element, "boundary_condition"),
                                   "boundary_condition_objects");
  std::string_view other;
  if (others.empty() || others[0].get(other) != simdjson::SUCCESS) return false;
  const auto met = shared_.find(type + std::string(other));
  constexpr double kSameArea = 1e-3;
  if (met == shared_.end() || std::abs(met->second - area) > kSameArea * area) return false;
  raw_.findings.add({"shared_face", Severity::Note, source_.text(element, "identifier"), "",
                     "two rooms share the surface, and each has it",
                     "read once, as the first room has it"});
  return true;
}

void HoneybeeReader::add_polygon(std::vector<Ring> rings, const SurfaceFacts& facts) {
  Scene& scene = raw_.scene;
  const Vec3 normal = doubled_area(rings[0]);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (r > 0 && dot(doubled_area(rings[r]), normal) > 0.0) {
      std::reverse(rings[r].begin(), rings[r].end());
    }
    for (const Vec3 corner : rings[r]) {
      scene.surfaces.vertex.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
      scene.vertices.push_back(corner);
    }
    end_ring(scene.surfaces);
  }
  end_surface(scene.surfaces, facts);
}

void HoneybeeReader::add_face(JsonElement face, const Surroundings& around) {
  const std::string id = source_.text(face, "identifier");
  const Surroundings inside{around.set, add_object(face, around.parent)};
  const std::string type = source_.text(face, "face_type"), boundary = boundary_of(face);
  add_shades_of(face, inside);
  std::vector<Ring> rings = rings_of(face, id);
  const bool is_first = !is_read_already(face, rings);
  double open = 0.0;
  const auto cut_out = [&](JsonElement part) {
    Ring ring = rings_of(part, source_.text(part, "identifier"))[0];
    open += length(doubled_area(ring));
    rings.push_back(std::move(ring));
  };
  for (const JsonElement aperture : source_.list(face, "apertures")) {
    cut_out(aperture);
    add_aperture(aperture, type, inside);
  }
  for (const JsonElement door : source_.list(face, "doors")) {
    cut_out(door);
    add_door(door, type, inside);
  }
  if (type == "AirBoundary") {
    raw_.findings.add({"air_boundary", Severity::Note, id, "",
                       "air boundaries are not there in reality",
                       "left out, so that light passes"});
    return;
  }
  // A face that is all window has nothing left.
  constexpr double kAll = 1.0 - 1e-6;
  if (!is_first || open >= kAll * length(doubled_area(rings[0]))) return;
  SurfaceFacts facts;
  facts.object = inside.parent;
  const bool is_outside = boundary == "Outdoors" || boundary == "Ground";
  const bool is_wall = type != "Floor" && type != "RoofCeiling";
  facts.type = is_wall                  ? SurfaceType::Wall
               : type == "Floor"        ? SurfaceType::Floor
               : boundary == "Outdoors" ? SurfaceType::Roof
                                        : SurfaceType::Ceiling;
  const char* set = is_wall ? "wall_set" : type == "Floor" ? "floor_set" : "roof_ceiling_set";
  facts.material = modifiers_.of(face, around.set,
                                 {set, is_outside ? "exterior_modifier" : "interior_modifier"});
  add_polygon(std::move(rings), facts);
}

void HoneybeeReader::add_aperture(JsonElement aperture, const std::string& face_type,
                                  const Surroundings& around) {
  const Surroundings inside{around.set, add_object(aperture, around.parent)};
  add_shades_of(aperture, inside);
  std::vector<Ring> rings = rings_of(aperture, source_.text(aperture, "identifier"));
  if (is_read_already(aperture, rings)) return;
  const bool is_level = face_type == "RoofCeiling" || face_type == "Floor";
  const char* key = boundary_of(aperture) == "Surface"      ? "interior_modifier"
                    : is_level                              ? "skylight_modifier"
                    : source_.flag(aperture, "is_operable") ? "operable_modifier"
                                                            : "window_modifier";
  SurfaceFacts facts;
  facts.object = inside.parent;
  facts.type = SurfaceType::Window;
  facts.material = modifiers_.of(aperture, around.set, {"aperture_set", key});
  add_polygon(std::move(rings), facts);
}

void HoneybeeReader::add_door(JsonElement door, const std::string& face_type,
                              const Surroundings& around) {
  const Surroundings inside{around.set, add_object(door, around.parent)};
  add_shades_of(door, inside);
  std::vector<Ring> rings = rings_of(door, source_.text(door, "identifier"));
  if (is_read_already(door, rings)) return;
  const bool is_inner = boundary_of(door) == "Surface", is_glass = source_.flag(door, "is_glass");
  const bool is_level = face_type == "RoofCeiling" || face_type == "Floor";
  const char* key = is_glass   ? (is_inner ? "interior_glass_modifier" : "exterior_glass_modifier")
                    : is_inner ? "interior_modifier"
                    : is_level ? "overhead_modifier"
                               : "exterior_modifier";
  SurfaceFacts facts;
  facts.object = inside.parent;
  facts.type = is_glass ? SurfaceType::Window : SurfaceType::Door;
  facts.material = modifiers_.of(door, around.set, {"door_set", key});
  add_polygon(std::move(rings), facts);
}

void HoneybeeReader::add_shade(JsonElement shade, const char* where, const Surroundings& around) {
  SurfaceFacts facts;
  facts.object = add_object(shade, around.parent);
  facts.material = modifiers_.of(shade, around.set, {"shade_set", where});
  add_polygon(rings_of(shade, source_.text(shade, "identifier")), facts);
}

void HoneybeeReader::add_shades_of(JsonElement element, const Surroundings& around) {
  for (const JsonElement shade : source_.list(element, "indoor_shades")) {
    add_shade(shade, "interior_modifier", around);
  }
  for (const JsonElement shade : source_.list(element, "outdoor_shades")) {
    add_shade(shade, "exterior_modifier", around);
  }
}

void HoneybeeReader::add_shade_mesh(JsonElement mesh) {
  SurfaceFacts facts;
  facts.object = add_object(mesh, kNone);
  facts.material = modifiers_.of(mesh, "", {"shade_set", "context"});
  const auto geometry = JsonSource::member(mesh, "geometry");
  if (!geometry) source_.refuse("a shade mesh has no 'geometry'");
  Scene& scene = raw_.scene;
  const std::size_t first = scene.vertices.size();
  for (const JsonElement point : source_.list(*geometry, "vertices")) {
    scene.vertices.push_back(source_.point(point, "vertices"));
  }
  for (const JsonElement face : source_.list(*geometry, "faces")) {
    for (const JsonElement corner : source_.items(face, "faces")) {
      const std::size_t at = source_.as_whole(corner, "faces");
      if (at >= scene.vertices.size() - first) {
        source_.refuse("a vertex index of a shade mesh is out of range");
      }
      scene.surfaces.vertex.push_back(static_cast<std::uint32_t>(first + at));
    }
    end_ring(scene.surfaces);
    end_surface(scene.surfaces, facts);
  }
}

void HoneybeeReader::add_room(JsonElement room) {
  const Surroundings outside{"", add_object(room, kNone)};
  Surroundings inside = outside;
  const auto properties = JsonSource::member(room, "properties");
  const auto radiance = properties ? JsonSource::member(*properties, "radiance") : std::nullopt;
  if (radiance) inside.set = source_.text(*radiance, "modifier_set");
  add_shades_of(room, inside);
  for (const JsonElement face : source_.list(room, "faces")) add_face(face, inside);
}

RawScene HoneybeeReader::read(Progress& progress) {
  if (!model_.is_object() || source_.text(model_, "type") != "Model") {
    source_.refuse("this is not a Honeybee model: its 'type' is not 'Model'");
  }
  raw_.scene.format = "Honeybee";
  raw_.is_mesh = true;
  raw_.shares_vertices = false;
  raw_.scene.lods = {""};
  read_units();
  for (const JsonElement room : source_.list(model_, "rooms")) {
    progress.stop_if_cancelled();
    add_room(room);
  }
  const Surroundings nothing;
  for (const JsonElement face : source_.list(model_, "orphaned_faces")) add_face(face, nothing);
  for (const JsonElement aperture : source_.list(model_, "orphaned_apertures")) {
    add_aperture(aperture, "Wall", nothing);
  }
  for (const JsonElement door : source_.list(model_, "orphaned_doors")) {
    add_door(door, "Wall", nothing);
  }
  for (const JsonElement shade : source_.list(model_, "orphaned_shades")) {
    add_shade(shade, "context", nothing);
  }
  for (const JsonElement mesh : source_.list(model_, "shade_meshes")) add_shade_mesh(mesh);
  return std::move(raw_);
}

}  // namespace

RawScene read_honeybee(const std::filesystem::path& path, Progress& progress) {
  return HoneybeeReader(read_input_file(path), path.string()).read(progress);
}

}  // namespace tenku
