#include "cli/view_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <tuple>
#include <utility>

#include "cli/option_list.h"
#include "core/error.h"
#include "study/view_output.h"

namespace tenku {
namespace {

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

}  // namespace

void check_view_options(const ViewOptions& options) {
  size_of(options.size);
  mirror_method_named(options.mirrors);
  check_mirror_depth(options.depth);
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

void add_camera_options(OptionList& app, ViewOptions& options, const std::string& size) {
  options.size = size;
  app.add_option("--eye", options.eye, "where the camera is: E,N,U in the scene's coordinates");
  app.add_option("--target", options.target, "what it looks at: E,N,U");
  app.add_option("--fov", options.fov_deg, "horizontal field of view, degrees (default 60)");
  app.add_option("--size", options.size, fmt::format("pixels, WIDTHxHEIGHT (default {})", size));
}

void add_view_options(OptionList& app, ViewOptions& options) {
  add_camera_options(app, options, options.size);
  app.add_option("--mirrors", options.mirrors,
                 "how mirrors are followed: auto, beams, rays or off (default auto)");
  app.add_option("--depth", options.depth, "mirrors in a row that are followed (default 4)");
}

ViewRequest view_request(const ViewOptions& options, const LitSceneOptions& how,
                         const LitScene& lit, const CommonOptions& common) {
  ViewRequest request;
  PerspectiveView& view = request.view;
  std::tie(view.width, view.height) = size_of(options.size);
  view.horizontal_fov = Angle::degrees(options.fov_deg);
  if (options.eye.empty()) {
    place_overview(lit, view);
  } else {
    view.eye = lit.scene().frame.to_local(point_of(options.eye, "--eye"));
    view.target = lit.scene().frame.to_local(point_of(options.target, "--target"));
  }
  request.tolerance_pct = how.tolerance_pct;
  request.bounces = how.bounces;
  request.seed = common.seed;
  request.method = light_method(how);
  request.mirrors.method = mirror_method_named(options.mirrors);
  request.mirrors.depth = options.depth;
  return request;
}

}  // namespace tenku
