#include <array>
#include <cmath>
#include <string>
#include <unordered_map>

#include "core/error.h"
#include "scene/byte_cursor.h"
#include "scene/input_file.h"
#include "scene/mesh_readers.h"
#include "scene/obj_reader.h"
#include "scene/text_cursor.h"

namespace tenku {
namespace {

constexpr std::size_t kHeader = 80, kTriangle = 50;

/// Triangles of one scene, by the name of their solid.
class StlScene {
 public:
  StlScene() {
    raw_.scene.format = "STL";
    raw_.is_mesh = true;
    raw_.shares_vertices = false;
    raw_.scene.lods = {""};
  }

  void begin_solid(const std::string& name) {
    const auto next = static_cast<std::uint32_t>(raw_.scene.objects.size());
    const auto [at, is_new] = objects_.try_emplace(name, next);
    if (is_new) {
      raw_.scene.objects.push_back({name, ""});
      raw_.is_building.push_back(0);
    }
    facts_.object = at->second;
    facts_.type = type_by_name(name);
  }

  void add(const std::array<Vec3, 3>& triangle) {
    Scene& scene = raw_.scene;
    for (const Vec3 p : triangle) {
      scene.surfaces.vertex.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
      scene.vertices.push_back(p);
    }
    end_ring(scene.surfaces);
    end_surface(scene.surfaces, facts_);
  }

  RawScene take() { return std::move(raw_); }

 private:
  RawScene raw_;
  SurfaceFacts facts_;
  std::unordered_map<std::string, std::uint32_t> objects_;
};

/// A binary file says in its header how long it is; one of text begins with `solid`, which some
/// binary files do too.
bool is_binary(std::string_view bytes) {
  ByteCursor cursor(bytes);
  if (!cursor.skip(kHeader)) return false;
  const auto count = cursor.next<std::uint32_t>();
  if (count && cursor.left() == kTriangle * std::size_t{*count}) return true;
  const auto first = bytes.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos || !bytes.substr(first).starts_with("solid");
}

RawScene read_binary(std::string_view bytes, const std::string& file, Progress& progress) {
  constexpr std::size_t kOften = 1U << 16U;
  ByteCursor cursor(bytes);
  cursor.skip(kHeader);
  const std::uint32_t count = cursor.next<std::uint32_t>().value_or(0);
  if (cursor.left() < kTriangle * std::size_t{count}) {
    throw InputError(file + " is cut off, or is not STL: " + std::to_string(count) +
                     " triangles are told, there is room for " +
                     std::to_string(cursor.left() / kTriangle));
  }
  StlScene scene;
  scene.begin_solid("default");
  for (std::uint32_t t = 0; t < count; ++t) {
    if (t % kOften == 0) progress.stop_if_cancelled();
    cursor.skip(3 * sizeof(float));  // the normal
    std::array<Vec3, 3> triangle;
    for (Vec3& p : triangle) {
      for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        p.*axis = static_cast<double>(cursor.next<float>().value_or(0.0F));
      }
      if (!is_finite(p)) {
        throw InputError(file + ": triangle " + std::to_string(t + 1) +
                         " has a coordinate that is "
                         "not finite");
      }
    }
    cursor.skip(2);  // attributes
    scene.add(triangle);
  }
  return scene.take();
}

/// The words of an ASCII file, over line ends.
class StlText {
 public:
  StlText(std::string_view text, const std::string& file) : cursor_(text, file) {}

  bool at_end() {
    while (!cursor_.at_end() && cursor_.line_is_done()) cursor_.next_line();
    return cursor_.at_end();
  }
  std::string_view word() { return at_end() ? std::string_view() : cursor_.word(); }
  void expect(std::string_view wanted) {
    const std::string_view found = word();
    if (found != wanted)
      refuse("'" + std::string(wanted) + "' should stand here, not " + quoted(found));
  }
  double number() {
    at_end();
    return cursor_.number();
  }
  std::string rest() { return std::string(cursor_.rest()); }
  [[noreturn]] void refuse(const std::string& what) const { cursor_.refuse(what); }

 private:
  TextCursor cursor_;
};

void read_facet(StlText& text, StlScene& scene) {
  text.expect("normal");
  for (int k = 0; k < 3; ++k) text.word();  // often not a number, and not asked
  text.expect("outer");
  text.expect("loop");
  std::array<Vec3, 3> triangle;
  for (Vec3& p : triangle) {
    text.expect("vertex");
    p.x = text.number();
    p.y = text.number();
    p.z = text.number();
  }
  text.expect("endloop");
  text.expect("endfacet");
  scene.add(triangle);
}

RawScene read_text(std::string_view bytes, const std::string& file, Progress& progress) {
  StlText text(bytes, file);
  StlScene scene;
  while (!text.at_end()) {
    progress.stop_if_cancelled();
    text.expect("solid");
    const std::string name = text.rest();
    scene.begin_solid(name.empty() ? "default" : name);
    for (;;) {
      const std::string_view keyword = text.word();
      if (keyword == "endsolid") break;
      if (keyword != "facet")
        text.refuse("'facet' or 'endsolid' should stand here, not " + quoted(keyword));
      read_facet(text, scene);
    }
    text.rest();
  }
  return scene.take();
}

}  // namespace

RawScene read_stl(const std::filesystem::path& path, Progress& progress) {
  const std::string bytes = read_input_file(path);
  return is_binary(bytes) ? read_binary(bytes, path.string(), progress)
                          : read_text(bytes, path.string(), progress);
}

}  // namespace tenku
