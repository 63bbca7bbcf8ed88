#include "scene/cityjson_writer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "scene/cityjson_types.h"

namespace tenku {
namespace {

constexpr double kStep_m = 1e-5, kStep_deg = 1e-10;

/// Semantic surfaces by `SurfaceType`; those with a plus are extensions of our own.
constexpr std::array<std::string_view, kSurfaceTypes> kSemantics{
    "+TenkuSurface",       "GroundSurface",     "WallSurface",     "RoofSurface",
    "OuterCeilingSurface", "OuterFloorSurface", "Window",          "Door",
    "TrafficArea",         "WaterSurface",      "+TenkuVegetation"};

void append_text(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  out += '"';
}

void append_material(std::string& out, const Material& m) {
  out += R"("tenku_material":{"name":)";
  append_text(out, m.name);
  const auto put = [&](const char* name, double value) {
    if (value != 0.0) fmt::format_to(std::back_inserter(out), R"(,"{}":{})", name, value);
  };
  const auto put_colour = [&](const char* name, Rgb c) {
    fmt::format_to(std::back_inserter(out), R"(,"{}":[{},{},{}])", name, c.r, c.g, c.b);
  };
  put_colour("reflectance", m.reflectance);
  put("mirror", m.mirror);
  if (m.mirror > 0.0) put_colour("mirror_tint", m.mirror_tint);
  put("mirror_index", m.mirror_index);
  put("index", m.index);
  put("transmittance", m.transmittance);
  if (luminance_of(m.emission_lm_m2) > 0.0) put_colour("emission_lm_m2", m.emission_lm_m2);
  out += '}';
}

/// Numbers that JSON has.
void append_attributes(std::string& out, std::span<const CityJsonAttribute> attributes,
                       std::size_t index, bool is_first) {
  for (const CityJsonAttribute& attribute : attributes) {
    if (!std::isfinite(attribute.values[index])) continue;
    fmt::format_to(std::back_inserter(out), R"({}"{}":{})", is_first ? "" : ",", attribute.name,
                   attribute.values[index]);
    is_first = false;
  }
}

class CityJsonWriter {
 public:
  CityJsonWriter(const Scene& scene, std::span<const CityJsonAttribute> surface_attributes,
                 std::span<const CityJsonAttribute> object_attributes)
      : scene_(scene),
        on_surfaces_(surface_attributes),
        on_objects_(object_attributes),
        step_(scene.map_frame.is_geographic() ? kStep_deg : kStep_m) {}

  std::string write();

 private:
  using Vertex = std::array<long long, 3>;
  Vertex rounded(Vec3 local) const;
  void name_objects();
  void append_header();
  void append_object(std::size_t object, const std::vector<std::size_t>& surfaces);
  std::string type_of(std::size_t object, const std::vector<std::size_t>& surfaces) const;
  void append_family(std::size_t object);
  void append_geometry(const std::vector<std::size_t>& surfaces, const std::string& type);
  void append_boundaries(const std::vector<std::size_t>& surfaces);
  void append_semantics(const std::vector<std::size_t>& surfaces, SurfaceType usual);
  bool has_material(std::size_t s) const {
    return scene_.surfaces.material[s] >= static_cast<std::uint32_t>(kSurfaceTypes);
  }
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  const Scene& scene_;
  std::span<const CityJsonAttribute> on_surfaces_, on_objects_;
  double step_;
  Vec3 origin_{};
  std::string out_;
  std::vector<std::string> names_;               ///< [object], each once
  std::vector<std::vector<std::size_t>> parts_;  ///< [object], objects that are its children
};

CityJsonWriter::Vertex CityJsonWriter::rounded(Vec3 local) const {
  const Vec3 p = scene_.map_frame.to_file(local) - origin_;
  return {std::llround(p.x / step_), std::llround(p.y / step_), std::llround(p.z / kStep_m)};
}

void CityJsonWriter::name_objects() {
  std::set<std::string> used;
  for (const SceneObject& object : scene_.objects) {
    std::string name = object.id;
    for (int k = 2; !used.insert(name).second; ++k) name = fmt::format("{}#{}", object.id, k);
    names_.push_back(name);
  }
  parts_.resize(scene_.objects.size());
  for (std::size_t o = 0; o < scene_.objects.size(); ++o) {
    const std::uint32_t parent = scene_.objects[o].parent;
    if (parent != kNone && city_object_kind(scene_.objects[o].type).is_known) {
      parts_[parent].push_back(o);
    }
  }
}

void CityJsonWriter::append_header() {
  const bool is_geographic = scene_.map_frame.is_geographic();
  const Vec3 origin = scene_.map_frame.origin();
  origin_ = is_geographic ? origin
                          : Vec3{std::round(origin.x), std::round(origin.y), std::round(origin.z)};
  put(R"({{"type":"CityJSON","version":"2.0","transform":{{"scale":[{0},{0},{1}],"translate":)"
      R"([{2},{3},{4}]}},)",
      step_, kStep_m, origin_.x, origin_.y, origin_.z);
  put(R"("metadata":{{"title":)");
  append_text(out_, "written by tenku from " + scene_.format);
  if (scene_.georeference && scene_.georeference->crs.starts_with("EPSG:")) {
    put(R"(,"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/{}")",
        scene_.georeference->crs.substr(5));
  }
  put("}},\n");
}

/// The file's own word where CityJSON has it; else what all its surfaces are.
std::string CityJsonWriter::type_of(std::size_t object,
                                    const std::vector<std::size_t>& surfaces) const {
  const std::string& own = scene_.objects[object].type;
  if (!own.empty() && !own.starts_with('+') && city_object_kind(own).is_known) return own;
  std::set<SurfaceType> types;
  for (const std::size_t s : surfaces) types.insert(scene_.surfaces.type[s]);
  if (types.size() == 1) {
    switch (*types.begin()) {
      case SurfaceType::Ground:
        return "LandUse";
      case SurfaceType::Road:
        return "Road";
      case SurfaceType::Water:
        return "WaterBody";
      case SurfaceType::Vegetation:
        return "PlantCover";
      default:
        break;
    }
  }
  return scene_.is_city ? "Building" : "GenericCityObject";
}

void CityJsonWriter::append_family(std::size_t object) {
  const std::uint32_t parent = scene_.objects[object].parent;
  if (parent != kNone && city_object_kind(scene_.objects[object].type).is_known) {
    out_ += R"(,"parents":[)";
    append_text(out_, names_[parent]);
    out_ += ']';
  }
  if (parts_[object].empty()) return;
  out_ += R"(,"children":[)";
  for (std::size_t k = 0; k < parts_[object].size(); ++k) {
    if (k > 0) out_ += ',';
    append_text(out_, names_[parts_[object][k]]);
  }
  out_ += ']';
}

void CityJsonWriter::append_boundaries(const std::vector<std::size_t>& surfaces) {
  const Surfaces& all = scene_.surfaces;
  out_ += R"("boundaries":[)";
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    out_ += k > 0 ? ",[" : "[";
    const std::size_t first = all.first_ring[surfaces[k]], last = all.first_ring[surfaces[k] + 1];
    for (std::size_t r = first; r < last; ++r) {
      out_ += r > first ? ",[" : "[";
      bool is_first = true;
      for (const std::uint32_t v : all.ring(r)) {
        put("{}{}", is_first ? "" : ",", v);
        is_first = false;
      }
      out_ += ']';
    }
    out_ += ']';
  }
  out_ += ']';
}

/// @param usual  what the object's type says of surfaces without a semantic one
void CityJsonWriter::append_semantics(const std::vector<std::size_t>& surfaces, SurfaceType usual) {
  std::map<std::pair<SurfaceType, std::uint32_t>, std::size_t> known;
  std::string values;
  std::size_t count = 0;
  std::string list;
  for (const std::size_t s : surfaces) {
    if (!values.empty()) values += ',';
    const SurfaceType type = scene_.surfaces.type[s];
    if (type == usual && !has_material(s) && on_surfaces_.empty()) {
      values += "null";
      continue;
    }
    const std::uint32_t material = has_material(s) ? scene_.surfaces.material[s] : kNone;
    const auto [at, is_new] = known.try_emplace({type, material}, count);
    if (!is_new && on_surfaces_.empty()) {
      values += std::to_string(at->second);
      continue;
    }
    fmt::format_to(std::back_inserter(list), R"({}{{"type":"{}")", count == 0 ? "" : ",",
                   kSemantics[static_cast<std::size_t>(type)]);
    if (material != kNone) {
      list += ',';
      append_material(list, scene_.materials[material]);
    }
    append_attributes(list, on_surfaces_, s, false);
    list += '}';
    values += std::to_string(count++);
  }
  if (count == 0) return;
  put(R"(,"semantics":{{"surfaces":[{}],"values":[{}]}})", list, values);
}

void CityJsonWriter::append_geometry(const std::vector<std::size_t>& surfaces,
                                     const std::string& type) {
  constexpr const char* kUsualLod = "2";
  const std::string& lod = scene_.lods[scene_.surfaces.lod[surfaces[0]]];
  put(R"(,"geometry":[{{"type":"MultiSurface","lod":)");
  append_text(out_, lod.empty() ? kUsualLod : lod);
  out_ += ',';
  append_boundaries(surfaces);
  append_semantics(surfaces, city_object_kind(type).type);
  out_ += "}]";
}

void CityJsonWriter::append_object(std::size_t object, const std::vector<std::size_t>& surfaces) {
  const std::string type = type_of(object, surfaces);
  append_text(out_, names_[object]);
  put(R"(:{{"type":"{}")", type);
  append_family(object);
  std::string attributes;
  append_attributes(attributes, on_objects_, object, true);
  if (!attributes.empty()) put(R"(,"attributes":{{{}}})", attributes);
  if (!surfaces.empty()) append_geometry(surfaces, type);
  out_ += '}';
}

std::string CityJsonWriter::write() {
  name_objects();
  append_header();
  std::vector<std::vector<std::size_t>> of_object(scene_.objects.size());
  for (std::size_t s = 0; s < scene_.surfaces.size(); ++s) {
    of_object[scene_.surfaces.object[s]].push_back(s);
  }
  out_ += R"("CityObjects":{)";
  bool is_first = true;
  for (std::size_t o = 0; o < scene_.objects.size(); ++o) {
    // A name without anything under it is worth nothing, unless others hang on it.
    if (of_object[o].empty() && parts_[o].empty()) continue;
    out_ += is_first ? "\n" : ",\n";
    is_first = false;
    append_object(o, of_object[o]);
  }
  out_ += "\n},\n\"vertices\":[";
  for (std::size_t v = 0; v < scene_.vertices.size(); ++v) {
    const Vertex p = rounded(scene_.vertices[v]);
    put("{}[{},{},{}]", v == 0 ? "" : ",", p[0], p[1], p[2]);
  }
  out_ += "]}\n";
  return std::move(out_);
}

}  // namespace

std::string cityjson_of(const Scene& scene, std::span<const CityJsonAttribute> surface_attributes,
                        std::span<const CityJsonAttribute> object_attributes) {
  return CityJsonWriter(scene, surface_attributes, object_attributes).write();
}

}  // namespace tenku
