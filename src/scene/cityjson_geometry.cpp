#include "scene/cityjson_geometry.h"

#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "scene/tenku_material.h"

namespace tenku {

using Array = simdjson::dom::array;
using Element = simdjson::dom::element;

namespace {

Array array_or_refuse(Element element, const CityJsonPlace& place, const char* what) {
  Array array;
  if (element.get(array) != simdjson::SUCCESS) {
    refuse(place, std::string(what) + " should be a list");
  }
  return array;
}

}  // namespace

void refuse(const CityJsonPlace& place, const std::string& what) {
  const std::string object =
      place.object.empty() ? "" : "object '" + std::string(place.object) + "': ";
  throw InputError(place.file + ": " + object + what);
}

LodLabel lod_of(Element geometry) {
  Element lod;
  if (geometry["lod"].get(lod) != simdjson::SUCCESS) return {};
  std::string_view text;
  LodLabel label;
  if (lod.get(text) == simdjson::SUCCESS) {
    label.text = text;
    label.value = std::strtod(label.text.c_str(), nullptr);
  } else if (lod.get(label.value) == simdjson::SUCCESS) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", label.value);
    label.text = buffer;
  }
  if (!std::isfinite(label.value)) return {};
  return label;
}

std::string crs_of_cityjson(simdjson::dom::element document) {
  simdjson::dom::element metadata = document;
  if (document["metadata"].get(metadata) != simdjson::SUCCESS) return {};
  std::string_view text;
  std::int64_t code = 0;
  if (metadata["referenceSystem"].get(text) == simdjson::SUCCESS ||
      metadata["crs"].get(text) == simdjson::SUCCESS) {
    return std::string(text);
  }
  if (metadata["epsg"].get(code) == simdjson::SUCCESS ||
      metadata["crs"]["epsg"].get(code) == simdjson::SUCCESS) {
    return "EPSG:" + std::to_string(code);
  }
  return {};
}

int surface_depth(std::string_view type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 0;
  if (type == "Solid") return 1;
  return type == "MultiSolid" || type == "CompositeSolid" ? 2 : -1;
}

std::size_t count_triangles(Element boundaries, int depth) {
  Array items;
  if (boundaries.get(items) != simdjson::SUCCESS) return 0;
  std::size_t triangles = 0;
  for (const Element item : items) {
    if (depth >= 0) {
      triangles += count_triangles(item, depth - 1);
      continue;
    }
    Array ring;
    if (item.get(ring) == simdjson::SUCCESS) triangles += ring.size() + 2;
  }
  // A surface of n vertices in all and h inner rings makes n + 2 h - 2 triangles.
  return depth < 0 ? (triangles > 4 ? triangles - 4 : 0) : triangles;
}

void GeometryAppender::append(Element geometry, std::string_view type) {
  Element boundaries;
  if (geometry["boundaries"].get(boundaries) != simdjson::SUCCESS) {
    refuse(place_, "a geometry has no 'boundaries'");
  }
  semantics_.clear();
  read_semantics(geometry);
  Element values;
  const bool has_values = geometry["semantics"]["values"].get(values) == simdjson::SUCCESS;
  facts_.shell = kNone;
  append_level(boundaries, has_values ? &values : nullptr, surface_depth(type));
}

void GeometryAppender::read_semantics(Element geometry) {
  Array surfaces;
  if (geometry["semantics"]["surfaces"].get(surfaces) != simdjson::SUCCESS) return;
  for (const Element surface : surfaces) {
    std::string_view type = "(none)";
    if (surface["type"].get(type) != simdjson::SUCCESS) type = "(none)";
    semantics_.push_back({semantic_kind(type), tenku_material(surface, raw_, place_)});
    if (semantics_.back().kind.is_known) continue;
    raw_.findings.add({"unknown_semantic_type", Severity::Note, std::string(place_.object), "",
                       "surfaces have the unknown type '" + std::string(type) + "'",
                       "treated as surfaces without a type"});
  }
}

void GeometryAppender::append_level(Element boundaries, const Element* values, int depth) {
  const Array items = array_or_refuse(boundaries, place_, "'boundaries'");
  Array value_items;
  const bool nested = values != nullptr && values->get(value_items) == simdjson::SUCCESS;
  auto value = nested ? value_items.begin() : Array::iterator();
  bool inner = false;
  for (const Element item : items) {
    Element own;
    const bool has_own = nested && value != value_items.end();
    if (has_own) own = *value, ++value;
    if (depth == 1) {
      facts_.shell = static_cast<std::uint32_t>(raw_.is_inner_shell.size());
      raw_.is_inner_shell.push_back(inner ? 1 : 0);
      inner = true;
    }
    if (depth == 0) {
      append_surface(item, has_own ? &own : nullptr);
    } else {
      append_level(item, has_own ? &own : nullptr, depth - 1);
    }
  }
}

bool GeometryAppender::choose_type(const Element* value) {
  facts_.type = object_type_;
  facts_.material = kNone;
  std::uint64_t index = 0;
  if (value == nullptr || value->is_null()) return true;
  if (value->get(index) != simdjson::SUCCESS || index >= semantics_.size()) {
    raw_.findings.add({"semantics_index", Severity::Warning, std::string(place_.object), "",
                       "a semantic value does not point to a semantic surface",
                       "the surface is treated as one without a type"});
    return true;
  }
  const SemanticKind kind = semantics_[index].kind;
  facts_.material = semantics_[index].material;
  if (kind.type != SurfaceType::Unknown) facts_.type = kind.type;
  return !kind.is_virtual;
}

void GeometryAppender::append_surface(Element rings, const Element* value) {
  const Array list = array_or_refuse(rings, place_, "a surface");
  const bool is_there = choose_type(value);
  if (!is_there) {
    raw_.findings.add({"closure_surface", Severity::Note, std::string(place_.object), "",
                       "closure surfaces close a volume but are not there in reality",
                       "left out, so that light passes"});
    return;
  }
  if (list.size() == 0) {
    raw_.findings.add({"degenerate_ring", Severity::Warning, std::string(place_.object), "",
                       "a ring has fewer than three distinct vertices", "left out"});
    return;
  }
  for (const Element ring : list) append_ring(ring);
  end_surface(raw_.scene.surfaces, facts_);
}

void GeometryAppender::append_ring(Element ring) {
  for (const Element item : array_or_refuse(ring, place_, "a ring of vertex indices")) {
    std::uint64_t index = 0;
    if (item.get(index) != simdjson::SUCCESS) {
      refuse(place_, "a vertex index is not a whole number from 0 up: " +
                         simdjson::minify(item).substr(0, 40));
    }
    raw_.scene.surfaces.vertex.push_back(vertex_of_(index));
  }
  end_ring(raw_.scene.surfaces);
}

}  // namespace tenku
