/// What a scene file holds, after reading: objects, polygons, materials, and where on Earth.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/extent.h"
#include "core/finding.h"
#include "core/vec3.h"
#include "scene/file_frame.h"
#include "scene/georeference.h"
#include "scene/material.h"
#include "scene/surface_type.h"

namespace tenku {

/// Index that points to nothing: no parent, no shell, no material of the file.
inline constexpr std::uint32_t kNone = 0xffffffffU;

/// Id of the horizontal ground that tenku puts under a city without terrain.
inline constexpr const char* kGroundObjectId = "tenku:ground";

/// A thing with a name: a city object of CityJSON, an `o` or `g` of OBJ.
struct SceneObject {
  std::string id;
  std::string type;              ///< as the file says: `Building`, `TINRelief`; empty for OBJ
  std::uint32_t parent = kNone;  ///< index into `Scene::objects`
  std::string group = {};        ///< OBJ: name of the `g` it is in; empty elsewhere
};

/// Polygons with inner rings, as flat arrays.
///
/// Shape    surface s has the rings [first_ring[s], first_ring[s + 1]), the outer one first;
///          ring r has the vertices vertex[first_vertex[r]] to vertex[first_vertex[r + 1] - 1],
///          the first not repeated. All per-surface arrays have `size()` entries.
/// Frame    outer rings counter-clockwise seen from outside.
struct Surfaces {
  std::vector<std::uint32_t> vertex;           ///< index into `Scene::vertices`
  std::vector<std::uint32_t> first_vertex{0};  ///< [ring + 1]
  std::vector<std::uint32_t> first_ring{0};    ///< [surface + 1]
  std::vector<SurfaceType> type;               ///< [surface]
  std::vector<std::uint8_t> lod;               ///< [surface], index into `Scene::lods`
  std::vector<std::uint32_t> object;           ///< [surface], index into `Scene::objects`
  std::vector<std::uint32_t> material;         ///< [surface], index into `Scene::materials`
  std::vector<std::uint32_t> shell;            ///< [surface], number of the solid's shell, or kNone

  std::size_t size() const { return type.size(); }
  std::size_t rings(std::size_t s) const { return first_ring[s + 1] - first_ring[s]; }
  std::span<const std::uint32_t> ring(std::size_t r) const {
    return {vertex.data() + first_vertex[r], first_vertex[r + 1] - first_vertex[r]};
  }
  std::span<const std::uint32_t> outer_ring(std::size_t s) const { return ring(first_ring[s]); }
};

/// Everything that was read from one scene file, and what was found wrong with it.
///
/// Frame    `vertices` are local east, north, up about `frame`'s origin; `extent` is in the
///          coordinates of the file.
/// Units    metres.
/// Valid    every index is in range, every coordinate finite, every ring has three distinct
///          vertices or more.
struct Scene {
  std::string format;  ///< `CityJSON 2.0`, `CityJSONSeq 2.0`, `OBJ`
  std::vector<SceneObject> objects;
  std::vector<Material> materials;
  std::vector<Vec3> vertices;
  Surfaces surfaces;
  std::vector<std::string> lods;                     ///< labels of the levels of detail used
  std::map<std::string, std::size_t> lod_triangles;  ///< all levels in the file, also unused ones
  FileFrame frame;
  /// Between local metres and the map: easting, northing, height in the units of the CRS, or
  /// longitude, latitude, height; local metres about another origin where there is no CRS. Turns
  /// and scales of the options are in `frame` alone.
  FileFrame map_frame;
  std::optional<Georeference> georeference;
  Extent extent;             ///< of what was read, without the ground that tenku gives
  bool is_city = false;      ///< has buildings of a city model, or a georeference of its own
  bool has_terrain = false;  ///< something in the file is the ground
  std::vector<Finding> findings;
};

/// Area vector of surface `s`: its length is the area in m2, inner rings taken off; its
/// direction the mean normal. By Newell's sum over the rings.
Vec3 area_vector(const Scene& scene, std::size_t s);

/// Of the vertices that surfaces use, in the frame of `vertices`.
Extent extent_of_surfaces(const Scene& scene);

/// Wall, roof (facing up) or ground (facing down), by the normal of a building's surface.
/// Up and down begin 10 degrees from the vertical plane.
SurfaceType type_by_normal(Vec3 normal);

}  // namespace tenku
