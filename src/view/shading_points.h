/// What a camera's rays meet: the sensors of a picture.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "core/rgb.h"
#include "illuminance/sensor.h"
#include "view/camera.h"
#include "view/pixel_paths.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Sensors behind the pixels of a picture, in the order of the pixels.
///
/// Shape    arrays [point], but `background` [pixel] and `first` [pixel + 1].
struct ShadingPoints {
  Sensors sensors;
  std::vector<std::uint32_t> pixel_index, material, triangle;
  std::vector<std::uint64_t> surface;  ///< equal on one plane of one object
  std::vector<Rgb> weight;             ///< of the point's light in its pixel
  std::vector<double> coverage;        ///< share of the pixel's rays
  std::vector<bool> is_seen_directly;  ///< not by way of a mirror
  std::vector<Rgb> background;         ///< light of the sky in the pixel, cd/m2
  std::vector<std::uint32_t> first;
  int width = 0;
  std::uint64_t rays = 0;
  std::size_t cut_pixels = 0;  ///< where more mirrors follow one another than were followed
  double cut_share = 0.0;      ///< of the light beyond them: the most that a ray of a pixel lacks

  std::pair<int, int> pixel(std::size_t i) const {
    const int p = static_cast<int>(pixel_index[i]);
    return {p % width, p / width};
  }

  /// Calls `visit(point, weight)` for the points within `radius` pixels on the surface of `i`,
  /// itself included.
  template <class Visit>
  void for_each_near(std::size_t i, int radius, const Visit& visit) const {
    const auto [column, row] = pixel(i);
    const int rows = static_cast<int>(background.size()) / width;
    for (int y = std::max(0, row - radius); y <= std::min(rows - 1, row + radius); ++y) {
      for (int x = std::max(0, column - radius); x <= std::min(width - 1, column + radius); ++x) {
        const auto p = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x);
        for (std::uint32_t k = first[p]; k < first[p + 1]; ++k) {
          if (surface[k] == surface[i] && is_seen_directly[k] == is_seen_directly[i]) {
            visit(k, coverage[k]);
          }
        }
      }
    }
  }
};

/// Where the point of several rays of a pixel lies.
enum class PointPlace {
  First,  ///< where the first of them met its surface
  Middle  ///< in the middle of them, if that is on the surface and in sight
};

/// Where the rays of a point met its surface; empty for one that is not seen directly.
/// @param paths  those that made the points
std::vector<Vec3> places_of_rays(const ShadingPoints& points, std::size_t point,
                                 const PixelPaths& paths, const RayVisibility& rays);

/// Four rays a pixel; those on one surface become one point.
ShadingPoints find_shading_points(const PerspectiveCamera& camera, const RayVisibility& rays,
                                  const PixelPaths& paths, PointPlace place, Progress& progress);

}  // namespace tenku
