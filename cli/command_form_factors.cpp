#include <fmt/format.h>

#include <chrono>
#include <map>
#include <optional>

#include "cli/command.h"
#include "cli/finding_json.h"
#include "cli/lit_scene_options.h"
#include "cli/option_list.h"
#include "cli/scene_options.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/suggest.h"
#include "form_factors/group_form_factors.h"
#include "output/table_writer.h"
#include "scene/flatten.h"

namespace tenku {
namespace {

using Json = nlohmann::ordered_json;

struct FormFactorCommandOptions {
  SceneOptions scene;
  std::string method = "analytic", by = "object", out;
  bool two_sided = false;
  int resolution = 512;
  double polyline_deg = 0.0;
  std::optional<double> tolerance_pct;
};

/// The faces of a scene, and the names of their groups.
struct GroupedFaces {
  ElementMesh mesh;
  std::vector<std::string> names;
};

/// The name of the group that triangle `t` is in.
std::string group_of(const Scene& scene, const TriangleSoup& soup, std::size_t t,
                     const std::string& by) {
  if (by == "material") return scene.materials[soup.material[t]].name;
  const SceneObject& object = scene.objects[soup.object[t]];
  return by == "group" ? object.group : object.id;
}

void check_grouping(const std::string& by) {
  const std::vector<std::string_view> known{"object", "group", "material"};
  if (std::find(known.begin(), known.end(), by) != known.end()) return;
  throw InputError("--by is object, group or material, not '" + by + "'" + suggestion(by, known));
}

/// Triangles of no area send nothing and are left out.
GroupedFaces grouped_faces(const Scene& scene, const std::string& by) {
  const TriangleSoup soup = flatten(scene);
  GroupedFaces faces;
  faces.mesh.vertices = soup.vertices;
  std::map<std::string, std::uint32_t> number;
  for (std::size_t t = 0; t < soup.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const Vec3 ab = soup.vertices[b] - soup.vertices[a], ac = soup.vertices[c] - soup.vertices[a];
    if (!(length(cross(ab, ac)) > 0.0)) continue;
    const std::string name = group_of(scene, soup, t, by);
    const auto [at, is_new] = number.try_emplace(name, static_cast<std::uint32_t>(number.size()));
    if (is_new) faces.names.push_back(name);
    faces.mesh.elements.push_back(soup.triangles[t]);
    faces.mesh.material.push_back(soup.material[t]);
    faces.mesh.object.push_back(at->second);
    faces.mesh.patch_begin.push_back(static_cast<std::uint32_t>(faces.mesh.size()));
  }
  constexpr std::size_t kMostGroups = 3000;
  if (faces.names.size() > kMostGroups) {
    throw InputError(fmt::format("{} groups are too many for a table; up to {} will do (--by)",
                                 faces.names.size(), kMostGroups));
  }
  return faces;
}

/// Points enough for an accurate small scene, fewer in a large one, and as many as a method can
/// take in about the same time.
GroupFormFactorOptions integration(const FormFactorCommandOptions& options, bool exact,
                                   std::size_t elements) {
  GroupFormFactorOptions how{.two_sided = options.two_sided, .patch = {}};
  const bool by_lines = options.method == "hemisphere-scanline";
  const double each = exact ? 40000.0 : by_lines ? 2000.0 : 400.0;
  const double most = 4.0 * each / static_cast<double>(elements);
  how.patch.most_points = static_cast<std::size_t>(std::clamp(most, 20.0, each));
  how.patch.relative_tolerance = options.tolerance_pct ? 0.01 * *options.tolerance_pct
                                 : exact               ? 5e-7
                                                       : 1e-3;
  how.patch.absolute_tolerance = exact ? 1e-8 : 1e-6;
  return how;
}

CsvTable table_of(const GroupFormFactors& matrix, const std::vector<std::string>& names) {
  CsvTable table("from,to,form_factor,error");
  for (std::size_t i = 0; i < matrix.groups; ++i) {
    for (std::size_t j = 0; j < matrix.groups; ++j) {
      const std::size_t at = i * matrix.groups + j;
      table.add(names[i]).add(names[j]);
      table.add(matrix.value[at]).add(matrix.error[at]).end_row();
    }
  }
  return table;
}

Json summary_of(const FormFactorCommandOptions& options, const Scene& scene,
                const GroupedFaces& faces, const GroupFormFactors& matrix, double seconds) {
  Json summary{{"method", options.method},       {"resolution", options.resolution},
               {"two_sided", options.two_sided}, {"groups", matrix.groups},
               {"triangles", faces.mesh.size()}, {"seconds", seconds},
               {"row_sums", Json::object()},     {"to_backs", Json::object()}};
  for (std::size_t i = 0; i < matrix.groups; ++i) {
    summary["row_sums"][faces.names[i]] = matrix.row_sum(i);
    summary["to_backs"][faces.names[i]] = matrix.to_backs[i];
  }
  summary["reciprocity_defect"] = matrix.reciprocity_defect();
  summary["diagnostics"] = json_of(scene.findings);
  summary["error_max"] = *std::max_element(matrix.error.begin(), matrix.error.end());
  return summary;
}

/// A row that falls short of 1 in a closed scene is no leak where it meets backs.
std::string told_of_backs(double share) {
  if (!(share > 1e-6)) return "";
  return fmt::format("; {:.6f} meets backs of faces (--two-sided counts them)", share);
}

void say_summary(const CommonOptions& options, const GroupedFaces& faces,
                 const GroupFormFactors& matrix, double seconds) {
  say(options, fmt::format("{} groups of {} triangles in {:.2f} s; reciprocity within {:.2g}",
                           matrix.groups, faces.mesh.size(), seconds, matrix.reciprocity_defect()));
  constexpr std::size_t kShown = 20;
  for (std::size_t i = 0; i < matrix.groups && (options.verbose || i < kShown); ++i) {
    say(options, fmt::format("row sum {:.6f}  {}{}", matrix.row_sum(i), faces.names[i],
                             told_of_backs(matrix.to_backs[i])));
  }
  if (matrix.groups > kShown && !options.verbose) {
    say(options, fmt::format("and {} more rows (--verbose)", matrix.groups - kShown));
  }
}

void check_request(const FormFactorCommandOptions& options) {
  check_grouping(options.by);
  if (options.tolerance_pct && !(*options.tolerance_pct > 0.0 && *options.tolerance_pct <= 100.0)) {
    throw InputError("--tolerance is more than 0 and at most 100 percent");
  }
  check_form_factor_method(options.method, {options.resolution, options.polyline_deg, 1});
  check_can_write(options.out);
}

int form_factors(const FormFactorCommandOptions& options, const CommandContext& context) {
  check_request(options);
  const auto start = std::chrono::steady_clock::now();
  const Scene scene =
      read_scene(options.scene.scene, read_options(options.scene), context.progress);
  const GroupedFaces faces = grouped_faces(scene, options.by);
  const auto method = form_factor_method(
      options.method, faces.mesh, {options.resolution, options.polyline_deg, context.options.seed});
  const GroupFormFactors matrix = group_form_factors(
      *method, faces.mesh, faces.names.size(),
      integration(options, method->is_exact(), faces.mesh.size()), context.progress);
  table_of(matrix, faces.names).write(options.out);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  say_summary(context.options, faces, matrix, taken.count());
  say_findings(context.options, scene.findings);
  if (context.options.json) {
    fmt::print("{}\n", summary_of(options, scene, faces, matrix, taken.count())
                           .dump(2, ' ', false, Json::error_handler_t::replace));
  }
  return options.tolerance_pct && !matrix.within_tolerance ? kToleranceNotReached : kDone;
}

}  // namespace

CommandBody make_form_factors_command(OptionList& app) {
  const auto options = std::make_shared<FormFactorCommandOptions>();  // outlives this call
  add_scene_options(app, options->scene);
  app.add_option("--method", options->method,
                 "hemisphere-scanline, hemisphere-zbuffer, hemisphere-rays, hemicube or analytic "
                 "(default)");
  app.add_option("--out", options->out,
                 "CSV table from,to,form_factor,error; - for standard output")
      .required();
  app.add_flag("--two-sided", options->two_sided, "let every polygon see from both faces");
  app.add_option("--resolution", options->resolution,
                 "lines of the disc, or pixels along the edge of the hemicube (default 512)");
  app.add_option(
      "--polyline", options->polyline_deg,
      "degrees over which an edge is straight on the disc; 0 (default): arcs as they are");
  app.add_option("--by", options->by, "what makes a group: object (default), group or material");
  app.add_option("--tolerance", options->tolerance_pct,
                 "error of the integration asked for, percent of each form factor");
  return [options](const CommandContext& context) { return form_factors(*options, context); };
}

}  // namespace tenku
