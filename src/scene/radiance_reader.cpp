#include "scene/radiance_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <unordered_map>

#include "core/error.h"
#include "scene/input_file.h"
#include "scene/obj_reader.h"
#include "scene/text_cursor.h"

namespace tenku {
namespace {

/// `modifier type identifier` and its arguments.
struct Primitive {
  std::string modifier, type, id;
  std::vector<double> numbers;
};

constexpr std::array<std::string_view, 10> kOtherShapes{
    "ring", "sphere", "bubble", "cone", "cup", "cylinder", "tube", "source", "instance", "mesh"};

using Ring = std::vector<Vec3>;

/// The rings of a polygon, the largest first. Radiance has no holes: an outline goes in to a hole
/// and out by the same seam, and so meets corners that it has met before.
std::vector<Ring> rings_of(const std::vector<double>& numbers) {
  std::vector<Ring> rings;
  Ring open;
  std::map<std::array<double, 3>, std::size_t> met;  // where in `open` a corner is
  const auto key = [](Vec3 p) { return std::array{p.x, p.y, p.z}; };
  const auto close_from = [&](std::size_t begin) {
    const auto first = open.begin() + static_cast<std::ptrdiff_t>(begin);
    if (open.size() >= begin + 3) rings.emplace_back(first, open.end());
    std::for_each(first, open.end(), [&](Vec3 corner) { met.erase(key(corner)); });
    open.erase(first, open.end());
  };
  for (std::size_t k = 0; k < numbers.size(); k += 3) {
    const Vec3 corner{numbers[k], numbers[k + 1], numbers[k + 2]};
    const auto before = met.find(key(corner));
    if (before != met.end()) close_from(before->second);
    met[key(corner)] = open.size();
    open.push_back(corner);
  }
  close_from(0);
  const auto area = [](const Ring& ring) {
    Vec3 sum{};
    for (std::size_t k = 0; k < ring.size(); ++k) {
      sum = sum + cross(ring[k] - ring[0], ring[(k + 1) % ring.size()] - ring[0]);
    }
    return dot(sum, sum);
  };
  std::stable_sort(rings.begin(), rings.end(),
                   [&](const Ring& a, const Ring& b) { return area(a) > area(b); });
  if (rings.empty()) rings.emplace_back();
  return rings;
}

void add_rings(Scene& scene, const std::vector<Ring>& rings) {
  for (const Ring& ring : rings) {
    for (const Vec3 corner : ring) {
      scene.surfaces.vertex.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
      scene.vertices.push_back(corner);
    }
    end_ring(scene.surfaces);
  }
}

class RadianceReader {
 public:
  RadianceReader(const std::string& bytes, const std::string& file)
      : file_(file), cursor_(bytes, file_) {}

  RawScene read(Progress& progress);

 private:
  bool find_word();
  void pass_command();
  void pass_text();
  std::string word();
  std::size_t count();
  void read_primitive();
  void read_alias(const std::string& id);
  void read_arguments(Primitive& primitive);
  void add_material(const Primitive& primitive);
  void add_polygon(const Primitive& primitive);
  void tell(Severity severity, const char* code, const std::string& what, const char* repair);

  std::string file_;
  TextCursor cursor_;
  RawScene raw_;
  ObjectsByName objects_;
  std::unordered_map<std::string, std::uint32_t> materials_;
};

void RadianceReader::tell(Severity severity, const char* code, const std::string& what,
                          const char* repair) {
  raw_.findings.add(
      {code, severity, "", file_ + ", line " + std::to_string(cursor_.line()), what, repair});
}

/// Goes to the last line of a command, which a backslash continues.
void RadianceReader::pass_command() {
  while (cursor_.rest().ends_with('\\') && !cursor_.at_end()) cursor_.next_line();
}

/// Passes over a text argument, which may be several words in quotation marks.
void RadianceReader::pass_text() {
  const std::string first = word();
  const char mark = first[0];
  if (mark != '"' && mark != '\'') return;
  for (std::string last = first.substr(1); !last.ends_with(mark);) last = word();
}

/// Goes to the next word that is no comment and no command.
bool RadianceReader::find_word() {
  for (;; cursor_.next_line()) {
    if (cursor_.at_end()) return false;
    if (cursor_.line_is_done()) continue;
    const std::string_view rest = TextCursor(cursor_).rest();
    if (rest.starts_with('#')) continue;
    if (!rest.starts_with('!')) return true;
    tell(Severity::Warning, "ignored_command", "a command makes part of the scene",
         "not run: give the file that 'xform' makes of it");
    pass_command();
  }
}

std::string RadianceReader::word() {
  if (!find_word()) cursor_.refuse("cut off");
  return std::string(cursor_.word());
}

std::size_t RadianceReader::count() {
  const std::string text = word();
  std::string_view left = text;
  const auto number = leading_integer(left);
  if (!number || !left.empty() || *number < 0) {
    cursor_.refuse("a number of arguments should stand here, not " + tenku::quoted(text));
  }
  return static_cast<std::size_t>(*number);
}

void RadianceReader::read_arguments(Primitive& primitive) {
  for (std::size_t left = count(); left > 0; --left) pass_text();
  for (std::size_t left = count(); left > 0; --left) word();
  for (std::size_t left = count(); left > 0; --left) {
    if (!find_word()) cursor_.refuse("cut off");
    primitive.numbers.push_back(cursor_.number());
  }
}

void RadianceReader::read_alias(const std::string& id) {
  const auto known = materials_.find(word());
  if (known != materials_.end()) {
    materials_[id] = known->second;
  } else {
    materials_.erase(id);
  }
}

void RadianceReader::add_material(const Primitive& primitive) {
  try {
    std::optional<Material> material = radiance_material(primitive.type, primitive.numbers);
    if (!material) {
      tell(Severity::Note, "unknown_material",
           "'" + primitive.type + "' has no counterpart here, nor have patterns and textures",
           "surfaces take the material of their type; --materials can say better");
    } else if (material->emission_lm_m2.r + material->emission_lm_m2.g +
                   material->emission_lm_m2.b >
               0.0) {
      tell(Severity::Note, "two_sided_lamp", "lamps shine to the front alone in Radiance",
           "they shine to both sides here");
    }
    RawScene::FileMaterial entry{material.value_or(Material{}), material.has_value()};
    entry.material.name = primitive.id;
    materials_[primitive.id] = static_cast<std::uint32_t>(raw_.file_materials.size());
    raw_.file_materials.push_back(entry);
  } catch (const InputError& error) {
    cursor_.refuse("'" + primitive.id + "': " + error.what());
  }
}

void RadianceReader::add_polygon(const Primitive& primitive) {
  if (primitive.numbers.size() % 3 != 0 || primitive.numbers.size() < 9) {
    cursor_.refuse("polygon '" + primitive.id + "' has " +
                   std::to_string(primitive.numbers.size()) +
                   " numbers, which are not three points or more");
  }
  add_rings(raw_.scene, rings_of(primitive.numbers));
  SurfaceFacts facts;
  facts.object = objects_.find_or_add(raw_, primitive.id);
  facts.type = type_by_name(primitive.modifier);
  if (facts.type == SurfaceType::Unknown) facts.type = type_by_name(primitive.id);
  const auto material = materials_.find(primitive.modifier);
  if (material != materials_.end()) {
    facts.material = material->second;
  } else if (primitive.modifier != "void") {
    // Files of polygons are often kept apart from their materials.
    facts.material = static_cast<std::uint32_t>(raw_.file_materials.size());
    materials_[primitive.modifier] = facts.material;
    RawScene::FileMaterial named;
    named.material.name = primitive.modifier;
    raw_.file_materials.push_back(named);
  }
  end_surface(raw_.scene.surfaces, facts);
}

void RadianceReader::read_primitive() {
  Primitive primitive;
  primitive.modifier = word();
  primitive.type = word();
  primitive.id = word();
  if (primitive.type == "alias") return read_alias(primitive.id);
  read_arguments(primitive);
  if (primitive.type == "polygon") {
    add_polygon(primitive);
  } else if (std::find(kOtherShapes.begin(), kOtherShapes.end(), primitive.type) !=
             kOtherShapes.end()) {
    tell(Severity::Warning, "ignored_shape", "shapes of type '" + primitive.type + "' are not read",
         "only polygons are read");
  } else {
    add_material(primitive);
  }
}

RawScene RadianceReader::read(Progress& progress) {
  raw_.scene.format = "Radiance";
  raw_.is_mesh = true;
  raw_.shares_vertices = false;
  raw_.scene.lods = {""};
  while (find_word()) {
    progress.stop_if_cancelled();
    read_primitive();
  }
  return std::move(raw_);
}

}  // namespace

RawScene read_radiance(const std::filesystem::path& path, Progress& progress) {
  const std::string bytes = read_input_file(path);
  return RadianceReader(bytes, path.string()).read(progress);
}

}  // namespace tenku
