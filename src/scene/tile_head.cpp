#include "scene/tile_head.h"

#include <simdjson.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "core/error.h"
#include "scene/citygml_types.h"
#include "scene/cityjson_geometry.h"
#include "scene/input_file.h"
#include "scene/xml_stream.h"

namespace tenku {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;

std::optional<Vec3> point_of(element list, std::size_t from = 0) {
  array items;
  std::array<double, 3> xyz{};
  if (list.get(items) != simdjson::SUCCESS || items.size() < from + 3) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) {
    if (items.at(from + k).get(xyz[k]) != simdjson::SUCCESS) return std::nullopt;
  }
  return Vec3{xyz[0], xyz[1], xyz[2]};
}

std::optional<Extent> told_box(element document) {
  element list;
  if (document["metadata"]["geographicalExtent"].get(list) != simdjson::SUCCESS) return {};
  const auto low = point_of(list), high = point_of(list, 3);
  if (!low || !high) return std::nullopt;
  return Extent{*low, *high};
}

std::optional<Extent> box_of_vertices(element document) {
  array points;
  element transform;
  if (document["vertices"].get(points) != simdjson::SUCCESS || points.size() == 0) return {};
  std::optional<Vec3> scale = Vec3{1, 1, 1}, translate = Vec3{};
  if (document["transform"].get(transform) == simdjson::SUCCESS) {
    element of_scale, of_translate;
    if (transform["scale"].get(of_scale) != simdjson::SUCCESS ||
        transform["translate"].get(of_translate) != simdjson::SUCCESS) {
      return std::nullopt;
    }
    scale = point_of(of_scale), translate = point_of(of_translate);
  }
  if (!scale || !translate) return std::nullopt;
  Extent box;
  for (const element point : points) {
    const auto p = point_of(point);
    if (!p) return std::nullopt;
    box.add(Vec3{scale->x * p->x, scale->y * p->y, scale->z * p->z} + *translate);
  }
  return box;
}

/// Ends the walk once the envelope is known, or members begin.
class EnvelopeReader : public XmlVisitor {
 public:
  void begin_element(std::string_view name, const XmlAttributes& attributes) override {
    if (name == "cityObjectMember" || name == "featureMember") stop();
    if (const std::string_view crs = attributes("srsName"); !crs.empty() && head.crs.empty()) {
      head.crs = crs;
      head.has_registry_axes = names_registry_axes(crs);
    }
    text_.clear();
  }
  void end_element(std::string_view name) override {
    if (name == "lowerCorner") low_ = numbers();
    if (name == "upperCorner") high_ = numbers();
    if (name != "Envelope") return;
    if (low_ && high_) head.box = Extent{*low_, *high_};
    stop();
  }
  void text(std::string_view piece) override { text_ += piece; }

  TileHead head;

 private:
  [[noreturn]] static void stop() { throw InputError("enough was read"); }

  std::optional<Vec3> numbers() const {
    const char* at = text_.c_str();
    std::array<double, 3> xyz{};
    for (double& x : xyz) {
      char* end = nullptr;
      x = std::strtod(at, &end);
      if (end == at || !std::isfinite(x)) return std::nullopt;
      at = end;
    }
    return Vec3{xyz[0], xyz[1], xyz[2]};
  }

  std::string text_;
  std::optional<Vec3> low_, high_;
};

}  // namespace

TileHead head_of_cityjson(const std::filesystem::path& path) {
  TileHead head;
  try {
    std::string bytes = read_input_file(path);
    simdjson::dom::parser parser;
    element document, templates;
    if (parser.parse(bytes).get(document) != simdjson::SUCCESS) {
      const std::string first_line = bytes.substr(0, bytes.find('\n'));
      if (parser.parse(first_line).get(document) != simdjson::SUCCESS) return head;
      head.box = told_box(document);
    } else if (document["geometry-templates"].get(templates) == simdjson::SUCCESS) {
      head.box = told_box(document);
    } else {
      head.box = box_of_vertices(document);
    }
    head.crs = crs_of_cityjson(document);
  } catch (const InputError&) {
  }
  return head;
}

TileHead head_of_citygml(const std::filesystem::path& path, Progress& progress) {
  EnvelopeReader reader;
  try {
    walk_xml(path, reader, progress);
  } catch (const InputError&) {
  }
  return reader.head;
}

}  // namespace tenku
