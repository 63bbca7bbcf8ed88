/// A scene between its reader and its finishing: coordinates still those of the file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace tenku {

/// Findings counted by kind and object, in the order of their first occurrence.
class FindingCounter {
 public:
  /// Adds one, or raises the count of the one with the same code and object.
  void add(const Finding& finding);
  const std::vector<Finding>& all() const { return findings_; }
  std::vector<Finding> take() { return std::move(findings_); }

 private:
  std::map<std::pair<std::string, std::string>, std::size_t> index_;
  std::vector<Finding> findings_;
};

/// Easting, northing and height as signed axes of the file, each plus a constant: what a header
/// comment of an OBJ can say.
struct GridAxes {
  Vec3 easting{1, 0, 0}, northing{0, 1, 0}, height{0, 0, 1};
  Vec3 offset{};
};
inline constexpr GridAxes kYUpAxes{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};

/// What a reader makes of a file.
///
/// Frame    `scene.vertices` in coordinates of the file.
/// Shape    `is_building` [object], `is_inner_shell` [shell]; `scene.surfaces.material` is an
///          index into `file_materials` or kNone.
struct RawScene {
  Scene scene;
  FindingCounter findings;
  std::string crs;                 ///< as the file says; empty if it says none
  bool is_mesh = false;            ///< polygons of no city: no LODs, no place expected
  bool shares_vertices = true;     ///< the format has indices: equal vertices are worth a word
  bool has_registry_axes = false;  ///< coordinates in the order that the registry has for `crs`
  GridAxes axes;
  double metres_per_unit = 1.0;   ///< of coordinates without a CRS, where the file says it
  bool axes_are_given = false;    ///< the file says how its axes lie
  std::optional<Location> place;  ///< of the file's origin, if the file gives that and no CRS
  std::vector<std::uint8_t> is_building;
  std::vector<std::uint8_t> is_inner_shell;

  /// A material that the file names; `given` if it says what it is like.
  struct FileMaterial {
    Material material;
    bool given = false;
  };
  std::vector<FileMaterial> file_materials;

  const std::string& object_of(std::size_t s) const {
    return scene.objects[scene.surfaces.object[s]].id;
  }
};

/// Objects without a type that come by name, one for each.
class ObjectsByName {
 public:
  std::uint32_t find_or_add(RawScene& raw, const std::string& id);

 private:
  std::unordered_map<std::string, std::uint32_t> index_;
};

/// Appends the vertices of a ring; call `end_ring` of the surface after each, `end_surface` last.
inline void end_ring(Surfaces& surfaces) {
  surfaces.first_vertex.push_back(static_cast<std::uint32_t>(surfaces.vertex.size()));
}

/// What is the same for all rings of a surface.
struct SurfaceFacts {
  SurfaceType type = SurfaceType::Unknown;
  std::uint8_t lod = 0;
  std::uint32_t object = 0, material = kNone, shell = kNone;
};
void end_surface(Surfaces& surfaces, const SurfaceFacts& facts);

}  // namespace tenku
