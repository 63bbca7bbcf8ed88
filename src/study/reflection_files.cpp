#include "study/reflection_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "site/local_place.h"
#include "study/illuminance_field.h"
#include "study/named_codes.h"

namespace tenku {
namespace {

Vec3 middle_of(const std::vector<Vec3>& corners) {
  Vec3 moment{};
  double area = 0.0;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const double part = length(cross(corners[k - 1] - corners[0], corners[k] - corners[0]));
    moment = moment + (part / 3.0) * (corners[0] + corners[k - 1] + corners[k]);
    area += part;
  }
  return area > 0.0 ? (1.0 / area) * moment : corners[0];
}

/// What all outputs say of a polygon.
class PatchTeller {
 public:
  PatchTeller(const ReflectedSun& sun, const LitScene& lit) : sun_(sun), lit_(lit) {}

  const std::string& object(const SunPatch& patch) const {
    return lit_.scene().objects[lit_.soup().object[patch.triangle]].id;
  }
  SurfaceType type(const SunPatch& patch) const { return broad_type(lit_.soup(), patch.triangle); }
  std::string panels(const SunPatch& patch) const {
    std::string names;
    for (const std::uint32_t p : patch.panels) {
      names += (names.empty() ? "" : " ") + sun_.panel_names[p];
    }
    return names;
  }
  /// Calls visit(moment, patch) for all.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t m = 0; m < sun_.patches.size(); ++m) {
      for (const SunPatch& patch : sun_.patches[m]) visit(m, patch);
    }
  }

 private:
  const ReflectedSun& sun_;
  const LitScene& lit_;
};

std::string outline_text(const SunPatch& patch, const FileFrame& frame) {
  std::string text = "POLYGON Z ((";
  for (std::size_t k = 0; k <= patch.corners.size(); ++k) {
    const Vec3 p = frame.to_file(patch.corners[k % patch.corners.size()]);
    if (k > 0) text += ", ";
    append_number(text, p.x);
    text += ' ';
    append_number(text, p.y);
    text += ' ';
    append_number(text, p.z);
  }
  return text + "))";
}

/// Longitude, latitude and height, or the file's coordinates.
class MapPlace {
 public:
  explicit MapPlace(const Scene& scene) : scene_(scene) {}

  Vec3 operator()(Vec3 local) const {
    if (!scene_.georeference) return scene_.frame.to_file(local);
    const Location place = place_of(scene_.georeference->origin, local);
    return {place.longitude.in_degrees(), place.latitude.in_degrees(), place.elevation_m};
  }

 private:
  const Scene& scene_;
};

/// Nine decimals of a degree are 0.1 mm, of a metre more than enough.
void append_position(std::string& text, Vec3 p) {
  fmt::format_to(std::back_inserter(text), "[{:.9f},{:.9f},{:.4f}]", p.x, p.y, p.z);
}

std::string ring_text(const SunPatch& patch, const MapPlace& place) {
  std::vector<Vec3> ring;
  double twice_area = 0.0;
  for (const Vec3& p : patch.corners) ring.push_back(place(p));
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3 a = ring[k], b = ring[(k + 1) % ring.size()];
    twice_area += (a.x - ring[0].x) * (b.y - ring[0].y) - (b.x - ring[0].x) * (a.y - ring[0].y);
  }
  if (twice_area < 0.0) std::reverse(ring.begin(), ring.end());
  ring.push_back(ring.front());
  std::string text = "[[";
  for (std::size_t k = 0; k < ring.size(); ++k) {
    if (k > 0) text += ',';
    append_position(text, ring[k]);
  }
  return text + "]]";
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

CsvTable polygon_table(const ReflectedSun& sun, const LitScene& lit) {
  CsvTable table(
      "time,from,to,object,surface_type,lux,area_m2,blur_m,mirrors,panels,x,y,z,polygon");
  const PatchTeller tell(sun, lit);
  const FileFrame& frame = lit.scene().frame;
  tell.for_each([&](std::size_t m, const SunPatch& patch) {
    const auto [from, to] = sun.window_text(m, m);
    table.add(sun.time_text(m)).add(from).add(to).add(tell.object(patch));
    table.add(name_of(tell.type(patch))).add(patch.lux).add(patch.area_m2).add(patch.blur_m);
    const Vec3 middle = frame.to_file(middle_of(patch.corners));
    table.add(static_cast<double>(patch.mirrors)).add(tell.panels(patch));
    table.add(middle.x).add(middle.y).add(middle.z).add(outline_text(patch, frame));
    table.end_row();
  });
  return table;
}

CsvTable panel_table(const ReflectedSun& sun, const LitScene& lit) {
  CsvTable table(
      "panel,x,y,z,area_m2,azimuth_deg,tilt_deg,first,last,minutes,most_lux,most_lm,thrown_lmh,"
      "reflectance,least_lit");
  for (std::size_t p = 0; p < sun.panels.size(); ++p) {
    const MirrorPanel& panel = sun.panels[p];
    const PanelSum& sum = sun.sums[p];
    const Vec3 at = lit.scene().frame.to_file(panel.middle);
    table.add(sun.panel_names[p]).add(at.x).add(at.y).add(at.z).add(panel.area_m2);
    table.add(azimuth_of(panel.normal).in_degrees());
    table.add(90.0 - altitude_of(panel.normal).in_degrees());
    const bool throws = sum.instants > 0;
    table.add(throws ? sun.window_text(sum.first, sum.first).first : "");
    table.add(throws ? sun.window_text(sum.last, sum.last).second : "");
    table.add(sum.minutes).add(sum.most_lux).add(sum.most_lm).add(sum.thrown_lmh);
    table.add(sum.most_reflectance).add(sum.most_lm > 0.0 ? sum.least_lit : 0.0);
    table.end_row();
  }
  return table;
}

CsvTable window_table(const ReflectedSun& sun, const LitScene& lit) {
  CsvTable table("panel,object,from,to,most_lux,most_area_m2");
  for (const SunWindow& window : sun.windows) {
    const auto [from, to] = sun.window_text(window.first, window.last);
    table.add(sun.panel_names[window.panel]).add(lit.scene().objects[window.object].id);
    table.add(from).add(to).add(window.most_lux).add(window.most_m2);
    table.end_row();
  }
  return table;
}

std::string geojson_of(const ReflectedSun& sun, const LitScene& lit) {
  const PatchTeller tell(sun, lit);
  const MapPlace place(lit.scene());
  std::string text = "{\"type\":\"FeatureCollection\",\"features\":[";
  bool is_first = true;
  tell.for_each([&](std::size_t m, const SunPatch& patch) {
    const auto [from, to] = sun.window_text(m, m);
    text += is_first ? "\n" : ",\n";
    is_first = false;
    fmt::format_to(std::back_inserter(text),
                   "{{\"type\":\"Feature\",\"properties\":{{\"time\":{},\"from\":{},\"to\":{},"
                   "\"object\":{},\"surface_type\":{},\"lux\":{:.6g},\"area_m2\":{:.6g},"
                   "\"blur_m\":{:.4g},\"mirrors\":{},\"panels\":{}}},"
                   "\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":",
                   quoted(sun.time_text(m)), quoted(from), quoted(to), quoted(tell.object(patch)),
                   quoted(std::string(name_of(tell.type(patch)))), patch.lux, patch.area_m2,
                   patch.blur_m, patch.mirrors, quoted(tell.panels(patch)));
    text += ring_text(patch, place) + "}}";
  });
  return text + "\n]}\n";
}

FieldMesh reflection_field(const ReflectedSun& sun, const LitScene& lit) {
  const PatchTeller tell(sun, lit);
  FieldMesh mesh;
  FieldValues lux{"lux", {}}, blur{"blur_m", {}}, mirrors{"mirrors", {}}, count{"panel_count", {}};
  NamedCodes<std::string> time("time"), object("object_id"), type("surface_type"), panel("panel");
  tell.for_each([&](std::size_t m, const SunPatch& patch) {
    std::vector<std::uint32_t> corners;
    for (const Vec3& p : patch.corners) {
      corners.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      mesh.points.push_back(p);
    }
    mesh.add_polygon(corners);
    lux.values.push_back(patch.lux);
    blur.values.push_back(patch.blur_m);
    mirrors.values.push_back(patch.mirrors);
    count.values.push_back(static_cast<double>(patch.panels.size()));
    time.add(sun.time_text(m));
    object.add(tell.object(patch));
    type.add(std::string(name_of(tell.type(patch))));
    panel.add(sun.panel_names[patch.panels.front()]);
  });
  mesh.cell_values = {std::move(lux), std::move(blur), std::move(mirrors), std::move(count)};
  for (NamedCodes<std::string>* codes : {&time, &object, &type, &panel}) codes->move_to(mesh);
  add_place(mesh, lit);
  return mesh;
}

bool is_reflection_output(const std::filesystem::path& path) {
  const std::string name = path.string();
  return name == "-" || name.ends_with(".csv") || name.ends_with(".geojson") ||
         name.ends_with(".json") || name.ends_with(".vtp");
}

void write_reflections(const std::filesystem::path& path, const ReflectedSun& sun,
                       const LitScene& lit) {
  const std::string name = path.string();
  if (name.ends_with(".vtp")) {
    write_vtp(path, reflection_field(sun, lit));
  } else if (name.ends_with("json")) {
    write_whole_file(path, geojson_of(sun, lit));
  } else {
    polygon_table(sun, lit).write(path);
  }
}

}  // namespace tenku
