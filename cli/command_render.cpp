#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "study/view_output.h"
#include "view/view_render.h"

namespace tenku {
namespace {

struct RenderOptions {
  LitSceneOptions lit;
  std::string eye, target, size = "512x512", show = "luminance";
  double fov_deg = 60.0;
};

Vec3 point_of(const std::string& text, const char* option) {
  Vec3 p;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &p.x, &p.y, &p.z, &rest) != 3 || !is_finite(p)) {
    throw InputError(fmt::format("{} {}: three numbers E,N,U are needed", option, text));
  }
  return p;
}

std::pair<int, int> size_of(const std::string& text) {
  constexpr int kLargestSide = 16384;
  int width = 0, height = 0;
  char rest = 0;
  if (text.size() > 16 || std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2) {
    throw InputError(fmt::format("--size {}: WIDTHxHEIGHT in pixels is needed", text));
  }
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestSide) {
    throw InputError(fmt::format("--size {}: a side is not in 1..{} pixels", text, kLargestSide));
  }
  return {width, height};
}

/// Finds before the scene is read what is wrong with the view.
void check_view(const RenderOptions& options) {
  if (options.eye.empty() != options.target.empty()) {
    throw InputError("give both --eye and --target, or neither for an overview");
  }
  if (!(options.fov_deg > 0.0 && options.fov_deg < 180.0)) {
    throw InputError(fmt::format("--fov {}: not between 0 and 180 degrees", options.fov_deg));
  }
  if (options.eye.empty()) return;
  if (point_of(options.eye, "--eye") == point_of(options.target, "--target")) {
    throw InputError(fmt::format("--eye and --target are the same point, {}", options.eye));
  }
}

int render(const RenderOptions& options, const CommandContext& context) {
  const ViewKind kind = view_kind_named(options.show);
  check_picture_ending(options.lit.out);
  check_can_write(options.lit.out);
  check_view(options);
  const auto [width, height] = size_of(options.size);
  const auto start = std::chrono::steady_clock::now();
  const LitScene lit = load_lit_scene(options.lit, context.progress);
  ViewRequest request;
  request.view.width = width;
  request.view.height = height;
  request.view.horizontal_fov = Angle::degrees(options.fov_deg);
  if (options.eye.empty()) {
    place_overview(lit, request.view);
  } else {
    request.view.eye = lit.scene().frame.to_local(point_of(options.eye, "--eye"));
    request.view.target = lit.scene().frame.to_local(point_of(options.target, "--target"));
  }
  request.tolerance_pct = options.lit.tolerance_pct;
  request.bounces = options.lit.bounces;
  request.seed = context.options.seed;
  request.method = light_method(options.lit);
  const RenderedView view =
      render_view(request, lit.engines(), lit.source(), lit.sky().model.get(), context.progress);
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

CommandBody make_render_command(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();  // outlives this call
  add_lit_scene_options(app, options->lit);
  app.add_option("--eye", options->eye, "where the camera is: E,N,U in the scene's coordinates");
  app.add_option("--target", options->target, "what it looks at: E,N,U");
  app.add_option("--fov", options->fov_deg, "horizontal field of view, degrees (default 60)");
  app.add_option("--size", options->size, "pixels, WIDTHxHEIGHT (default 512x512)");
  app.add_option("--show", options->show, "luminance, illuminance or falsecolor");
  return [options](const CommandContext& context) { return render(*options, context); };
}

}  // namespace tenku
