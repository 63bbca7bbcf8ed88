// Light that ends within a pixel.
#include "view/edge_pixels.h"

#include <gtest/gtest.h>

#include "support/test_scene.h"

namespace tenku {
namespace {

constexpr int kSide = 16;        // pixels, each a metre wide
constexpr double kEdge_m = 0.3;  // light falls east of here

/// A floor seen from above.
struct FloorPicture {
  testing_support::TestScene scene;
  std::unique_ptr<RayVisibility> rays;
  PerspectiveCamera camera{{{0.0, 0.0, 8.0}, {0.0, 0.0, 0.0}, Angle::degrees(90.0), kSide, kSide}};
  Backdrop backdrop;
  MirrorReport mirrors;
  std::unique_ptr<PixelPaths> paths;
  ShadingPoints points;

  FloorPicture() {
    Progress quiet;
    scene.level({-20, -20, 20, 20}, 0.0);
    rays = std::make_unique<RayVisibility>(scene.soup, scene.materials);
    paths = pixel_paths(camera, *rays, backdrop, {}, quiet, mirrors);
    points = find_shading_points(camera, *rays, *paths, PointPlace::Middle, quiet);
  }
};

void light_east_of_edge(const Sensors& places, SensorIlluminance& values) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    values.set_reflected(i, Rgb::grey(places.position[i].x > kEdge_m ? 100.0 : 0.0));
    values.error_lux[i] = 1.0;
  }
}

TEST(EdgePixels, HaveTheMeanOfTheirRays) {
  const FloorPicture picture;
  const ShadingPoints& points = picture.points;
  ASSERT_EQ(points.sensors.size(), std::size_t{kSide * kSide});
  SensorIlluminance light(points.sensors.size());
  light_east_of_edge(points.sensors, light);
  const auto edges = points_on_edges(points, light, 0.02);
  std::size_t asked = 0;
  take_means_of_rays(
      {points, *picture.paths, *picture.rays}, edges,
      [&](const Sensors& places, std::span<const std::uint32_t> point, SensorIlluminance& values) {
        ASSERT_EQ(point.size(), places.size());
        asked = places.size();
        light_east_of_edge(places, values);
      },
      light);
  // The columns on both sides of the edge, and nothing else, are looked at with four rays each.
  EXPECT_EQ(edges.size(), std::size_t{2 * kSide});
  EXPECT_EQ(asked, std::size_t{4 * 2 * kSide});
  for (std::size_t i = 0; i < light.size(); ++i) {
    const int column = points.pixel(i).first;
    const double share = column < kSide / 2 ? 0.0 : column == kSide / 2 ? 0.75 : 1.0;
    EXPECT_DOUBLE_EQ(light.reflected_lux[i], 100.0 * share) << column;
    const bool is_mean = column == kSide / 2 - 1 || column == kSide / 2;
    EXPECT_DOUBLE_EQ(light.error_lux[i], is_mean ? 0.5 : 1.0) << column;
  }
}

}  // namespace
}  // namespace tenku
