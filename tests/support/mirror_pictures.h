/// Scenes of mirrors as pictures: what beams and single rays make of them.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/random.h"
#include "support/mirror_scene.h"
#include "view/background.h"
#include "view/pixel_paths.h"

namespace tenku::testing_support {

/// The paper's surroundings: the inside of an infinite cube, each face a board of its own colour
/// and width of square. No bilinear blur: squares end at a line.
class CheckeredCube : public Background {
 public:
  static constexpr double kRange = 1000.0;  ///< cd/m2, from black to white squares

  [[nodiscard]] Rgb colour(Vec3 d) const override {
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const double a = axis == 0 ? d.y / x : axis == 1 ? d.x / y : d.x / z;
    const double b = axis == 2 ? d.y / z : axis == 0 ? d.z / x : d.z / y;
    const double squares = 4.0 + 2.0 * axis;
    const bool is_white =
        (static_cast<long>(std::floor(squares * a)) + static_cast<long>(std::floor(squares * b))) %
            2 ==
        0;
    const double dark = 0.1 + 0.1 * axis, light = is_white ? 1.0 : dark;
    const bool is_front = (axis == 0 ? d.x : axis == 1 ? d.y : d.z) > 0.0;
    return kRange * Rgb{light, is_front ? light : 0.7 * light, axis == 2 ? 0.5 * light : light};
  }
};

struct MirrorPicture {
  std::string name;
  MirrorScene scene;
  PerspectiveView view;
  int depth;
};

inline PerspectiveView seen_from(Vec3 eye, Vec3 target, double fov_deg) {
  return {eye, target, Angle::degrees(fov_deg), 1024, 1024};
}

/// The paper's picture: one cuboid of mirrors.
inline MirrorPicture one_cuboid() {
  MirrorPicture made{"one cuboid", {}, seen_from({2.6, -4.1, 2.3}, {0, 0, 0}, 45.0), 4};
  made.scene.box({-1, -0.7, -0.8}, {1, 0.7, 0.8}, 1);
  return made;
}

inline MirrorPicture two_cuboids() {
  MirrorPicture made{
      "two cuboids on a grey floor", {}, seen_from({0.2, -6, 2.5}, {0, 0, 0.6}, 45.0), 6};
  made.scene.box({-1.6, -0.9, 0}, {-0.5, 0.9, 1.8}, 1);
  made.scene.box({0.5, -1.1, 0}, {1.7, 0.7, 1.5}, 1);
  made.scene.rectangle({0, 0, -0.01}, {4, 0, 0}, {0, 4, 0}, 0);
  return made;
}

inline MirrorPicture facing_mirrors() {
  MirrorPicture made{
      "two facing mirrors", {}, seen_from({0.3, -1.6, 0.4}, {-0.5, 1, 0.1}, 70.0), 6};
  made.scene.rectangle({-2, 0, 0}, {0, 2.5, 0}, {0, 0, 1.5}, 1);
  made.scene.rectangle({2, 0, 0}, {0.1, 2.5, 0}, {0.05, 0, 1.5}, 1);
  made.scene.box({-0.4, 0.4, -0.6}, {0.1, 0.8, 0.5}, 0);
  return made;
}

inline MirrorPicture corner_of_mirrors() {
  MirrorPicture made{
      "a corner of three mirrors", {}, seen_from({3, 2.2, 1.9}, {0.5, 0.5, 0.4}, 50.0), 6};
  made.scene.fan({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 1);
  made.scene.fan({{0, 0, 0}, {0, 2, 0}, {0, 2, 2}, {0, 0, 2}}, 1);
  made.scene.fan({{0, 0, 0}, {0, 0, 2}, {2, 0, 2}, {2, 0, 0}}, 1);
  made.scene.box({0.5, 0.7, 0.3}, {0.8, 1.1, 0.6}, 0);
  return made;
}

/// Tilts of panes as fitters leave them.
inline Vec3 tilted(Vec3 side, Vec3 normal, double by) { return side + by * normal; }

/// Four towers about a crossing, each with 50 panes that are tilted by some hundredths of a degree.
inline MirrorPicture towers() {
  MirrorPicture made{
      "four towers of 200 panes", {}, seen_from({2.5, -15, 4}, {-1, 4, 11}, 85.0), 6};
  std::mt19937 chance(1);
  std::uniform_real_distribution<double> tilt(-1e-3, 1e-3);
  const auto facade = [&](Vec3 corner, Vec3 along) {
    const Vec3 normal = cross(along, kZenith);
    for (int c = 0; c < 5; ++c) {
      for (int r = 0; r < 10; ++r) {
        made.scene.rectangle(corner + (2.0 * c + 1.0) * along + (2.2 * r + 2.0) * kZenith,
                             tilted(0.95 * along, normal, tilt(chance)),
                             tilted(1.0 * kZenith, normal, tilt(chance)), 1);
      }
    }
  };
  const auto tower = [&](Vec3 low, Vec3 corner, Vec3 along) {
    made.scene.box(low, low + Vec3{10, 10, 24}, 0);
    facade(corner, along);
  };
  tower({-16, -16, 0}, {-5.9, -16, 0}, {0, 1, 0});
  tower({6, -16, 0}, {5.9, -6, 0}, {0, -1, 0});
  tower({-16, 6, 0}, {-16, 5.9, 0}, {1, 0, 0});
  tower({6, 6, 0}, {6, 5.9, 0}, {1, 0, 0});
  made.scene.rectangle({0, 0, -0.02}, {60, 0, 0}, {0, 60, 0}, 0);
  return made;
}

inline MirrorPicture scattered_cuboids(int count) {
  MirrorPicture made{
      std::to_string(count) + " cuboids", {}, seen_from({-12, -14, 7}, {0, 0, 1}, 40.0), 6};
  std::mt19937 chance(2);
  std::uniform_real_distribution<double> place(-5, 5), side(0.4, 1.6);
  for (int k = 0; k < count; ++k) {
    const Vec3 low{place(chance), place(chance), 0.4 * place(chance)};
    made.scene.box(low, low + Vec3{side(chance), side(chance), side(chance)}, 1);
  }
  return made;
}

/// Glass bent about an upright axis, as `columns` flat facets in each of `rows`.
inline MirrorPicture bent_glass(int columns, int rows) {
  MirrorPicture made{"bent glass of " + std::to_string(columns * rows) + " facets",
                     {},
                     seen_from({0.6, -3.0, 1.9}, {0, 3, 1.6}, 75.0),
                     6};
  const auto at = [&](int c, int r) {
    const double turn = kPi * (0.1 + 0.8 * c / columns);
    return Vec3{4.0 * std::cos(turn), 4.0 * std::sin(turn), 4.0 * r / rows};
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      made.scene.fan({at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1)}, 1);
    }
  }
  made.scene.rectangle({0, 0, -0.01}, {8, 0, 0}, {0, 8, 0}, 0);
  made.scene.box({-0.9, 0.4, 0}, {-0.3, 1.0, 1.4}, 0);
  return made;
}

/// A facade of 100 x 100 panes, each turned by up to 0.01 degrees.
inline MirrorPicture scattered_facade() {
  MirrorPicture made{"facade of 10000 panes", {}, seen_from({0, -90, 30}, {0, 0, 40}, 60.0), 4};
  std::mt19937 chance(4);
  const double scatter = 0.01 * kPi / 180.0;
  std::uniform_real_distribution<double> tilt(-scatter, scatter);
  for (int c = 0; c < 100; ++c) {
    for (int r = 0; r < 100; ++r) {
      made.scene.rectangle({-49.5 + c, 0, 0.5 + 0.8 * r}, {0.49, 0.49 * tilt(chance), 0},
                           {0, 0.39 * tilt(chance), 0.39}, 1);
    }
  }
  return made;
}

/// Material of the panes of `scene_with_pane`.
inline constexpr std::uint32_t kPane = 2;

inline MirrorScene scene_with_pane(double index = 1.52) {
  MirrorScene scene;
  scene.materials.push_back({});
  scene.materials[kPane].index = index;
  scene.materials[kPane].reflectance = {};
  return scene;
}

/// A room of glass in a street: panes before grey walls, one pane before another, a mirror behind
/// panes, panes that the mirror shows.
inline MirrorPicture glass_house() {
  MirrorPicture made{"glass house", scene_with_pane(), seen_from({2.5, -6, 2.2}, {0, 0, 1}, 50.0),
                     4};
  made.scene.box({-1.5, -1.2, 0}, {1.2, 1.4, 2.1}, kPane);
  made.scene.box({-0.6, -0.4, 0}, {0.1, 0.5, 1.1}, 0);
  made.scene.rectangle({-0.2, 1.0, 1.0}, {0.7, 0.1, 0}, {0, 0.05, 0.6}, 1);
  made.scene.rectangle({2.4, -0.3, 1.0}, {0.3, 0.9, 0}, {0, 0, 1.0}, kPane);
  made.scene.box({-3.5, 1.8, 0}, {-2.4, 2.8, 2.6}, 0);
  made.scene.rectangle({0, 0, -0.02}, {8, 0, 0}, {0, 8, 0}, 0);
  return made;
}

inline std::vector<MirrorPicture> mirror_pictures() {
  return {one_cuboid(), two_cuboids(),         facing_mirrors(), corner_of_mirrors(),
          towers(),     scattered_cuboids(33), bent_glass(40, 5)};
}

/// A picture, and what each pixel is made of: equal where all rays of a pixel meet the same.
struct TracedPicture {
  Image image;
  std::vector<std::uint64_t> made_of;
  std::uint64_t rays = 0;
};

/// Surfaces shine by a smooth pattern of their place, so that a wrong place shows.
inline double pattern(Vec3 p) {
  return CheckeredCube::kRange *
         (0.5 + 0.2 * std::sin(3.0 * p.x) + 0.2 * std::sin(2.0 * p.y + 1.0) + 0.1 * std::sin(p.z));
}

inline TracedPicture trace_picture(const PixelPaths& paths, const RayVisibility& rays,
                                   const PerspectiveView& view) {
  TracedPicture made{Image(view.width, view.height), {}, 0};
  made.made_of.resize(made.image.pixels.size());
  PixelPath path;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      Rgb sum{};
      std::uint64_t key = 0, first = 0;
      for (std::size_t s = 0; s < kRayPlaces.size(); ++s) {
        path.clear();
        paths.follow(x, y, s, path);
        std::uint64_t of_ray = path.points.size() + 1000 * (path.background == Rgb{} ? 1 : 2);
        for (const PathPoint& point : path.points) {
          const Material& material = rays.materials()[rays.soup().material[point.triangle]];
          sum = sum + pattern(point.position) * (point.weight * material.reflectance);
          of_ray = mix_rounded(of_ray,
                               {1e4 * point.normal.x, 1e4 * point.normal.y, 1e4 * point.normal.z});
          of_ray = mix_rounded(of_ray, {1e3 * dot(point.normal, point.position)});
        }
        sum = sum + path.background;
        if (s == 0) first = of_ray;
        key = of_ray == first ? first : mix_bits(key + of_ray + 1);
      }
      made.image.at(x, y) = 0.25 * sum;
      made.made_of[static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width) +
                   static_cast<std::size_t>(x)] = key;
    }
  }
  made.rays = path.rays;
  return made;
}

/// How two pictures of one view differ.
struct PictureDifference {
  double differing = 0.0;       ///< share of the pixels, by more than 1e-4 of the range
  double away_from_edge = 0.0;  ///< largest difference where all pixels around show the same, by
                                ///< the range
  double edge_share = 0.0;      ///< of the pixels that have an edge in them or beside them
};

inline PictureDifference difference(const TracedPicture& a, const TracedPicture& reference) {
  PictureDifference found;
  const int w = a.image.width, h = a.image.height;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const auto key = [&](int c, int r) {
        return reference.made_of[static_cast<std::size_t>(std::clamp(r, 0, h - 1)) *
                                     static_cast<std::size_t>(w) +
                                 static_cast<std::size_t>(std::clamp(c, 0, w - 1))];
      };
      bool is_edge = false;
      for (int r = y - 1; r <= y + 1; ++r) {
        for (int c = x - 1; c <= x + 1; ++c) is_edge = is_edge || key(c, r) != key(x, y);
      }
      const Rgb p = a.image.at(x, y), q = reference.image.at(x, y);
      const double off = std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)}) /
                         CheckeredCube::kRange;
      found.differing += off > 1e-4;
      found.edge_share += is_edge;
      if (!is_edge) found.away_from_edge = std::max(found.away_from_edge, off);
    }
  }
  found.differing /= w * h;
  found.edge_share /= w * h;
  return found;
}

}  // namespace tenku::testing_support
