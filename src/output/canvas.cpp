#include "output/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "output/stroke_font.h"

namespace tenku {

/// How much of each pixel of a part of the sheet is covered, 0 to 1.
class Canvas::Mask {
 public:
  Mask(double left, double top, double right, double bottom, const Image8& sheet)
      : left_(clipped(std::floor(left), sheet.width)),
        top_(clipped(std::floor(top), sheet.height)),
        right_(clipped(std::ceil(right), sheet.width)),
        bottom_(clipped(std::ceil(bottom), sheet.height)),
        cover_(static_cast<std::size_t>(right_ - left_) *
               static_cast<std::size_t>(bottom_ - top_)) {}

  int left() const { return left_; }
  int top() const { return top_; }
  int right() const { return right_; }
  int bottom() const { return bottom_; }
  float& at(int x, int y) { return cover_[index_of(x, y)]; }
  float at(int x, int y) const { return cover_[index_of(x, y)]; }

  /// Covers the pixels near the segment a-b; a pixel that two segments touch takes the larger.
  void add_segment(PixelPosition a, PixelPosition b, double width) {
    const double reach = 0.5 * width + 1.0;
    const int x0 = std::max(left_, static_cast<int>(std::floor(std::min(a.x, b.x) - reach)));
    const int x1 = std::min(right_, static_cast<int>(std::ceil(std::max(a.x, b.x) + reach)));
    const int y0 = std::max(top_, static_cast<int>(std::floor(std::min(a.y, b.y) - reach)));
    const int y1 = std::min(bottom_, static_cast<int>(std::ceil(std::max(a.y, b.y) + reach)));
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const double cover = cover_at({x + 0.5, y + 0.5}, a, b, width);
        at(x, y) = std::max(at(x, y), static_cast<float>(cover));
      }
    }
  }

 private:
  static int clipped(double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  }

  std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(right_ - left_) +
           static_cast<std::size_t>(x - left_);
  }

  // A line thinner than a pixel is drawn a pixel wide and fainter.
  static double cover_at(PixelPosition p, PixelPosition a, PixelPosition b, double width) {
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    const double along =
        square > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
    const double distance = std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
    const double drawn = std::max(width, 1.0);
    return std::min(1.0, width) * std::clamp(0.5 * drawn + 0.5 - distance, 0.0, 1.0);
  }

  int left_, top_, right_, bottom_;
  std::vector<float> cover_;
};

namespace {

struct Bounds {
  double left = 1e30, top = 1e30, right = -1e30, bottom = -1e30;

  void add(PixelPosition p) {
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
};

Bounds bounds_of(std::span<const PixelPosition> points) {
  Bounds bounds;
  for (const PixelPosition p : points) bounds.add(p);
  return bounds;
}

std::vector<double> crossings_of(std::span<const PixelPosition> ring, double y) {
  std::vector<double> xs;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PixelPosition a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y <= y) == (b.y <= y)) continue;
    xs.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::sort(xs.begin(), xs.end());
  return xs;
}

std::uint8_t mixed(std::uint8_t under, std::uint8_t over, double cover) {
  return static_cast<std::uint8_t>(std::lround(under + cover * (over - under)));
}

double stroke_width(const TextStyle& style) { return (style.bold ? 0.115 : 0.078) * style.size; }

double shift_of(TextAlign align, double width) {
  if (align == TextAlign::Centre) return -0.5 * width;
  return align == TextAlign::Right ? -width : 0.0;
}

}  // namespace

Canvas::Canvas(int width, int height, Rgb8 background) : image_(width, height, background) {}

void Canvas::blend(const Mask& mask, Rgb8 colour, double opacity) {
  for (int y = mask.top(); y < mask.bottom(); ++y) {
    for (int x = mask.left(); x < mask.right(); ++x) {
      const double cover = opacity * mask.at(x, y);
      if (!(cover > 0.0)) continue;
      Rgb8& p = image_.at(x, y);
      p = {mixed(p.r, colour.r, cover), mixed(p.g, colour.g, cover), mixed(p.b, colour.b, cover)};
    }
  }
}

void Canvas::fill(std::span<const PixelPosition> ring, Rgb8 colour, double opacity) {
  constexpr int kLines = 5;  // scan lines a pixel row; across, the cover is exact
  const Bounds bounds = bounds_of(ring);
  Mask mask(bounds.left, bounds.top, bounds.right, bounds.bottom, image_);
  for (int line = mask.top() * kLines; line < mask.bottom() * kLines; ++line) {
    const std::vector<double> xs = crossings_of(ring, (line + 0.5) / kLines);
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      const int first = std::max(mask.left(), static_cast<int>(std::floor(xs[i])));
      const int last = std::min(mask.right(), static_cast<int>(std::ceil(xs[i + 1])));
      for (int x = first; x < last; ++x) {
        const double part = std::min(xs[i + 1], x + 1.0) - std::max(xs[i], static_cast<double>(x));
        mask.at(x, line / kLines) += static_cast<float>(part / kLines);
      }
    }
  }
  blend(mask, colour, opacity);
}

void Canvas::fill_box(PixelPosition from, PixelPosition to, Rgb8 colour, double opacity) {
  const PixelPosition ring[] = {from, {to.x, from.y}, to, {from.x, to.y}};
  fill(ring, colour, opacity);
}

void Canvas::line(std::span<const PixelPosition> points, const LineStyle& style) {
  const Bounds b = bounds_of(points);
  const double reach = 0.5 * style.width + 1.0;
  Mask mask(b.left - reach, b.top - reach, b.right + reach, b.bottom + reach, image_);
  if (points.size() == 1) mask.add_segment(points[0], points[0], style.width);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    mask.add_segment(points[i], points[i + 1], style.width);
  }
  blend(mask, style.colour, style.opacity);
}

void Canvas::box(PixelPosition from, PixelPosition to, const LineStyle& style) {
  const PixelPosition ring[] = {from, {to.x, from.y}, to, {from.x, to.y}, from};
  line(ring, style);
}

void Canvas::text(PixelPosition place, std::string_view text, const TextStyle& style) {
  PenText pen = pen_text(text);
  const double width = stroke_width(style),
               left = place.x + shift_of(style.align, pen.width * style.size);
  Bounds b;
  for (PenStroke& stroke : pen.strokes) {
    for (PixelPosition& p : stroke.points) {
      p = {left + p.x * style.size, place.y + p.y * style.size};
      b.add(p);
    }
  }
  if (pen.strokes.empty()) return;
  const double reach = width + 1.0;
  Mask mask(b.left - reach, b.top - reach, b.right + reach, b.bottom + reach, image_);
  for (const PenStroke& stroke : pen.strokes) {
    const auto& points = stroke.points;
    if (points.size() == 1) mask.add_segment(points[0], points[0], 1.35 * width);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      mask.add_segment(points[i], points[i + 1], width);
    }
  }
  blend(mask, style.colour, 1.0);
}

double Canvas::width_of(std::string_view text, const TextStyle& style) {
  return pen_text(text).width * style.size;
}

void Canvas::paste(const Image8& picture, int column, int row) {
  for (int y = std::max(0, -row); y < std::min(picture.height, image_.height - row); ++y) {
    for (int x = std::max(0, -column); x < std::min(picture.width, image_.width - column); ++x) {
      image_.at(column + x, row + y) = picture.at(x, y);
    }
  }
}

std::vector<std::string_view> wrapped(std::string_view text, double width, const TextStyle& style) {
  std::vector<std::string_view> lines;
  std::size_t begin = 0, good = 0;
  for (std::size_t at = 0; at <= text.size(); ++at) {
    if (at < text.size() && text[at] != ' ') continue;
    const bool fits = Canvas::width_of(text.substr(begin, at - begin), style) <= width;
    if (!fits && good > begin) {
      lines.push_back(text.substr(begin, good - begin));
      begin = good + 1;
    }
    good = at;
  }
  if (begin < text.size()) lines.push_back(text.substr(begin));
  return lines;
}

}  // namespace tenku
