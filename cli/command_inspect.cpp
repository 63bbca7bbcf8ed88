#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>

#include "cli/command.h"
#include "cli/finding_json.h"
#include "cli/option_list.h"
#include "cli/scene_options.h"
#include "cli/store_inspection.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "scene/cityjson_writer.h"
#include "scene/flatten.h"

namespace tenku {
namespace {

using Json = nlohmann::ordered_json;

/// Counts of what was read, without the ground that tenku gives.
struct Counts {
  std::size_t objects = 0, triangles = 0;
  std::map<std::string, std::size_t> object_types;
  std::array<std::size_t, kSurfaceTypes> surface_types{};
};

Counts counts_of(const Scene& scene, const TriangleSoup& soup) {
  Counts counts;
  for (const SceneObject& object : scene.objects) {
    if (object.id == kGroundObjectId) continue;
    ++counts.objects;
    if (!object.type.empty()) ++counts.object_types[object.type];
  }
  for (std::size_t t = 0; t < soup.size(); ++t) {
    if (scene.objects[soup.object[t]].id == kGroundObjectId) continue;
    ++counts.triangles;
    ++counts.surface_types[static_cast<std::size_t>(soup.surface_type[t])];
  }
  return counts;
}

Json json_of(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

Json place_of(const Scene& scene) {
  if (!scene.georeference) return nullptr;
  const Georeference& at = *scene.georeference;
  return {{"latitude", at.origin.latitude.in_degrees()},
          {"longitude", at.origin.longitude.in_degrees()},
          {"elevation_m", at.origin.elevation_m},
          {"grid_convergence_deg", at.grid_convergence.in_degrees()},
          {"point_scale", at.point_scale},
          {"local_origin", json_of(scene.frame.origin())}};
}

Json json_of(const Scene& scene, const Counts& counts) {
  Json out;
  out["format"] = scene.format;
  const bool has_crs = scene.georeference && !scene.georeference->crs.empty();
  out["crs"] = has_crs ? Json(scene.georeference->crs) : Json(nullptr);
  out["crs_name"] = has_crs ? Json(scene.georeference->name) : Json(nullptr);
  out["place"] = place_of(scene);
  out["objects"] = counts.objects;
  out["object_types"] = counts.object_types;
  out["surfaces"] = scene.surfaces.size();
  out["vertices"] = scene.vertices.size();
  out["triangles"] = counts.triangles;
  out["lods"] = Json::object();
  for (const auto& [label, triangles] : scene.lod_triangles) {
    if (!label.empty()) out["lods"][label] = triangles;
  }
  out["lods_used"] = Json::array();
  for (const std::string& label : scene.lods) {
    if (!label.empty()) out["lods_used"].push_back(label);
  }
  out["extent"] = {{"min", json_of(scene.extent.min)}, {"max", json_of(scene.extent.max)}};
  out["surface_types"] = Json::object();
  for (std::size_t t = 0; t < counts.surface_types.size(); ++t) {
    if (counts.surface_types[t] == 0) continue;
    out["surface_types"][std::string(name_of(static_cast<SurfaceType>(t)))] =
        counts.surface_types[t];
  }
  out["findings"] = json_of(scene.findings);
  return out;
}

void print_place(const Scene& scene) {
  if (!scene.georeference)
    return fmt::print("place       not known (give --crs, or --lat and --lon)\n");
  const Georeference& at = *scene.georeference;
  if (!at.crs.empty()) fmt::print("crs         {} ({})\n", at.crs, at.name);
  fmt::print("place       latitude {:.6f}, longitude {:.6f} at the local origin\n",
             at.origin.latitude.in_degrees(), at.origin.longitude.in_degrees());
  if (at.crs.empty()) return;
  fmt::print("grid        north points to {:+.4f} degrees, lengths are {:.6f} of true ones\n",
             at.grid_convergence.in_degrees(), at.point_scale);
}

template <class Map>
void print_counts(const char* title, const Map& counts) {
  std::string line;
  for (const auto& [name, count] : counts) {
    if (!std::string(name).empty())
      line += fmt::format("{}{} {}", line.empty() ? "" : ", ", count, name);
  }
  if (!line.empty()) fmt::print("{:<11} {}\n", title, line);
}

/// One line a kind of finding; each object's only with --verbose.
void print_findings(const Scene& scene, bool each) {
  struct Kind {
    const Finding* first;
    std::size_t count = 0, objects = 0;
  };
  std::vector<Kind> kinds;
  for (const Finding& finding : scene.findings) {
    auto kind = std::find_if(kinds.begin(), kinds.end(),
                             [&](const Kind& k) { return k.first->code == finding.code; });
    if (kind == kinds.end()) kind = kinds.insert(kinds.end(), Kind{&finding});
    kind->count += finding.count;
    kind->objects += finding.object.empty() ? 0 : 1;
  }
  if (kinds.empty()) fmt::print("findings    none\n");
  for (const Kind& kind : kinds) {
    const Finding& f = *kind.first;
    std::string object = f.object.empty() ? "" : fmt::format(" [{}", f.object);
    if (kind.objects > 1) object += fmt::format(" and {} more", kind.objects - 1);
    if (!object.empty()) object += "]";
    const std::string where = f.where.empty() ? "" : " (" + f.where + ")";
    fmt::print("{:<7}     {} x {}: {}{}; {}{}\n", name_of(f.severity), kind.count, f.code, f.what,
               where, f.repair, object);
  }
  if (!each) return;
  for (const Finding& f : scene.findings) {
    fmt::print("  {} {} {} x {}\n", name_of(f.severity), f.object, f.count, f.code);
  }
}

void print_text(const Scene& scene, const Counts& counts, bool verbose) {
  fmt::print("format      {}\n", scene.format);
  print_place(scene);
  const Vec3 a = scene.extent.min, b = scene.extent.max;
  fmt::print("extent      {:.3f} {:.3f} {:.3f} to {:.3f} {:.3f} {:.3f}\n", a.x, a.y, a.z, b.x, b.y,
             b.z);
  fmt::print("objects     {}\n", counts.objects);
  print_counts("", counts.object_types);
  fmt::print("triangles   {} of {} surfaces\n", counts.triangles, scene.surfaces.size());
  std::map<std::string_view, std::size_t> types;
  for (std::size_t t = 0; t < counts.surface_types.size(); ++t) {
    if (counts.surface_types[t] > 0) {
      types[name_of(static_cast<SurfaceType>(t))] = counts.surface_types[t];
    }
  }
  print_counts("", types);
  for (const auto& [label, triangles] : scene.lod_triangles) {
    if (!label.empty()) fmt::print("LOD {:<7} {} triangles\n", label, triangles);
  }
  print_findings(scene, verbose);
}

struct InspectOptions {
  SceneOptions scene;
  std::string repaired;  ///< path, or empty
};

void check_request(const InspectOptions& options) {
  if (options.repaired.empty()) return;
  if (is_store_name(options.scene.scene)) {
    throw InputError("--repaired writes a scene, and " + options.scene.scene + " holds points");
  }
  if (!options.repaired.ends_with(".json")) {
    throw InputError("cannot write '" + options.repaired + "': the ending must be .city.json");
  }
  check_can_write(options.repaired);
}

void write_repaired(const Scene& scene, const InspectOptions& options,
                    const CommandContext& context) {
  write_whole_file(options.repaired, cityjson_of(scene));
  if (scene.georeference && scene.georeference->crs.empty()) {
    const Location& at = scene.georeference->origin;
    say(context.options,
        fmt::format("{} has no place on Earth, as there is no coordinate reference system: read it "
                    "with --lat {} --lon {}",
                    options.repaired, at.latitude.in_degrees(), at.longitude.in_degrees()));
  }
}

int inspect(const InspectOptions& options, const CommandContext& context) {
  check_request(options);
  const std::string& file = options.scene.scene;
  if (is_store_name(file)) return inspect_store(file, context.options);
  const Scene scene = read_scene(file, read_options(options.scene), context.progress);
  if (!options.repaired.empty()) write_repaired(scene, options, context);
  const Counts counts = counts_of(scene, flatten(scene));
  if (context.options.json) {
    const std::string text =
        json_of(scene, counts).dump(2, ' ', false, Json::error_handler_t::replace);
    fmt::print("{}\n", text);
  } else {
    print_text(scene, counts, context.options.verbose);
  }
  return kDone;
}

}  // namespace

CommandBody make_inspect_command(OptionList& app) {
  const auto options =
      std::make_shared<InspectOptions>();  // shared with the body, which outlives us
  add_scene_options(app, options->scene);
  app.add_option("--repaired", options->repaired,
                 "writes what is used, with all that was mended, as CityJSON (.city.json)");
  return [options](const CommandContext& context) { return inspect(*options, context); };
}

}  // namespace tenku
