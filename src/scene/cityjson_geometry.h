/// Geometry objects of CityJSON: boundaries, semantics, templates. Private to this module.
#pragma once

#include <simdjson.h>

#include <functional>
#include <string>
#include <vector>

#include "scene/cityjson_types.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Level of detail as text and as a number for comparison; a missing one is below 0.
struct LodLabel {
  std::string text;
  double value = -1.0;
};

/// The `lod` of a geometry, a string or (CityJSON 1.0) a number.
LodLabel lod_of(simdjson::dom::element geometry);

/// Where messages say they are: file and object.
struct CityJsonPlace {
  const std::string& file;
  std::string_view object;
};
[[noreturn]] void refuse(const CityJsonPlace& place, const std::string& what);

/// Name of the reference system; empty if the metadata have none.
std::string crs_of_cityjson(simdjson::dom::element document);

/// How deep the surfaces of a geometry type are nested: 0 for MultiSurface and CompositeSurface,
/// 1 for Solid, 2 for MultiSolid and CompositeSolid, -1 for points, lines and instances.
int surface_depth(std::string_view geometry_type);

/// Triangles that the boundaries at `depth` amount to.
std::size_t count_triangles(simdjson::dom::element boundaries, int depth);

/// Appends a geometry's surfaces to a scene.
class GeometryAppender {
 public:
  /// Index into `Scene::vertices` of a vertex index in the file; refuses what is out of range.
  using VertexOf = std::function<std::uint32_t(std::uint64_t)>;

  GeometryAppender(RawScene& raw, const CityJsonPlace& place, SurfaceFacts facts,
                   VertexOf vertex_of)
      : raw_(raw),
        place_(place),
        facts_(facts),
        object_type_(facts.type),
        vertex_of_(std::move(vertex_of)) {}

  void append(simdjson::dom::element geometry, std::string_view type);

 private:
  using Element = simdjson::dom::element;
  void read_semantics(Element geometry);
  void append_level(Element boundaries, const Element* values, int depth);
  void append_surface(Element rings, const Element* value);
  void append_ring(Element ring);
  bool choose_type(const Element* value);

  RawScene& raw_;
  const CityJsonPlace& place_;
  SurfaceFacts facts_;
  SurfaceType object_type_;
  VertexOf vertex_of_;
  struct Semantics {
    SemanticKind kind;
    std::uint32_t material = kNone;
  };
  std::vector<Semantics> semantics_;
};

}  // namespace tenku
