#include "scene/obj_reader.h"

#include <string>
#include <unordered_map>

#include "core/error.h"
#include "scene/input_file.h"
#include "scene/obj_header.h"
#include "scene/text_cursor.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

class ObjReader {
 public:
  explicit ObjReader(const fs::path& path) : path_(path), file_(path.string()), cursor_("", file_) {
    raw_.scene.format = "OBJ";
    raw_.is_mesh = true;
    raw_.scene.lods = {""};
  }

  RawScene read(Progress& progress);

 private:
  void read_statement();
  void read_comment();
  void read_vertex();
  void read_face();
  std::uint32_t vertex_index(std::string_view word);
  void read_libraries();
  bool read_library(const fs::path& file);
  void use_material(std::string_view name);
  void choose_object();
  std::uint32_t object_named(const std::string& id, const std::string& group, std::uint32_t parent);

  fs::path path_;
  std::string file_;
  TextCursor cursor_;
  RawScene raw_;
  std::string object_name_, group_name_;
  bool object_is_chosen_ = false;
  SurfaceFacts facts_;
  SurfaceType material_type_ = SurfaceType::Unknown;
  std::unordered_map<std::string, std::uint32_t> objects_, materials_;
};

RawScene ObjReader::read(Progress& progress) {
  InputLines lines(path_);
  for (std::string block = lines.next(); !block.empty(); block = lines.next()) {
    progress.stop_if_cancelled();
    cursor_.go_on(block);
    for (; !cursor_.at_end(); cursor_.next_line()) read_statement();
  }
  raw_.scene.lod_triangles.clear();
  return std::move(raw_);
}

void ObjReader::read_statement() {
  const std::string_view keyword = cursor_.word();
  if (keyword == "v") return read_vertex();
  if (keyword == "f" || keyword == "fo") return read_face();
  if (keyword.empty() || keyword == "vt" || keyword == "vn" || keyword == "s") return;
  if (keyword.starts_with('#')) return read_comment();
  if (keyword == "o") {
    object_name_ = cursor_.rest();
    object_is_chosen_ = false;
  } else if (keyword == "g") {
    group_name_ = cursor_.rest();
    object_is_chosen_ = false;
  } else if (keyword == "usemtl") {
    use_material(cursor_.rest());
  } else if (keyword == "mtllib") {
    read_libraries();
  } else {
    raw_.findings.add({"ignored_statement", Severity::Note, "", file_,
                       quoted(keyword) + " and the like are ignored", "only polygons are read"});
  }
}

void ObjReader::read_comment() {
  constexpr std::size_t kHeaderLines = 100;
  if (!raw_.scene.vertices.empty() || cursor_.line() > kHeaderLines) return;
  read_obj_comment(cursor_.rest(), raw_);
}

void ObjReader::read_vertex() {
  const double x = cursor_.number(), y = cursor_.number(), z = cursor_.number();
  raw_.scene.vertices.push_back({x, y, z});
  if (raw_.scene.vertices.size() >= kNone) cursor_.refuse("more than 4 billion vertices");
}

std::uint32_t ObjReader::vertex_index(std::string_view word) {
  const auto count = static_cast<long long>(raw_.scene.vertices.size());
  std::string_view left = word;
  const auto index = leading_integer(left);
  if (!index || (!left.empty() && left[0] != '/')) {
    cursor_.refuse(quoted(word) + " is not a vertex of a face");
  }
  const long long at = *index < 0 ? count + *index : *index - 1;
  if (at < 0 || at >= count) {
    cursor_.refuse("vertex index " + std::to_string(*index) + " is out of range: there are " +
                   std::to_string(count) + " vertices so far");
  }
  return static_cast<std::uint32_t>(at);
}

void ObjReader::read_face() {
  if (!object_is_chosen_) choose_object();
  Surfaces& surfaces = raw_.scene.surfaces;
  const std::size_t first = surfaces.vertex.size();
  while (!cursor_.line_is_done()) {
    const std::string_view word = cursor_.word();
    if (word.starts_with('#')) break;
    surfaces.vertex.push_back(vertex_index(word));
  }
  if (surfaces.vertex.size() == first) cursor_.refuse("a face without vertices");
  end_ring(surfaces);
  end_surface(surfaces, facts_);
}

std::uint32_t ObjReader::object_named(const std::string& id, const std::string& group,
                                      std::uint32_t parent) {
  const auto next = static_cast<std::uint32_t>(raw_.scene.objects.size());
  const auto [at, is_new] = objects_.try_emplace(id, next);
  if (is_new) {
    raw_.scene.objects.push_back({id, "", parent, group});
    raw_.is_building.push_back(0);
  }
  return at->second;
}

void ObjReader::choose_object() {
  if (group_name_.empty()) {
    facts_.object = object_named(object_name_.empty() ? "default" : object_name_, "", kNone);
  } else if (object_name_.empty()) {
    facts_.object = object_named(group_name_, group_name_, kNone);
  } else {
    const std::uint32_t parent = object_named(object_name_, "", kNone);
    facts_.object = object_named(object_name_ + "/" + group_name_, group_name_, parent);
  }
  facts_.type = material_type_;
  if (facts_.type == SurfaceType::Unknown) facts_.type = type_by_name(group_name_);
  if (facts_.type == SurfaceType::Unknown) facts_.type = type_by_name(object_name_);
  raw_.scene.has_terrain |= facts_.type == SurfaceType::Ground || facts_.type == SurfaceType::Road;
  object_is_chosen_ = true;
}

void ObjReader::use_material(std::string_view name) {
  object_is_chosen_ = false;  // the type may come from the material's name
  const std::string key(name);
  material_type_ = type_by_name(name);
  const auto known = materials_.find(key);
  if (known != materials_.end()) {
    facts_.material = known->second;
    return;
  }
  // Not seen before: the last definition in the MTL files, or a name of its own.
  std::size_t at = raw_.file_materials.size();
  while (at > 0 && raw_.file_materials[at - 1].material.name != key) --at;
  if (at == 0) {
    Material material;
    material.name = key;
    raw_.file_materials.push_back({material, false});
    at = raw_.file_materials.size();
  }
  facts_.material = static_cast<std::uint32_t>(at - 1);
  materials_.emplace(key, facts_.material);
}

bool ObjReader::read_library(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) == 0) return false;
  read_mtl(read_input_file(file), file.string(), raw_);
  return true;
}

void ObjReader::read_libraries() {
  const std::string all(cursor_.rest());
  if (all.empty()) return;
  const fs::path folder = path_.parent_path();
  if (read_library(folder / all)) return;
  TextCursor names(all, file_);
  while (!names.line_is_done()) {
    const std::string name(names.word());
    if (read_library(folder / name)) continue;
    raw_.findings.add({"missing_mtl", Severity::Warning, "",
                       file_ + ", line " + std::to_string(cursor_.line()),
                       "the material file '" + name + "' is not there",
                       "materials by the type of the surfaces, or by --materials"});
  }
}

}  // namespace

RawScene read_obj(const fs::path& path, Progress& progress) {
  return ObjReader(path).read(progress);
}

}  // namespace tenku
