#include <fmt/format.h>

#include <array>
#include <chrono>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/finding_json.h"
#include "cli/lit_scene_options.h"
#include "cli/option_list.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/version.h"
#include "flythrough/fly_through.h"
#include "flythrough/path_checks.h"
#include "flythrough/relight.h"
#include "flythrough/store_lighting.h"
#include "output/sha256.h"
#include "study/camera_path_reader.h"
#include "study/point_export.h"
#include "view/eye_inside.h"
#include "visibility/crossing_faces.h"

namespace tenku {
namespace {

struct FlyThroughOptions {
  LitSceneOptions lit;
  std::string path, relight, store, export_to;
  std::size_t lighting = 0;
  bool resume = false;
};

/// What must be as it was for a store to fit the scene.
std::vector<std::array<std::string, 2>> scene_settings(const LitSceneOptions& how) {
  const std::string& materials = how.scene.materials;
  std::string terrain;
  for (const std::string& file : how.scene.terrain) terrain += sha256_of_file(file) + " ";
  if (!terrain.empty())
    terrain += fmt::format("{} {:g} %", how.scene.on_terrain, how.tolerance_pct);
  std::string around = how.scene.around;
  if (!around.empty()) around += fmt::format(" {:g} %", how.tolerance_pct);
  return {{"materials_sha256", materials.empty() ? "" : sha256_of_file(materials)},
          {"ground", how.scene.ground},
          {"terrain", terrain},
          {"around", around},
          {"building_lod", how.scene.building_lod}};
}

StoreHeader header_of(const FlyThroughOptions& options, const LitScene& lit, CameraPath path,
                      const CommonOptions& common) {
  StoreHeader header;
  header.scene = options.lit.scene.scene;
  header.scene_sha256 = sha256_of_input(options.lit.scene.scene);
  header.software = std::string(software_name());
  if (lit.scene().georeference) header.crs = lit.scene().georeference->crs;
  header.file_origin = lit.scene().frame.origin();
  for (const Material& m : lit.scene().materials) {
    header.materials.push_back({m.name, m.reflectance, m.emission_lm_m2});
  }
  header.path = std::move(path);
  const LitSceneOptions& how = options.lit;
  header.settings = scene_settings(how);
  header.settings.insert(header.settings.end(),
                         {{"time", how.site.time},
                          {"sky", lit.sky().description},
                          {"horizontal_lux", fmt::format("{}", lit.source().unobstructed_lux())},
                          {"tolerance_pct", fmt::format("{}", how.tolerance_pct)},
                          {"bounces", fmt::format("{}", how.bounces)},
                          {"engine", how.engine},
                          {"lod", how.lod},
                          {"elements", fmt::format("{}", lit.source().element_count())},
                          {"seed", fmt::format("{}", common.seed)}});
  return header;
}

void check_options(const FlyThroughOptions& options) {
  if (options.relight.empty()) {
    if (options.lit.scene.scene.empty()) throw InputError("SCENE is needed");
    if (options.path.empty()) throw InputError("--path is needed: the file of the camera path");
    if (options.lit.out.empty()) throw InputError("--out is needed: the store to write");
    if (options.lit.out == "-") throw InputError("--out -: a store is a file");
    check_can_write(options.lit.out);
  } else if (!options.path.empty() || !options.lit.out.empty() || options.resume) {
    throw InputError(
        "--relight adds light to its store: --path, --out and --resume do not go with it");
  }
  if (!(options.lit.tolerance_pct > 0.0 && options.lit.tolerance_pct <= 100.0)) {
    throw InputError(fmt::format("--tolerance {}: not in (0, 100]", options.lit.tolerance_pct));
  }
  if (!(options.lit.bounces >= 0 && options.lit.bounces <= 100)) {
    throw InputError(fmt::format("--bounces {}: not in 0..100", options.lit.bounces));
  }
}

void tell(const CommonOptions& options, const LitScene& lit, const FlyThroughResult& result,
          double seconds) {
  std::vector<Finding> findings = lit.scene().findings;
  for (const auto* more : {&lit.sky().diagnostics, &result.findings}) {
    findings.insert(findings.end(), more->begin(), more->end());
  }
  say_findings(options, findings);
  const double each = result.points > 0
                          ? static_cast<double>(result.bytes) / static_cast<double>(result.points)
                          : 0;
  say(options, fmt::format("{} points in {} chunks, {:.1f} bytes a point; lit by {}", result.points,
                           result.chunks, each, result.how));
  if (!options.json) return;
  nlohmann::ordered_json json{{"seconds", seconds},
                              {"gather_s", result.gather_s},
                              {"light_s", result.light_s},
                              {"frames", result.frames},
                              {"frames_before", result.frames_before},
                              {"points", result.points},
                              {"chunks", result.chunks},
                              {"bytes", result.bytes},
                              {"rays", result.rays},
                              {"light", result.how},
                              {"sky", lit.sky().description},
                              {"findings", json_of(result.findings)}};
  fmt::print("{}\n", json.dump(2));
}

int fly(const FlyThroughOptions& options, const CommandContext& context) {
  check_options(options);
  const auto start = std::chrono::steady_clock::now();
  const CameraPathRequest asked = read_camera_path(options.path);
  const LitScene lit = load_lit_scene(options.lit, context.progress);
  FlyThroughRequest request;
  request.file = options.lit.out;
  request.resume = options.resume;
  request.header = header_of(options, lit, camera_path_in(asked, lit), context.options);
  request.lighting = lighting_of(lit.sky(), lit.source(), options.lit.site.time);
  request.light = {options.lit.tolerance_pct, options.lit.bounces, context.options.seed};
  request.method = light_method(options.lit);
  FlyThroughResult result = fly_through(request, lit.engines(), lit.source(), context.progress);
  const CameraPath& path = request.header.path;
  for (Finding& f : check_path(path, asked.keys, lit.scene(), lit.rays())) {
    result.findings.push_back(std::move(f));
  }
  if (auto inside = eye_inside(path.frames.front().eye, lit.scene(), lit.rays())) {
    result.findings.push_back(std::move(*inside));
  }
  if (auto crossing = crossing_faces(lit.scene(), lit.rays())) {
    result.findings.push_back(std::move(*crossing));
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  tell(context.options, lit, result, time.count());
  return kDone;
}

/// Adds another sun and sky to a store.
int relight_store(FlyThroughOptions options, const CommandContext& context) {
  check_options(options);
  const auto start = std::chrono::steady_clock::now();
  {
    const PointStore store(options.relight);
    if (options.lit.scene.scene.empty()) options.lit.scene.scene = store.header().scene;
    for (const auto& [key, value] : scene_settings(options.lit)) {
      if (store.header().setting(key) == value) continue;
      throw InputError(fmt::format("{}: {} was '{}', and now is '{}'", options.relight, key,
                                   store.header().setting(key), value));
    }
  }
  const LitScene lit = load_lit_scene(options.lit, context.progress);
  const RelightResult result =
      relight(options.relight, sha256_of_input(options.lit.scene.scene),
              lighting_of(lit.sky(), lit.source(), options.lit.site.time),
              {options.lit.tolerance_pct, options.lit.bounces, context.options.seed}, lit.engines(),
              lit.source(), context.progress);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  say_findings(context.options, lit.sky().diagnostics);
  say(context.options, fmt::format("{} points in {} chunks have lighting {}", result.points,
                                   result.chunks, result.lighting));
  if (context.options.json) {
    const nlohmann::ordered_json json{{"seconds", time.count()}, {"lighting", result.lighting},
                                      {"points", result.points}, {"chunks", result.chunks},
                                      {"bytes", result.bytes},   {"sky", lit.sky().description}};
    fmt::print("{}\n", json.dump(2));
  }
  return kDone;
}

/// Gives the points of a store to other programs.
int export_store(const FlyThroughOptions& options) {
  if (options.store.empty()) throw InputError("--export needs --store, the store to take from");
  check_export_ending(options.export_to);
  check_can_write(options.export_to);
  export_points(PointStore(options.store), options.lighting, options.export_to);
  return kDone;
}

}  // namespace

CommandBody make_flythrough_command(OptionList& app) {
  const auto options = std::make_shared<FlyThroughOptions>();  // outlives this call
  add_lit_scene_options(app, options->lit);
  app.get_option("SCENE").required(false);  // a store that is relit knows its own
  app.add_option("--out", options->lit.out, "store to write (.tkpts)");
  app.add_option("--path", options->path, "camera path (TOML): keys with time, eye and target");
  app.add_flag("--resume", options->resume,
               "go on with OUT.part, which a run that was cut off left behind");
  app.add_option("--relight", options->relight,
                 "add the light of another --time or sky to this store, in place of a new one");
  app.add_option("--store", options->store, "with --export: the store to take points from");
  app.add_option("--export", options->export_to,
                 "write the points of --store for other programs: .ply, .glb or .vtp");
  app.add_option("--lighting", options->lighting,
                 "with --export: which sun and sky of the store, from 0 (default 0)");
  return [options](const CommandContext& context) {
    if (!options->export_to.empty()) return export_store(*options);
    return options->relight.empty() ? fly(*options, context) : relight_store(*options, context);
  };
}

}  // namespace tenku
