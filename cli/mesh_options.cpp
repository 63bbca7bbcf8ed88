#include "cli/mesh_options.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "cli/option_list.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "study/mesh_report.h"

namespace tenku {
namespace {

constexpr std::size_t kFirstShare = 4;   // of the elements allowed: what splitting starts from
constexpr double kShownThreshold = 2.0;  // percent: what is split for comparison

bool has_sizes_by_hand(const RadiosityMeshOptions& options) {
  return options.sizes.element_min_m > 0.0 && options.sizes.element_m > 0.0;
}

/// What the first mesh is to be like: of bubbles by hand between both sizes, as the source asks.
MeshOptions first_sizes(const RadiosityMeshOptions& options, Mesher mesher, double tolerance_pct) {
  MeshOptions first = options.sizes;
  first.tolerance_pct = tolerance_pct;
  if (mesher == Mesher::Uniform) return first;
  if (mesher == Mesher::Refine) first.elements_max /= kFirstShare;
  if (mesher == Mesher::Bubble && has_sizes_by_hand(options)) {
    first.element_m = std::sqrt(first.element_m * first.element_min_m);
    first.element_min_m = 0.0;
    first.elements_max = 0;
  }
  if (options.first_m > 0.0) first.element_m = options.first_m, first.elements_max = 0;
  return first;
}

std::optional<Vec3> sun_of(const LitScene& lit) {
  const SolarDisc& sun = lit.source().sun;
  if (!(sun.normal_illuminance > Illuminance(0.0))) return {};
  return sun.direction;
}

}  // namespace

void add_mesh_options(OptionList& app, RadiosityMeshOptions& o) {
  app.add_option("--mesh", o.mesh,
                 "how surfaces are divided: uniform, refine (split where neighbours differ), or "
                 "bubble (made anew to suit the light)");
  app.add_option("--elements-max", o.sizes.elements_max, "elements not to be passed");
  app.add_option("--size-min", o.sizes.element_min_m, "smallest size of an element, metres");
  app.add_option("--size-max", o.sizes.element_m,
                 "longest edge of an element, metres; of bubbles the largest size");
  app.add_option("--size-first", o.first_m,
                 "longest edge in the first mesh of refine and bubble, metres");
  app.add_option("--patch-size", o.sizes.patch_m, "longest diagonal of a patch, metres");
  app.add_option("--split-above", o.threshold_pct,
                 "refine: difference of neighbours that splits them, percent of the mean "
                 "illuminance (default: the tolerance)");
  app.add_option("--rounds", o.rounds, "meshes after the first, at most (default 3)");
  app.add_option("--report", o.report,
                 "page (.html) with the first mesh, the last one and the light on both");
  app.add_flag("--shadow-edges", o.shadow_edges,
               "bubble: edges of elements follow the edges of shadows");
}

void check_mesh_options(const RadiosityMeshOptions& options) {
  const Mesher mesher = mesher_named(options.mesh);
  const auto needs = [&](bool is_given, const char* option, const char* mesh) {
    if (is_given && options.mesh != mesh) {
      throw InputError(fmt::format("{} needs --mesh {}", option, mesh));
    }
  };
  needs(options.shadow_edges, "--shadow-edges", "bubble");
  needs(options.threshold_pct != 0.0, "--split-above", "refine");
  if (!(options.threshold_pct >= 0.0)) throw InputError("--split-above must not be negative");
  if (!(options.first_m >= 0.0)) throw InputError("--size-first must not be negative");
  if (!options.report.empty()) check_can_write(options.report);
  if (mesher != Mesher::Uniform) return;
  if (options.first_m > 0.0 || options.rounds >= 0) {
    throw InputError("--size-first and --rounds need --mesh refine or bubble");
  }
}

std::unique_ptr<MeshLoop> make_mesh_loop(const LitScene& lit, const RadiosityMeshOptions& options,
                                         const InteriorOptions& interior,
                                         std::vector<Finding>& findings) {
  MeshLoopOptions how;
  how.mesher = mesher_named(options.mesh);
  how.tolerance_pct = interior.tolerance_pct;
  how.elements_max = options.sizes.elements_max;
  how.threshold_pct = options.threshold_pct;
  if (options.rounds >= 0) how.rounds = options.rounds;
  if (how.mesher == Mesher::Bubble) {
    how.sizes = {options.sizes.element_min_m, options.sizes.element_m};
  }
  MeshedScene first =
      mesh_scene(lit.scene(), lit.soup(), first_sizes(options, how.mesher, interior.tolerance_pct));
  findings = std::move(first.findings);
  if (options.shadow_edges) {
    how.edges = shadow_edges(first.polygons, lit.scene().materials, lit.rays(), sun_of(lit));
  }
  return std::make_unique<MeshLoop>(std::move(first), lit.scene().materials, interior,
                                    std::move(how));
}

bool is_fine_enough(const MeshLoop& loop, const RadiosityMeshOptions& options, double tolerance_pct,
                    std::vector<Finding>& findings) {
  const double missed = loop.rounds().back().missed_pct;
  const bool is_by_hand = options.mesh == "uniform" || has_sizes_by_hand(options) ||
                          options.sizes.elements_max > 0 || options.threshold_pct > 0.0;
  if (is_by_hand || missed <= tolerance_pct) return true;
  Finding finding;
  finding.code = "mesh_tolerance_not_reached";
  finding.what = fmt::format(
      "what is drawn between corners misses {:.2g} % of the mean illuminance (root mean square), "
      "not {:.2g} %",
      missed, tolerance_pct);
  finding.repair = "more --rounds; with the sun, --shadow-edges";
  findings.push_back(std::move(finding));
  return false;
}

void write_mesh_report(const LitScene& lit, const RadiosityMeshOptions& options,
                       const InteriorOptions& interior, const MeshLoop& last,
                       const LightRequest& request, Progress& progress) {
  const Mesher mesher = mesher_named(options.mesh);
  const auto solved = [&](MeshLoopOptions how) {
    MeshedScene first =
        mesh_scene(lit.scene(), lit.soup(), first_sizes(options, mesher, interior.tolerance_pct));
    InteriorOptions quiet = interior;
    quiet.watch = nullptr;
    auto loop =
        std::make_unique<MeshLoop>(std::move(first), lit.scene().materials, quiet, std::move(how));
    loop->run(request, progress);
    return loop;
  };
  std::unique_ptr<MeshLoop> first, split;
  std::vector<NamedMesh> meshes;
  if (mesher != Mesher::Uniform) {
    first = solved({});
    meshes.emplace_back("First mesh", first.get());
  }
  if (mesher == Mesher::Bubble) {
    split = solved({.mesher = Mesher::Refine,
                    .elements_max = 2 * first->mesh().size(),
                    .threshold_pct = kShownThreshold,
                    .rounds = 1});
    meshes.emplace_back("Split where neighbours differ", split.get());
  }
  meshes.emplace_back(mesher == Mesher::Bubble   ? "Bubble mesh"
                      : mesher == Mesher::Refine ? "Split where neighbours differ"
                                                 : "Uniform mesh",
                      &last);
  write_whole_file(options.report, mesh_report("Meshes for radiosity", meshes));
}

}  // namespace tenku
