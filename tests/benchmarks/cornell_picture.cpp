// Writes a picture of the Cornell box as numbers: by paths, for tests to compare with, or by
// radiosity.
//
//   cornell_picture SCENE_FOLDER WIDTH paths PATHS_A_PIXEL OUT.csv
//   cornell_picture SCENE_FOLDER WIDTH radiosity TOLERANCE_PCT OUT.csv [MESH_TOLERANCE_PCT]
//
// One line a pixel, row by row from the top left: cd/m2 in red, green and blue, and the standard
// error of the channel known worst in percent, of paths from 16 scrambles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>

#include "core/parallel.h"
#include "support/cornell_view.h"
#include "support/lamp_paths.h"
#include "view/shading_points.h"

namespace tenku {
namespace {

constexpr std::size_t kScrambles = 16;

struct PixelLight {
  Rgb mean{};
  double error_pct = 0.0;
};

PixelLight light_of_pixel(const PerspectiveCamera& camera, const RayVisibility& rays,
                          const testing_support::LampPaths& paths, int column, int row,
                          std::uint32_t samples) {
  std::array<Rgb, kScrambles> light{};
  std::uint64_t address =
      mix_bits(static_cast<std::uint64_t>(row) * 65536 + static_cast<std::uint64_t>(column));
  for (const auto& [dx, dy] : kRayPlaces) {
    const Vec3 way = camera.ray(column + dx, row + dy);
    const auto hit = rays.first_hit(camera.eye(), way);
    if (!hit) continue;
    const Vec3 face = rays.normal(hit->triangle);
    const Vec3 normal = dot(face, way) < 0.0 ? face : -face;
    const Vec3 at = rays.on_plane(hit->triangle, camera.eye() + hit->distance_m * way);
    for (std::size_t s = 0; s < kScrambles; ++s) {
      address = mix_bits(address + 1);
      const Rgb lux = paths.illuminance(at, normal, address, samples);
      const Rgb leaving = paths.emission(hit->triangle) + paths.reflectance(hit->triangle) * lux;
      light[s] = light[s] + (1.0 / (kPi * kRayPlaces.size())) * leaving;
    }
  }
  PixelLight pixel;
  for (const Rgb& one : light) pixel.mean = pixel.mean + (1.0 / kScrambles) * one;
  if (!(luminance_of(pixel.mean) > 0.0)) return pixel;
  for (double Rgb::*channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
    double squares = 0.0;
    for (const Rgb& one : light) squares += std::pow(one.*channel / pixel.mean.*channel - 1.0, 2);
    const double error_pct = 100.0 * std::sqrt(squares / (kScrambles * (kScrambles - 1.0)));
    pixel.error_pct = std::max(pixel.error_pct, error_pct);
  }
  return pixel;
}

std::vector<PixelLight> by_paths(const LitScene& lit, int width, int paths_a_pixel) {
  const PerspectiveCamera camera(testing_support::cornell_view(width));
  const testing_support::LampPaths paths(lit.rays());
  const auto samples =
      static_cast<std::uint32_t>(paths_a_pixel / static_cast<int>(kRayPlaces.size() * kScrambles));
  const auto side = static_cast<std::size_t>(width);
  std::vector<PixelLight> picture(side * side);
  parallel_for(picture.size(), 16, [&](IndexRange range) {
    for (std::size_t p = range.begin; p < range.end; ++p) {
      picture[p] = light_of_pixel(camera, lit.rays(), paths, static_cast<int>(p % side),
                                  static_cast<int>(p / side), samples);
    }
  });
  return picture;
}

std::vector<PixelLight> by_radiosity(const LitScene& lit, int width, double tolerance_pct,
                                     double mesh_tolerance_pct) {
  std::vector<PixelLight> picture;
  const RenderedView view =
      testing_support::cornell_by_radiosity(lit, width, tolerance_pct, mesh_tolerance_pct);
  for (const Rgb& pixel : view.luminance.pixels) picture.push_back({pixel, 0.0});
  return picture;
}

void write_picture(const std::vector<PixelLight>& picture, const std::string& out) {
  std::ofstream file(out);
  file << "red,green,blue,error_pct\n";
  for (const PixelLight& p : picture) {
    file << fmt::format("{:.4g},{:.4g},{:.4g},{:.2g}\n", p.mean.r, p.mean.g, p.mean.b, p.error_pct);
  }
}

}  // namespace
}  // namespace tenku

int main(int argc, char** argv) {
  if (argc < 6) {
    std::cerr << "cornell_picture SCENE_FOLDER WIDTH paths|radiosity PATHS|TOLERANCE OUT.csv "
                 "[MESH_TOLERANCE]\n";
    return 2;
  }
  const tenku::LitScene lit = tenku::testing_support::cornell_box(argv[1]);
  const int width = std::stoi(argv[2]);
  tenku::write_picture(
      std::string(argv[3]) == "paths"
          ? tenku::by_paths(lit, width, std::stoi(argv[4]))
          : tenku::by_radiosity(lit, width, std::stod(argv[4]), std::stod(argv[argc > 6 ? 6 : 4])),
      argv[5]);
}
