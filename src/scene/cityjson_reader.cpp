#include "scene/cityjson_reader.h"

#include <simdjson.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/error.h"
#include "scene/cityjson_geometry.h"

namespace tenku {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

constexpr double kNoLod = -1.0;

struct Template {
  element geometry;
  std::string_view type;
  LodLabel lod;
};

/// One geometry of an object, or the template that it places.
struct GeometryChoice {
  element geometry;
  const Template* placed = nullptr;
  std::string_view type;
  LodLabel lod;
};

class CityJsonReader {
 public:
  CityJsonReader(std::string name, const std::string& wanted_lod)
      : name_(std::move(name)), wanted_lod_(wanted_lod) {}

  /// Where messages say they are, from now on.
  void set_place(const std::string& name) { name_ = name; }

  void read_header(element document, const std::string& format);
  void read_objects(element document);
  RawScene take();

 private:
  CityJsonPlace nowhere() const { return {name_, {}}; }
  void read_transform(element document);
  void read_templates(element document);
  void read_vertices(element document);
  Vec3 read_point(element point, const CityJsonPlace& place) const;

  void add_objects(object city_objects);
  void link_parents(object city_objects);
  void read_object_geometry(element city_object, std::uint32_t index);
  std::vector<GeometryChoice> geometries_of(element city_object, const CityJsonPlace& place);
  GeometryChoice choice_of(element geometry, const CityJsonPlace& place);
  double highest_lod(element city_object);
  const LodLabel* chosen_lod(const std::vector<GeometryChoice>& all, std::uint32_t object_index);
  void append(const GeometryChoice& choice, const CityJsonPlace& place, std::uint32_t index);
  void append_placed(const GeometryChoice& choice, const CityJsonPlace& place, SurfaceFacts facts);
  std::uint8_t lod_index(const std::string& label);

  std::string name_;
  const std::string& wanted_lod_;
  RawScene raw_;
  Vec3 scale_{1, 1, 1}, translate_{};
  std::vector<Vec3> template_vertices_;
  std::vector<Template> templates_;
  std::size_t first_vertex_ = 0, vertices_ = 0;  ///< of the document or feature being read
  std::unordered_map<std::string, std::uint32_t> object_index_;
  std::vector<double> part_lod_;  ///< [object], highest LOD among its parts
};

std::string version_of(element document, RawScene& raw) {
  std::string_view version;
  if (document["version"].get(version) != simdjson::SUCCESS) version = "of unknown version";
  for (const char* known : {"1.0", "1.1", "2.0"}) {
    if (version.starts_with(known)) return known;
  }
  raw.findings.add({"cityjson_version", Severity::Warning, "", "",
                    "the file is CityJSON " + std::string(version) + ", not 1.0, 1.1 or 2.0",
                    "read as 2.0"});
  return std::string(version);
}

void CityJsonReader::read_header(element document, const std::string& format) {
  std::string_view type;
  if (document["type"].get(type) != simdjson::SUCCESS || type != "CityJSON") {
    refuse(nowhere(), type == "CityJSONFeature"
                          ? "a CityJSONFeature needs the CityJSON header line before it"
                          : "this is not CityJSON: the member \"type\" is not \"CityJSON\"");
  }
  raw_.scene.format = format + " " + version_of(document, raw_);
  read_transform(document);
  raw_.crs = crs_of_cityjson(document);
  read_templates(document);
}

void CityJsonReader::read_transform(element document) {
  element transform;
  if (document["transform"].get(transform) != simdjson::SUCCESS) return;
  element scale, translate;
  if (transform["scale"].get(scale) != simdjson::SUCCESS ||
      transform["translate"].get(translate) != simdjson::SUCCESS) {
    refuse(nowhere(), "'transform' needs 'scale' and 'translate'");
  }
  scale_ = read_point(scale, {name_, {}});
  translate_ = read_point(translate, {name_, {}});
  if (scale_.x == 0.0 || scale_.y == 0.0 || scale_.z == 0.0) {
    refuse(nowhere(), "'scale' of 'transform' has a zero");
  }
}

Vec3 CityJsonReader::read_point(element point, const CityJsonPlace& place) const {
  array items;
  std::array<double, 3> xyz{};
  if (point.get(items) != simdjson::SUCCESS || items.size() != 3) {
    refuse(place, "a point is not three numbers: " + simdjson::minify(point).substr(0, 60));
  }
  std::size_t k = 0;
  for (const element item : items) {
    if (item.get(xyz[k]) != simdjson::SUCCESS || !std::isfinite(xyz[k])) {
      refuse(place, "a coordinate is not a number: " + simdjson::minify(item).substr(0, 40));
    }
    ++k;
  }
  return {xyz[0], xyz[1], xyz[2]};
}

void CityJsonReader::read_templates(element document) {
  element holder;
  if (document["geometry-templates"].get(holder) != simdjson::SUCCESS) return;
  array points, geometries;
  if (holder["vertices-templates"].get(points) != simdjson::SUCCESS ||
      holder["templates"].get(geometries) != simdjson::SUCCESS) {
    refuse(nowhere(), "'geometry-templates' needs 'templates' and 'vertices-templates'");
  }
  for (const element point : points) template_vertices_.push_back(read_point(point, nowhere()));
  for (const element geometry : geometries) {
    std::string_view type;
    if (geometry["type"].get(type) != simdjson::SUCCESS) type = "";
    templates_.push_back({geometry, type, lod_of(geometry)});
  }
}

void CityJsonReader::read_vertices(element document) {
  array points;
  auto& vertices = raw_.scene.vertices;
  first_vertex_ = vertices.size();
  vertices_ = 0;
  if (document["vertices"].get(points) != simdjson::SUCCESS) {
    refuse(nowhere(), "there is no list 'vertices'");
  }
  for (const element point : points) {
    const Vec3 p = read_point(point, nowhere());
    vertices.push_back({p.x * scale_.x + translate_.x, p.y * scale_.y + translate_.y,
                        p.z * scale_.z + translate_.z});
    if (!is_finite(vertices.back())) refuse(nowhere(), "a coordinate is too large");
  }
  vertices_ = vertices.size() - first_vertex_;
}

void CityJsonReader::read_objects(element document) {
  read_vertices(document);
  object city_objects;
  if (document["CityObjects"].get(city_objects) != simdjson::SUCCESS) {
    refuse(nowhere(), "there is no object 'CityObjects'");
  }
  add_objects(city_objects);
  link_parents(city_objects);
  for (const auto& [id, city_object] : city_objects) {
    read_object_geometry(city_object, object_index_.at(std::string(id)));
  }
}

void CityJsonReader::add_objects(object city_objects) {
  for (const auto& [id, city_object] : city_objects) {
    const CityJsonPlace place{name_, id};
    std::string_view type;
    if (city_object.type() != simdjson::dom::element_type::OBJECT)
      refuse(place, "is not an object");
    if (city_object["type"].get(type) != simdjson::SUCCESS) refuse(place, "has no \"type\"");
    const auto index = static_cast<std::uint32_t>(raw_.scene.objects.size());
    if (!object_index_.try_emplace(std::string(id), index).second) {
      raw_.findings.add({"duplicate_id", Severity::Warning, std::string(id), "",
                         "the object id occurs more than once", "all of them are kept"});
      object_index_[std::string(id)] = index;
    }
    const CityObjectKind kind = city_object_kind(type);
    if (!kind.is_known && !type.starts_with("+")) {
      raw_.findings.add({"unknown_object_type", Severity::Note, std::string(id), "",
                         "the object type '" + std::string(type) + "' is not one of CityJSON",
                         "read as an object without surface types"});
    }
    raw_.scene.objects.push_back({std::string(id), std::string(type)});
    raw_.is_building.push_back(kind.is_building ? 1 : 0);
    part_lod_.push_back(kNoLod);
  }
}

void CityJsonReader::link_parents(object city_objects) {
  for (const auto& [id, city_object] : city_objects) {
    array parents;
    std::string_view parent_id;
    if (city_object["parents"].get(parents) != simdjson::SUCCESS || parents.size() == 0 ||
        parents.at(0).get(parent_id) != simdjson::SUCCESS) {
      continue;
    }
    const auto parent = object_index_.find(std::string(parent_id));
    if (parent == object_index_.end()) {
      raw_.findings.add({"missing_parent", Severity::Warning, std::string(id), "",
                         "the parent '" + std::string(parent_id) + "' is not in the file",
                         "read as an object without a parent"});
      continue;
    }
    SceneObject& child = raw_.scene.objects[object_index_.at(std::string(id))];
    child.parent = parent->second;
    if (!child.type.ends_with("Part")) continue;
    double& highest = part_lod_[parent->second];
    highest = std::max(highest, highest_lod(city_object));
  }
}

double CityJsonReader::highest_lod(element city_object) {
  array geometries;
  double highest = kNoLod;
  if (city_object["geometry"].get(geometries) != simdjson::SUCCESS) return highest;
  for (const element geometry : geometries) highest = std::max(highest, lod_of(geometry).value);
  return highest;
}

GeometryChoice CityJsonReader::choice_of(element geometry, const CityJsonPlace& place) {
  GeometryChoice choice;
  choice.geometry = geometry;
  choice.lod = lod_of(geometry);
  if (geometry["type"].get(choice.type) != simdjson::SUCCESS) {
    refuse(place, "a geometry has no \"type\"");
  }
  if (choice.type != "GeometryInstance") return choice;
  std::uint64_t index = 0;
  if (geometry["template"].get(index) != simdjson::SUCCESS || index >= templates_.size()) {
    refuse(place, "a geometry instance does not name one of the " +
                      std::to_string(templates_.size()) + " templates");
  }
  choice.placed = &templates_[index];
  choice.type = choice.placed->type;
  choice.lod = choice.placed->lod;
  return choice;
}

std::vector<GeometryChoice> CityJsonReader::geometries_of(element city_object,
                                                          const CityJsonPlace& place) {
  std::vector<GeometryChoice> choices;
  element list;
  if (city_object["geometry"].get(list) != simdjson::SUCCESS || list.is_null()) return choices;
  array geometries;
  if (list.get(geometries) != simdjson::SUCCESS) refuse(place, "'geometry' should be a list");
  for (const element geometry : geometries) {
    const GeometryChoice choice = choice_of(geometry, place);
    if (surface_depth(choice.type) >= 0) {
      choices.push_back(choice);
    } else if (choice.type == "MultiPoint" || choice.type == "MultiLineString") {
      raw_.findings.add({"not_a_surface", Severity::Note, std::string(place.object), "",
                         "points and lines neither cast nor receive light", "left out"});
    } else {
      refuse(place, "unknown geometry type '" + std::string(choice.type) + "'");
    }
  }
  return choices;
}

// A number without a fraction asks for the whole family: 1 finds 1.2 and 1.3, the highest of them.
bool is_of_family(const LodLabel& lod, const std::string& wanted) {
  return lod.text == wanted ||
         (wanted.find('.') == std::string::npos && lod.text.starts_with(wanted + "."));
}

const LodLabel* CityJsonReader::chosen_lod(const std::vector<GeometryChoice>& all,
                                           std::uint32_t object_index) {
  const LodLabel *highest = nullptr, *of_family = nullptr;
  for (const GeometryChoice& choice : all) {
    if (highest == nullptr || choice.lod.value > highest->value) highest = &choice.lod;
    if (!wanted_lod_.empty() && is_of_family(choice.lod, wanted_lod_) &&
        (of_family == nullptr || choice.lod.value > of_family->value)) {
      of_family = &choice.lod;
    }
  }
  if (of_family != nullptr || highest == nullptr) return of_family;
  if (wanted_lod_.empty() || raw_.is_building[object_index] == 0) return highest;
  if (part_lod_[object_index] == kNoLod) {
    raw_.findings.add({"missing_lod", Severity::Warning, raw_.scene.objects[object_index].id, "",
                       "the object has no LOD " + wanted_lod_,
                       "its LOD " + highest->text + " is used"});
  }
  return highest;
}

void CityJsonReader::read_object_geometry(element city_object, std::uint32_t index) {
  const std::string& id = raw_.scene.objects[index].id;
  const CityJsonPlace place{name_, id};
  const std::vector<GeometryChoice> all = geometries_of(city_object, place);
  for (const GeometryChoice& choice : all) {
    element boundaries;
    const element& source = choice.placed != nullptr ? choice.placed->geometry : choice.geometry;
    if (source["boundaries"].get(boundaries) != simdjson::SUCCESS) continue;
    raw_.scene.lod_triangles[choice.lod.text] +=
        count_triangles(boundaries, surface_depth(choice.type));
  }
  const LodLabel* chosen = chosen_lod(all, index);
  // A footprint or block whose parts are given in more detail would only double them.
  if (chosen == nullptr || (wanted_lod_.empty() && part_lod_[index] > chosen->value) ||
      (chosen->value < 1.0 && part_lod_[index] >= 1.0)) {
    return;
  }
  for (const GeometryChoice& choice : all) {
    if (choice.lod.text == chosen->text) append(choice, place, index);
  }
}

std::uint8_t CityJsonReader::lod_index(const std::string& label) {
  auto& lods = raw_.scene.lods;
  const auto at = std::find(lods.begin(), lods.end(), label);
  if (at != lods.end()) return static_cast<std::uint8_t>(at - lods.begin());
  if (lods.size() == 255) refuse(nowhere(), "there are more than 255 levels of detail");
  lods.push_back(label);
  return static_cast<std::uint8_t>(lods.size() - 1);
}

void CityJsonReader::append(const GeometryChoice& choice, const CityJsonPlace& place,
                            std::uint32_t index) {
  const CityObjectKind kind = city_object_kind(raw_.scene.objects[index].type);
  raw_.scene.has_terrain |= kind.is_terrain;
  raw_.scene.is_city |= kind.is_building;
  SurfaceFacts facts;
  facts.type = kind.type;
  facts.object = index;
  facts.lod = lod_index(choice.lod.text);
  if (kind.is_building && choice.lod.value >= 0.0 && choice.lod.value < 1.0) {
    facts.type = SurfaceType::Ground;
    raw_.findings.add({"footprint_only", Severity::Warning, std::string(place.object), "",
                       "the building has only a footprint (LOD 0)", "read as flat ground"});
  }
  if (choice.placed != nullptr) return append_placed(choice, place, facts);
  GeometryAppender appender(raw_, place, facts, [&](std::uint64_t v) {
    if (v >= vertices_) {
      refuse(place, "vertex index " + std::to_string(v) + " is out of range: there are " +
                        std::to_string(vertices_) + " vertices");
    }
    return static_cast<std::uint32_t>(first_vertex_ + v);
  });
  appender.append(choice.geometry, choice.type);
}

/// Row-major 4 x 4 matrix of an instance; the identity if it has none.
std::array<double, 16> matrix_of(element instance, const CityJsonPlace& place) {
  std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  array items;
  if (instance["transformationMatrix"].get(items) != simdjson::SUCCESS) return m;
  if (items.size() != 16) refuse(place, "a transformation matrix needs 16 numbers");
  std::size_t k = 0;
  for (const element item : items) {
    if (item.get(m[k++]) != simdjson::SUCCESS) refuse(place, "a matrix holds what is no number");
  }
  return m;
}

Vec3 transformed(const std::array<double, 16>& m, Vec3 p) {
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}

void CityJsonReader::append_placed(const GeometryChoice& choice, const CityJsonPlace& place,
                                   SurfaceFacts facts) {
  array anchor;
  std::uint64_t at = 0;
  if (choice.geometry["boundaries"].get(anchor) != simdjson::SUCCESS || anchor.size() != 1 ||
      anchor.at(0).get(at) != simdjson::SUCCESS || at >= vertices_) {
    refuse(place, "a geometry instance needs one vertex index as its 'boundaries'");
  }
  const Vec3 reference = raw_.scene.vertices[first_vertex_ + at];
  const std::array<double, 16> matrix = matrix_of(choice.geometry, place);
  std::unordered_map<std::uint64_t, std::uint32_t> placed;
  GeometryAppender appender(raw_, place, facts, [&](std::uint64_t v) {
    if (v >= template_vertices_.size()) {
      refuse(place, "template vertex index " + std::to_string(v) + " is out of range: there are " +
                        std::to_string(template_vertices_.size()));
    }
    const auto next = static_cast<std::uint32_t>(raw_.scene.vertices.size());
    const auto [where, is_new] = placed.try_emplace(v, next);
    if (is_new) {
      const Vec3 p = reference + transformed(matrix, template_vertices_[v]);
      if (!is_finite(p)) refuse(place, "a template is placed at infinity");
      raw_.scene.vertices.push_back(p);
    }
    return where->second;
  });
  appender.append(choice.placed->geometry, choice.type);
}

RawScene CityJsonReader::take() { return std::move(raw_); }

/// Parser and the text that its elements point into.
element parse_or_refuse(simdjson::dom::parser& parser, std::string_view text,
                        const std::string& place) {
  element document;
  const auto error = parser.parse(text.data(), text.size(), false).get(document);
  if (error != simdjson::SUCCESS) {
    throw InputError(place + ": cut off, or not JSON: " + simdjson::error_message(error));
  }
  return document;
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// A CityJSONSeq: a document in the first line, features in the others.
bool is_sequence(std::string_view text) {
  const auto end = text.find('\n');
  if (end == std::string_view::npos || is_blank(text.substr(end))) return false;
  simdjson::dom::parser parser;
  element header;
  std::string_view type;
  const std::string line(text.substr(0, end));
  return parser.parse(line).get(header) == simdjson::SUCCESS &&
         header["type"].get(type) == simdjson::SUCCESS;
}

RawScene read_sequence(std::string_view text, const std::string& name,
                       const std::string& building_lod, Progress& progress) {
  CityJsonReader reader(name, building_lod);
  simdjson::dom::parser header_parser, parser;
  std::size_t line_number = 0;
  while (!text.empty()) {
    progress.stop_if_cancelled();
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string place = name + ", line " + std::to_string(++line_number);
    reader.set_place(place);
    if (is_blank(line)) continue;
    if (line_number == 1) {
      // The header's templates are used to the end, so it has a parser of its own.
      const element header = parse_or_refuse(header_parser, line, place);
      reader.read_header(header, "CityJSONSeq");
      continue;
    }
    const element feature = parse_or_refuse(parser, line, place);
    std::string_view type;
    if (feature["type"].get(type) != simdjson::SUCCESS || type != "CityJSONFeature") {
      throw InputError(place + ": this is not a CityJSONFeature");
    }
    reader.read_objects(feature);
  }
  return reader.take();
}

}  // namespace

RawScene read_cityjson(std::string bytes, const std::string& name, const std::string& building_lod,
                       Progress& progress) {
  const std::string_view mark = "\xEF\xBB\xBF";
  if (bytes.starts_with(mark)) bytes.erase(0, mark.size());
  bytes.reserve(bytes.size() + simdjson::SIMDJSON_PADDING);
  if (is_sequence(bytes)) return read_sequence(bytes, name, building_lod, progress);
  simdjson::dom::parser parser;
  const element document = parse_or_refuse(parser, bytes, name);
  progress.stop_if_cancelled();
  CityJsonReader reader(name, building_lod);
  reader.read_header(document, "CityJSON");
  reader.read_objects(document);
  return reader.take();
}

}  // namespace tenku
