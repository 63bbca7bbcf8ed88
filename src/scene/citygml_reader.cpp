#include "scene/citygml_reader.h"

#include <cctype>
#include <functional>
#include <optional>
#include <set>
#include <unordered_map>

#include "core/error.h"
#include "scene/citygml_member.h"
#include "scene/citygml_types.h"
#include "scene/georeference.h"
#include "scene/text_cursor.h"
#include "scene/xml_stream.h"

namespace tenku {
namespace {

constexpr std::array<double, 16> kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
constexpr std::size_t kMostCrsNames = 8;  // other than the first, that are looked up
constexpr const char* kNumberSeparators = " \t\r\n,";

/// What holds inside an element; what is inside it begins with the same.
struct Level {
  GmlPlace place;
  bool is_skipped = false;    ///< nothing inside is of interest
  bool in_geometry = false;   ///< polygons inside are of the object
  bool in_solid = false;      ///< `exterior` and `interior` are shells
  bool in_polygon = false;    ///< rings are of the polygon begun last
  bool reads_points = false;  ///< positions are of a ring, or the place of a template
  bool is_inner = false;      ///< rings are holes
  bool is_logical = false;    ///< a space that is not there to the eye
  bool in_member = false;
  bool is_member = false;  ///< this element holds a city object
  bool reads_text = false;
  bool is_flat = false;  ///< points have two coordinates
  std::size_t first_polygon = 0;
};

class CityGmlReader : public XmlVisitor {
 public:
  explicit CityGmlReader(const std::string& wanted_lod)
      : wanted_lod_(wanted_lod), member_(raw_, wanted_lod_) {}

  void begin_element(std::string_view name, const XmlAttributes& attributes) override;
  void end_element(std::string_view name) override;
  void text(std::string_view piece) override;
  RawScene take();

 private:
  void begin_document(std::string_view name, const XmlAttributes& attributes);
  void note_crs(std::string_view name);
  void begin_property(std::string_view name, const XmlAttributes& attributes);
  void begin_geometry_property(const GeometryProperty& property, bool is_relief);
  void begin_boundary(bool is_inner);
  void begin_type(std::string_view name, const XmlAttributes& attributes);
  void begin_geometry(std::string_view name, const XmlAttributes& attributes);
  void begin_object(std::string_view name, const CityObjectKind& kind);
  void begin_template(const XmlAttributes& attributes);
  void end_property(std::string_view name);
  void name_shape();
  void end_ring();
  void end_template();
  void place_template();
  void end_member();

  std::vector<Vec3> points_in_text() const;
  std::array<double, 16> matrix_in_text() const;
  [[noreturn]] void refuse(const std::string& what) const;
  void tell(Severity severity, const char* code, const std::string& what, const char* repair);
  const std::string& object_id() const;
  bool is_geographic() const;
  GmlMember& target() { return template_ ? *template_ : member_; }
  Level& now() { return levels_.back(); }
  const Level& now() const { return levels_.back(); }

  const std::string& wanted_lod_;
  RawScene raw_;
  GmlMember member_;
  std::vector<Level> levels_;
  std::vector<std::string> ids_;  ///< [level]
  std::string crs_id_;            ///< of `raw_.crs`, once another name has been met
  /// Names other than the first that were looked up. Few: in what is no reference system PROJ looks
  /// for a title, which takes a tenth of a second a name.
  std::set<std::string, std::less<>> other_crs_;
  std::string text_;
  std::vector<Vec3> ring_;
  std::uint32_t first_object_ = 0;  ///< of the member being read
  int relief_lod_ = 0;

  /// An `ImplicitGeometry`: a shape by name, and where it stands.
  std::optional<GmlMember> template_;
  std::unordered_map<std::string, GmlMember> templates_;
  std::string template_id_;
  std::array<double, 16> matrix_ = kIdentity;
  std::optional<Vec3> reference_point_;
};

/// The registered name of a reference system; the text itself if there is none.
std::string crs_id(const std::string& text) {
  try {
    return Crs::parse(text).id;
  } catch (const InputError&) {
    return text;
  }
}

bool is_type_name(std::string_view name) {
  return std::isupper(static_cast<unsigned char>(name[0])) != 0;
}

void CityGmlReader::refuse(const std::string& what) const {
  const std::string& id = object_id();
  throw InputError(id.empty() ? what : "object '" + id + "': " + what);
}

const std::string& CityGmlReader::object_id() const {
  static const std::string kNobody;
  if (levels_.empty() || now().place.object == kNone) return kNobody;
  return raw_.scene.objects[now().place.object].id;
}

void CityGmlReader::tell(Severity severity, const char* code, const std::string& what,
                         const char* repair) {
  raw_.findings.add({code, severity, object_id(), "", what, repair});
}

void CityGmlReader::begin_document(std::string_view name, const XmlAttributes& attributes) {
  if (name != "CityModel") {
    throw InputError("this is not CityGML: the outermost element is " + quoted(name) +
                     ", not a CityModel");
  }
  raw_.scene.format = "CityGML";
  raw_.shares_vertices = false;
  for (const std::string version : {"1.0", "2.0", "3.0"}) {
    if (attributes.value_with("opengis.net/citygml/" + version).empty() &&
        attributes.value_with("citygml.org/citygml/profiles/base/" + version).empty()) {
      continue;
    }
    raw_.scene.format = "CityGML " + version;
  }
}

void CityGmlReader::note_crs(std::string_view name) {
  // Templates have a frame of their own.
  if (name.empty() || raw_.crs == name || template_) return;
  if (raw_.crs.empty()) {
    raw_.crs = name;
    raw_.has_registry_axes = names_registry_axes(name);
    return;
  }
  if (other_crs_.contains(name) || other_crs_.size() == kMostCrsNames) return;
  if (crs_id_.empty()) crs_id_ = crs_id(raw_.crs);
  if (crs_id(*other_crs_.emplace(name).first) == crs_id_) return;
  raw_.findings.add(
      {"mixed_crs", Severity::Error, "", "",
       "coordinates are in " + tenku::quoted(raw_.crs) + " and in " + tenku::quoted(name),
       "all are read as in the first"});
}

void CityGmlReader::begin_element(std::string_view name, const XmlAttributes& attributes) {
  if (levels_.empty()) begin_document(name, attributes);
  Level level = levels_.empty() ? Level{} : now();
  level.is_member = false;
  level.reads_text = false;
  level.first_polygon = target().polygons();
  levels_.push_back(level);
  ids_.emplace_back();
  if (now().is_skipped) return;
  note_crs(attributes("srsName"));
  if (const auto dimension = attributes("srsDimension"); !dimension.empty()) {
    now().is_flat = dimension == "2";
  }
  if (is_type_name(name)) {
    begin_type(name, attributes);
  } else {
    begin_property(name, attributes);
  }
}

void CityGmlReader::begin_property(std::string_view name, const XmlAttributes& attributes) {
  const bool in_object = now().place.object != kNone;
  if (name == "cityObjectMember" || name == "featureMember" || name == "featureMembers") {
    if (in_object || levels_.size() != 2) return;
    now().is_member = now().in_member = true;
    first_object_ = static_cast<std::uint32_t>(raw_.scene.objects.size());
    relief_lod_ = 0;
  } else if (name == "appearance" || name == "appearanceMember") {
    now().is_skipped = true;
  } else if (name == "lod" || name == "transformationMatrix") {
    text_.clear();
    now().reads_text = true;
  } else if (name == "referencePoint") {
    ring_.clear();
    now().reads_points = true;
  } else if (name == "relativeGMLGeometry" || name == "relativeGeometry") {
    begin_template(attributes);
  } else if (name == "pos" || name == "posList" || name == "coordinates") {
    text_.clear();
    now().reads_text = now().reads_points;
  } else if (name == "exterior" || name == "outerBoundaryIs") {
    begin_boundary(false);
  } else if (name == "interior" || name == "innerBoundaryIs") {
    begin_boundary(true);
  } else if (const auto property = geometry_property(name); property && in_object) {
    begin_geometry_property(*property, name == "tin");
  }
  const std::string_view link = attributes("href");
  if (!link.empty() && now().in_geometry && !now().is_skipped && !template_) {
    member_.add_reference(link, now().place);
  }
}

void CityGmlReader::begin_geometry_property(const GeometryProperty& property, bool is_relief) {
  using Kind = GeometryProperty::Kind;
  if (property.kind == Kind::PointsOrLines) {
    tell(Severity::Note, "not_a_surface", "points and lines neither cast nor receive light",
         "left out");
  } else if (now().is_logical && property.kind == Kind::Surfaces) {
    tell(Severity::Note, "logical_space", "a space that is not there to the eye has a shape",
         "left out, but for what bounds it");
  }
  now().is_skipped = property.kind == Kind::PointsOrLines || property.kind == Kind::Auxiliary ||
                     (now().is_logical && property.kind == Kind::Surfaces);
  now().in_geometry = property.kind == Kind::Surfaces;
  now().place.lod = is_relief ? relief_lod_ : property.lod;
  now().place.shell = kNone;
  now().place.is_turned = false;
}

void CityGmlReader::begin_boundary(bool is_inner) {
  if (!now().in_geometry) return;
  if (now().in_solid) {
    now().in_solid = false;
    now().place.shell = target().add_shell(is_inner);
  } else {
    now().is_inner = is_inner;
  }
}

void CityGmlReader::begin_type(std::string_view name, const XmlAttributes& attributes) {
  if (!now().in_member) return;
  ids_.back() = attributes("id");
  if (now().in_geometry) return begin_geometry(name, attributes);
  if (name == "ImplicitGeometry") {
    matrix_ = kIdentity;
    reference_point_.reset();
    template_id_.clear();
    return;
  }
  if (const SemanticKind surface = semantic_kind(name);
      surface.is_known && now().place.object != kNone) {
    now().place.surface = surface;
    now().place.is_surface = true;
    now().is_logical = false;
  } else if (is_logical_space(name)) {
    now().is_logical = true;
  } else if (const auto kind = citygml_object_kind(name)) {
    begin_object(name, *kind);
  } else if (levels_.size() >= 2 && levels_[levels_.size() - 2].is_member &&
             !name.ends_with("ReliefFeature") && name != "Appearance") {
    begin_object(name, {SurfaceType::Unknown, false, false, false});
    tell(Severity::Note, "unknown_object_type",
         "the object type '" + std::string(name.substr(0, 60)) + "' is not one of CityGML",
         "read as an object without surface types");
  }
}

void CityGmlReader::begin_geometry(std::string_view name, const XmlAttributes& attributes) {
  // The first shape of a template bears the name by which others ask for it.
  if (template_ && template_id_.empty()) template_id_ = ids_.back();
  if (name == "Solid") {
    now().in_solid = true;
  } else if (name == "Polygon" || name == "PolygonPatch" || name == "Triangle" ||
             name == "Rectangle") {
    if (now().is_flat) {
      tell(Severity::Warning, "no_heights", "points have two coordinates", "left out");
      now().is_skipped = true;
      return;
    }
    now().in_solid = false;
    now().in_polygon = true;
    now().is_inner = false;
    target().begin_polygon(now().place);
  } else if (name == "OrientableSurface") {
    if (attributes("orientation") == "-") now().place.is_turned = !now().place.is_turned;
  } else if (name == "LinearRing" || name == "Ring") {
    ring_.clear();
    now().reads_points = now().in_polygon;
  }
}

void CityGmlReader::begin_object(std::string_view name, const CityObjectKind& kind) {
  SceneObject object{ids_.back(), std::string(name), now().place.object};
  if (object.id.empty()) {
    object.id = object.type + " " + std::to_string(raw_.scene.objects.size() + 1);
  }
  now().place = GmlPlace{};
  now().place.object = static_cast<std::uint32_t>(raw_.scene.objects.size());
  now().is_logical = false;
  raw_.scene.objects.push_back(std::move(object));
  raw_.is_building.push_back(kind.is_building ? 1 : 0);
}

void CityGmlReader::begin_template(const XmlAttributes& attributes) {
  if (now().in_geometry) refuse("a template stands inside another shape");
  std::string_view link = attributes("href");
  if (link.starts_with('#')) link.remove_prefix(1);
  template_id_ = link;
  if (!link.empty()) return;
  template_.emplace(raw_, wanted_lod_);
  now().in_geometry = true;
}

void CityGmlReader::text(std::string_view piece) {
  if (!levels_.empty() && now().reads_text) text_.append(piece);
}

std::vector<Vec3> CityGmlReader::points_in_text() const {
  std::vector<Vec3> points;
  std::array<double, 3> xyz{};
  std::size_t numbers = 0;
  std::string_view left = text_;
  for (;;) {
    const auto begin = left.find_first_not_of(kNumberSeparators);
    if (begin == std::string_view::npos) break;
    left.remove_prefix(begin);
    const std::string_view word = left.substr(0, left.find_first_of(kNumberSeparators));
    const auto value = finite_number(word);
    if (!value) refuse("a coordinate is not a finite number: " + quoted(word));
    xyz[numbers % 3] = *value;
    if (++numbers % 3 == 0) points.push_back({xyz[0], xyz[1], xyz[2]});
    left.remove_prefix(word.size());
  }
  if (numbers % 3 != 0) {
    refuse("a list of " + std::to_string(numbers) + " numbers is not made of points of three");
  }
  return points;
}

std::array<double, 16> CityGmlReader::matrix_in_text() const {
  std::array<double, 16> matrix{};
  const std::string nowhere;
  TextCursor words(text_, nowhere);
  for (double& entry : matrix) {
    while (words.line_is_done() && !words.at_end()) words.next_line();
    const auto value = finite_number(words.word());
    if (!value) refuse("a transformation matrix is not made of 16 numbers");
    entry = *value;
  }
  return matrix;
}

void CityGmlReader::end_element(std::string_view name) {
  if (!now().is_skipped) {
    if (now().in_geometry) {
      name_shape();
      if (now().in_polygon && (name == "LinearRing" || name == "Ring")) end_ring();
    }
    if (name == "ImplicitGeometry" && now().place.object != kNone) place_template();
    end_property(name);
    if (now().is_member) end_member();
  }
  levels_.pop_back();
  ids_.pop_back();
}

void CityGmlReader::name_shape() {
  const std::string& id = ids_.back();
  if (id.empty() || target().name_polygons(id, now().first_polygon)) return;
  tell(Severity::Warning, "duplicate_id", "the name " + tenku::quoted(id) + " is of several shapes",
       "it means the first of them");
}

void CityGmlReader::end_property(std::string_view name) {
  if (name == "relativeGMLGeometry" || name == "relativeGeometry") return end_template();
  if (name == "referencePoint") {
    if (ring_.size() == 1) reference_point_ = ring_[0];
    return;
  }
  if (!now().reads_text) return;
  if (name == "lod") {
    const auto lod =
        finite_number(std::string_view(text_).substr(0, text_.find_last_not_of(" \n\t\r") + 1));
    if (lod && *lod >= 0.0 && *lod <= 4.0) relief_lod_ = static_cast<int>(*lod);
  } else if (name == "transformationMatrix") {
    matrix_ = matrix_in_text();
  } else {
    const std::vector<Vec3> points = points_in_text();
    ring_.insert(ring_.end(), points.begin(), points.end());
  }
  text_.clear();
}

void CityGmlReader::end_ring() {
  if (ring_.size() > 1 && ring_.front() == ring_.back()) {
    ring_.pop_back();
  } else {
    tell(Severity::Warning, "ring_not_closed", "a ring does not end where it begins", "closed");
  }
  target().add_ring(ring_, now().is_inner);
  ring_.clear();
}

void CityGmlReader::end_template() {
  if (!template_) return;
  if (template_id_.empty()) template_id_ = "#inline";
  templates_.erase(template_id_);
  templates_.emplace(template_id_, std::move(*template_));
  template_.reset();
}

bool CityGmlReader::is_geographic() const {
  if (raw_.crs.empty()) return false;
  try {
    return Crs::parse(raw_.crs).geographic;
  } catch (const InputError&) {
    return false;
  }
}

void CityGmlReader::place_template() {
  const auto found = templates_.find(template_id_);
  if (found == templates_.end() || !reference_point_) {
    return tell(Severity::Warning, "unresolved_template",
                "a shape is named that does not come before it in the file, or has no place",
                "left out");
  }
  if (is_geographic()) {
    return tell(Severity::Warning, "template_in_degrees",
                "a shape in metres stands at a place in degrees", "left out");
  }
  const std::size_t first = member_.polygons();
  member_.add_copies(found->second, now().place);
  member_.transform_polygons(first, matrix_, *reference_point_);
}

void CityGmlReader::end_member() { member_.finish(first_object_); }

RawScene CityGmlReader::take() {
  std::unordered_map<std::string, std::size_t> count;
  for (const SceneObject& object : raw_.scene.objects) {
    if (++count[object.id] != 2) continue;
    raw_.findings.add({"duplicate_id", Severity::Warning, object.id, "",
                       "the object id occurs more than once", "all of them are kept"});
  }
  return std::move(raw_);
}

}  // namespace

RawScene read_citygml(const std::filesystem::path& path, const std::string& building_lod,
                      Progress& progress) {
  CityGmlReader reader(building_lod);
  walk_xml(path, reader, progress);
  return reader.take();
}

}  // namespace tenku
