#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "cli/option_list.h"
#include "cli/view_options.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "study/scene_reflection.h"
#include "study/view_output.h"
#include "view/eye_inside.h"
#include "view/view_render.h"

namespace tenku {
namespace {

struct RenderOptions {
  LitSceneOptions lit;
  ViewOptions view;
  std::string show = "luminance", background;
  double background_white_cd_m2 = 10'000.0;
};

/// The pictures all round, or nothing.
std::unique_ptr<Background> background_of(const RenderOptions& options) {
  if (!(options.background_white_cd_m2 > 0.0 && std::isfinite(options.background_white_cd_m2))) {
    throw InputError(
        fmt::format("--background-white {}: must be positive", options.background_white_cd_m2));
  }
  if (options.background.empty()) return nullptr;
  return read_background(options.background, Luminance(options.background_white_cd_m2));
}

int render(const RenderOptions& options, const CommandContext& context) {
  const ViewKind kind = view_kind_named(options.show);
  check_picture_ending(options.lit.out);
  check_can_write(options.lit.out);
  check_view_options(options.view);
  const std::unique_ptr<Background> background = background_of(options);
  const auto start = std::chrono::steady_clock::now();
  const LitScene lit = load_lit_scene(options.lit, context.progress);
  ViewRequest request = view_request(options.view, options.lit, lit, context.options);
  request.background = background.get();
  request.mirrors.light_all = kind == ViewKind::IlluminanceImage;
  SceneReflection reflection(lit, reflection_named(options.lit.reflection));
  request.reflection =
      reflection.finder(illuminance_options(options.lit, context.options), request.method);
  RenderedView view =
      render_view(request, lit.engines(), lit.source(), lit.sky().model.get(), context.progress);
  reflection.tell(view.findings);
  if (auto inside = eye_inside(request.view.eye, lit.scene(), lit.rays())) {
    view.findings.push_back(std::move(*inside));
  }
  write_view(options.lit.out, view, kind,
             {.title = options.lit.scene.scene, .time = options.lit.site.time, .units = {}});
  return close_calculation(context.options, lit,
                           {.start = start,
                            .rays = view.rays,
                            .counted = "pixels",
                            .count = view.luminance.pixels.size(),
                            .out_of_tolerance = view.out_of_tolerance,
                            .error_mean = view.error_mean,
                            .regions = view.regions,
                            .findings = view.findings});
}

}  // namespace

CommandBody make_render_command(OptionList& app) {
  const auto options = std::make_shared<RenderOptions>();  // outlives this call
  add_lit_scene_options(app, options->lit);
  add_out_option(app, options->lit);
  add_view_options(app, options->view);
  app.add_option("--show", options->show, "luminance, illuminance or falsecolor");
  app.add_option("--background", options->background,
                 "pictures seen behind the scene, which light nothing: cube:FOLDER (east, west, "
                 "north, south, up, down) or image:FILE");
  app.add_option("--background-white", options->background_white_cd_m2,
                 "cd/m2 of white in an 8- or 16-bit picture of it (default 10000)");
  return [options](const CommandContext& context) { return render(*options, context); };
}

}  // namespace tenku
