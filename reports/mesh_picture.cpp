#include "reports/mesh_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/extent.h"
#include "view/tone_map.h"

namespace tenku {
namespace {

constexpr Rgb8 kPaper{255, 255, 255}, kFace{238, 241, 245}, kLine{40, 60, 90};
constexpr double kLineWidth = 0.7;  // pixels, to each side
constexpr double kMargin = 12.0;    // pixels about what is shown
constexpr double kEdge = 1e-9;      // of the weights: a point on an edge belongs to both

struct Box {
  int x0, x1, y0, y1;
};

class Drawing {
 public:
  Drawing(const PerspectiveView& view, double white)
      : camera_(view),
        white_(white),
        depth_(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height),
               std::numeric_limits<double>::infinity()),
        pictures_{Image8(view.width, view.height, kPaper),
                  Image8(view.width, view.height, {0, 0, 0})} {}

  void add(const MeshTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    const Vec3 area = cross(b - a, c - a);
    if (!(dot(area, camera_.eye() - a) > 0.0)) return;
    const std::optional<Box> box = box_of(triangle);
    if (!box) return;
    for (int y = box->y0; y <= box->y1; ++y) {
      for (int x = box->x0; x <= box->x1; ++x) draw_pixel(triangle, area, x, y);
    }
  }

  MeshPictures pictures() && { return std::move(pictures_); }

 private:
  /// Nothing where a corner is behind the eye.
  std::optional<Box> box_of(const MeshTriangle& triangle) const {
    Box box{camera_.width(), -1, camera_.height(), -1};
    for (const Vec3 corner : triangle.corners) {
      const auto at = camera_.pixel_of(corner);
      if (!at) return {};
      box.x0 = std::min(box.x0, static_cast<int>(std::floor(at->x)));
      box.x1 = std::max(box.x1, static_cast<int>(std::floor(at->x)));
      box.y0 = std::min(box.y0, static_cast<int>(std::floor(at->y)));
      box.y1 = std::max(box.y1, static_cast<int>(std::floor(at->y)));
    }
    box.x0 = std::max(box.x0, 0), box.y0 = std::max(box.y0, 0);
    box.x1 = std::min(box.x1, camera_.width() - 1);
    box.y1 = std::min(box.y1, camera_.height() - 1);
    return box;
  }

  void draw_pixel(const MeshTriangle& triangle, Vec3 area, int x, int y) {
    const auto& [a, b, c] = triangle.corners;
    const Vec3 ray = camera_.ray(x + 0.5, y + 0.5);
    const double away = dot(area, a - camera_.eye()) / dot(area, ray);
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width()) +
                       static_cast<std::size_t>(x);
    if (!(away > 0.0 && away < depth_[pixel])) return;
    const Vec3 p = camera_.eye() + away * ray;
    const double whole = dot(area, area);
    const std::array<double, 3> weight{dot(cross(c - b, p - b), area) / whole,
                                       dot(cross(a - c, p - c), area) / whole,
                                       dot(cross(b - a, p - a), area) / whole};
    if (*std::min_element(weight.begin(), weight.end()) < -kEdge) return;
    depth_[pixel] = away;
    Rgb light;
    for (std::size_t k = 0; k < 3; ++k) light = light + weight[k] * triangle.radiosity[k];
    pictures_.shaded.at(x, y) = {code(light.r), code(light.g), code(light.b)};
    pictures_.mesh.at(x, y) = is_on_edge(triangle, area, weight, away) ? kLine : kFace;
  }

  std::uint8_t code(double radiosity) const {
    return srgb_code(std::clamp(radiosity / white_, 0.0, 1.0));
  }

  bool is_on_edge(const MeshTriangle& triangle, Vec3 area, const std::array<double, 3>& weight,
                  double away) const {
    const double line = kLineWidth * camera_.footprint_m(away);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge = triangle.corners[(k + 2) % 3] - triangle.corners[(k + 1) % 3];
      if (weight[k] * length(area) / length(edge) < line) return true;
    }
    return false;
  }

  PerspectiveCamera camera_;
  double white_;
  std::vector<double> depth_;
  MeshPictures pictures_;
};

}  // namespace

MeshPictures draw_mesh(const std::vector<MeshTriangle>& triangles, const PerspectiveView& view,
                       double white) {
  Drawing drawing(view, white);
  for (const MeshTriangle& triangle : triangles) drawing.add(triangle);
  return std::move(drawing).pictures();
}

PerspectiveView view_of_all(const std::vector<MeshTriangle>& triangles, int width, int height) {
  const Vec3 backward = normalized(Vec3{-0.35, -0.75, 0.65});
  std::vector<Vec3> seen;
  Extent box;
  for (const MeshTriangle& t : triangles) {
    const auto& [a, b, c] = t.corners;
    if (!(dot(cross(b - a, c - a), backward) > 0.0)) continue;
    for (const Vec3 corner : t.corners) box.add(corner), seen.push_back(corner);
  }
  PerspectiveView view;
  view.width = width;
  view.height = height;
  view.horizontal_fov = Angle::degrees(40.0);
  if (seen.empty()) return view;
  view.target = box.middle();
  const auto shows_all = [&] {
    const PerspectiveCamera camera(view);
    return std::all_of(seen.begin(), seen.end(), [&](Vec3 corner) {
      const auto at = camera.pixel_of(corner);
      return at && at->x > kMargin && at->y > kMargin && at->x < width - kMargin &&
             at->y < height - kMargin;
    });
  };
  constexpr int kMostSteps = 40;  // to seven times the size
  for (int step = 0; step < kMostSteps; ++step) {
    view.eye = view.target + std::pow(1.05, step) * length(box.size()) * backward;
    if (shows_all()) break;
  }
  return view;
}

}  // namespace tenku
