#include "study/view_output.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "output/canvas.h"
#include "output/map_furniture.h"
#include "view/false_colour.h"
#include "view/tone_map.h"
#include "view/value_scale.h"

namespace tenku {
namespace {

constexpr int kLegendHeight = 84, kMargin = 34;

/// What the false colours and the files of a kind hold, and in what unit.
struct Shown {
  std::vector<double> values;
  std::string quantity, unit;
};

Shown shown(const RenderedView& view, ViewKind kind) {
  if (kind == ViewKind::IlluminanceImage) return {view.illuminance_lux, "Illuminance", "lx"};
  Shown result{{}, "Luminance", "cd/m2"};
  for (const Rgb& pixel : view.luminance.pixels) result.values.push_back(luminance_of(pixel));
  return result;
}

Image8 with_legend(const RenderedView& view, ViewKind kind) {
  const Shown what = shown(view, kind);
  const int width = view.luminance.width, height = view.luminance.height;
  std::vector<double> finite;
  for (const double v : what.values) {
    if (std::isfinite(v)) finite.push_back(v);
  }
  if (finite.empty()) finite = {0.0, 1.0};
  const ValueScale scale = round_scale(finite, false, 0.01);
  Canvas canvas(width, height + kLegendHeight);
  canvas.paste(false_colour(what.values, width, scale), 0, 0);
  const double length = std::clamp(width - 2.0 * kMargin, 1.0, 560.0);
  const ColourBar bar{.scale = scale, .quantity = what.quantity, .unit = what.unit};
  draw_colour_bar(canvas, {0.5 * (width - length), height + 8.0}, length, bar, 13.0);
  return canvas.image();
}

Image grey_image(const std::vector<double>& values, int width, int height) {
  Image image(width, height);
  for (std::size_t i = 0; i < values.size(); ++i) {
    image.pixels[i] = Rgb::grey(std::isfinite(values[i]) ? values[i] : 0.0);
  }
  return image;
}

}  // namespace

ViewKind view_kind_named(const std::string& name) {
  if (name == "luminance") return ViewKind::LuminanceImage;
  if (name == "illuminance") return ViewKind::IlluminanceImage;
  if (name == "falsecolor") return ViewKind::FalseColour;
  throw InputError("cannot show '" + name + "'; there are luminance, illuminance and falsecolor");
}

void check_picture_ending(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".png" || ending == ".exr" || ending == ".hdr") return;
  throw InputError("cannot write '" + path.string() + "': the ending must be .png, .exr or .hdr");
}

void place_overview(const LitScene& lit, PerspectiveView& view) {
  const Extent box = lit.extent();
  const Vec3 size = box.size();
  const double across = std::max(std::hypot(size.x, size.y), size.z);
  const double aspect = static_cast<double>(view.height) / view.width;
  const double half =
      std::tan(0.5 * view.horizontal_fov.in_radians()) * std::min(1.0, 1.6 * aspect);
  const double away = 0.42 * across / std::max(half, 0.05);
  view.target = box.middle();
  view.eye = view.target + away * direction_from(Angle::degrees(215.0), Angle::degrees(32.0));
}

Image8 picture_of(const RenderedView& view, ViewKind kind) {
  return kind == ViewKind::LuminanceImage
             ? tone_map(view.luminance, {.curve = ToneCurve::Reinhard, .ev100 = {}, .key = 0.28})
             : with_legend(view, kind);
}

void write_view(const std::filesystem::path& path, const RenderedView& view, ViewKind kind,
                const PictureInfo& info) {
  PictureInfo described = info;
  if (path.extension() == ".png") {
    described.units = kind == ViewKind::IlluminanceImage ? "lx" : "cd/m2";
    return write_png(path, picture_of(view, kind), described);
  }
  if (kind == ViewKind::IlluminanceImage) {
    const int width = view.luminance.width, height = view.luminance.height;
    described.units = "lx";
    return write_luminance_image(path, grey_image(view.illuminance_lux, width, height), described);
  }
  described.units = "cd/m2";
  write_luminance_image(path, view.luminance, described);
}

}  // namespace tenku
