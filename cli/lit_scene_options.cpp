#include "cli/lit_scene_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/option_list.h"
#include "cli/plan_output.h"
#include "core/error.h"
#include "illuminance/wide_texels.h"

namespace tenku {
LightMethod light_method(const LitSceneOptions& options) {
  LightMethod method;
  method.engine = engine_named(options.engine);
  method.detail = detail_named(options.lod);
  method.mu = options.mu;
  return method;
}

IlluminanceOptions illuminance_options(const LitSceneOptions& options,
                                       const CommonOptions& common) {
  IlluminanceOptions how;
  how.tolerance_pct = options.tolerance_pct;
  how.bounces = options.bounces;
  how.seed = common.seed;
  return how;
}

void add_lit_scene_options(OptionList& app, LitSceneOptions& options) {
  add_scene_options(app, options.scene);
  add_site_options(app, options.site);
  add_sky_options(app, options.sky);
  add_partition_options(app, options.partition, "none, the sky is summed over slices");
  app.add_option("--tolerance", options.tolerance_pct,
                 "error asked for, percent of each value (default 2)");
  app.add_option("--bounces", options.bounces,
                 "diffuse bounces of the reflected light, 0 for none (default 5)");
  app.add_option("--reflection", options.reflection,
                 "reflected light: auto, radiosity or paths; auto takes radiosity in rooms "
                 "(default auto)");
  app.add_option("--engine", options.engine,
                 "visibility engine: auto, rays or shadow-maps (default auto)");
  app.add_option("--gl", options.gl, "what draws shadow maps: auto, osmesa or egl (default auto)");
  app.add_option("--lod", options.lod,
                 "detail: off, paper or budget, as the tolerance allows (default budget)");
  app.add_option("--mu", options.mu,
                 "with --lod paper, the error that a polygon may have, in pixels (default 1)");
}

void add_out_option(OptionList& app, LitSceneOptions& options) {
  app.add_option("--out", options.out, "file to write; - for standard output").required();
}

LitScene load_lit_scene(const LitSceneOptions& options, Progress& progress) {
  light_method(options);  // refuses names before the scene is read
  reflection_named(options.reflection);
  std::optional<PartitionRequest> partition;
  if (options.partition.is_given()) partition = resolve_partition(options.partition);
  ReadOptions read = read_options(options.scene);
  read.tolerance_pct = options.tolerance_pct;
  if (options.site.latitude_deg) read.site = resolve_location(options.site, std::nullopt);
  const auto make_sky = [&](const std::optional<Location>& scene_site) {
    return resolve_sky(options.site, options.sky, scene_site);
  };
  return LitScene(options.scene.scene, read, make_sky, partition, gl_platform_named(options.gl),
                  progress);
}

bool is_worth_telling(const std::vector<PlannedRegion>& regions) {
  return std::any_of(regions.begin(), regions.end(), [](const PlannedRegion& r) {
    return r.engine == Engine::ShadowMaps || std::isfinite(r.predicted_s());
  });
}

int close_calculation(const CommonOptions& options, const LitScene& lit,
                      const CalculationSummary& summary) {
  std::vector<Finding> findings = lit.scene().findings;
  for (const auto* more : {&lit.sky().diagnostics, &summary.findings}) {
    findings.insert(findings.end(), more->begin(), more->end());
  }
  if (auto wide = wide_texels(summary.regions, lit.scene().frame)) {
    findings.push_back(std::move(*wide));
  }
  say_findings(options, findings);
  if (is_worth_telling(summary.regions)) say(options, table_of(summary.regions));
  const DecisionCounts& decided = summary.decided;
  if (!summary.decide.empty()) say(options, in_words(summary.decide, decided));
  if (options.json) {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - summary.start;
    nlohmann::ordered_json json{{"seconds", time.count()},
                                {"rays", summary.rays},
                                {"depth_maps", lit.engines().maps_drawn()},
                                {"elements", lit.source().element_count()},
                                {summary.counted, summary.count},
                                {"error_mean", summary.error_mean},
                                {"out_of_tolerance", summary.out_of_tolerance},
                                {"sky", lit.sky().description},
                                {"horizontal_lux", lit.source().unobstructed_lux()},
                                {"plan", json_of(summary.regions)}};
    if (!summary.decide.empty()) {
      json["decided"] = {{"value", summary.decide},
                         {"yes", decided.yes},
                         {"no", decided.no},
                         {"undecided", decided.undecided}};
    }
    fmt::print("{}\n", json.dump(2));
  }
  return summary.out_of_tolerance > 0 ? kToleranceNotReached : kDone;
}

void say_findings(const CommonOptions& options, const std::vector<Finding>& findings) {
  std::map<std::string, std::pair<const Finding*, std::size_t>> kinds;
  for (const Finding& finding : findings) {
    // Those of whole results (sensors, pixels) differ by their words; those of objects are counted.
    const bool is_of_all = finding.object.empty() && finding.where.empty();
    auto& [first, count] = kinds[finding.code + (is_of_all ? finding.what : "")];
    if (first == nullptr) first = &finding;
    count += finding.count;
  }
  for (const auto& [key, kind] : kinds) {
    const auto& [first, count] = kind;
    const std::string& place = first->object.empty() ? first->where : first->object;
    say(options, fmt::format("{}: {} x {}: {}{}{}", name_of(first->severity), count, first->code,
                             first->what, place.empty() ? "" : ", first at ", place));
  }
}

}  // namespace tenku
