#include "output/map_furniture.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace tenku {
namespace {

constexpr Rgb8 kInk{32, 36, 40};

// Largest 1, 2 or 5 times a power of ten that is at most `value`.
double round_down_125(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= value * (1.0 + 1e-12)) return digit * power;
  }
  return power;
}

std::string length_text(double metres) {
  return metres >= 1000.0 ? number_text(metres / 1000.0) + " km" : number_text(metres) + " m";
}

void draw_ticks(Canvas& canvas, PixelPosition foot, double length, const ColourBar& bar,
                double text_size) {
  const TextStyle style{text_size, kInk, false, TextAlign::Centre};
  double free_from = -1e9;
  for (const double tick : bar.scale.ticks()) {
    const double x = foot.x + length * bar.scale.position_of(tick);
    const PixelPosition mark[] = {{x, foot.y}, {x, foot.y + 5.0}};
    canvas.line(mark, {1.0, kInk});
    const std::string label = number_text(tick);
    const double half = 0.5 * Canvas::width_of(label, style);
    if (x - half < free_from) continue;
    canvas.text({x, foot.y + 8.0 + 0.75 * text_size}, label, style);
    free_from = x + half + 0.5 * text_size;
  }
}

}  // namespace

void draw_colour_bar(Canvas& canvas, PixelPosition place, double length, const ColourBar& bar,
                     double text_size) {
  const double top = place.y + 1.5 * text_size, bottom = top + 16.0;
  const std::string heading = std::string(bar.quantity) + " (" + std::string(bar.unit) + ")" +
                              (bar.scale.logarithmic ? ", logarithmic" : "");
  canvas.text({place.x, place.y + 0.8 * text_size}, heading, {text_size, kInk, true});
  const int steps = static_cast<int>(length);
  for (int i = 0; i < steps; ++i) {
    const Rgb8 colour = colour_at(bar.map, (i + 0.5) / steps);
    const double x = place.x + length * i / steps;
    canvas.fill_box({x, top}, {place.x + length * (i + 1) / steps, bottom}, colour);
  }
  canvas.box({place.x, top}, {place.x + length, bottom}, {1.0, kInk});
  draw_ticks(canvas, {place.x, bottom}, length, bar, text_size);
}

double draw_scale_bar(Canvas& canvas, PixelPosition place, double longest, double metres_per_pixel,
                      double text_size) {
  const double metres = round_down_125(longest * metres_per_pixel);
  const double length = metres / metres_per_pixel;
  const double bottom = place.y + 7.0;
  canvas.fill_box(place, {place.x + length, bottom}, {255, 255, 255});
  canvas.fill_box(place, {place.x + 0.5 * length, bottom}, kInk);
  canvas.box(place, {place.x + length, bottom}, {1.2, kInk});
  const double baseline = place.y - 0.45 * text_size;
  canvas.text({place.x, baseline}, "0", {text_size, kInk, false, TextAlign::Centre});
  canvas.text({place.x + length, baseline}, length_text(metres),
              {text_size, kInk, false, TextAlign::Centre});
  return metres;
}

void draw_north_arrow(Canvas& canvas, PixelPosition foot, double height) {
  const double half = 0.2 * height, tip = foot.y - 0.66 * height;
  const PixelPosition left[] = {
      {foot.x, tip}, {foot.x - half, foot.y}, {foot.x, foot.y - 0.5 * half}};
  const PixelPosition right[] = {
      {foot.x, tip}, {foot.x + half, foot.y}, {foot.x, foot.y - 0.5 * half}};
  canvas.fill(left, kInk);
  canvas.fill(right, {255, 255, 255});
  const PixelPosition outline[] = {right[0], right[1], right[2], right[0]};
  canvas.line(outline, {1.0, kInk});
  canvas.text({foot.x, tip - 0.09 * height}, "N", {0.34 * height, kInk, true, TextAlign::Centre});
}

}  // namespace tenku
