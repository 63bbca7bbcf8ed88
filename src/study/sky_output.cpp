#include "study/sky_output.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "output/canvas.h"
#include "output/image_writer.h"
#include "output/map_furniture.h"
#include "view/false_colour.h"
#include "view/value_scale.h"

namespace tenku {
namespace {

constexpr double kMargin = 30.0;  // pixels about the plan, for the letters of the compass
constexpr double kLegendHeight = 84.0;

/// Direction of a place on the plan, `x` to the east and `y` to the north, horizon at radius 1.
Vec3 direction_on_plan(double x, double y) {
  const Angle from_zenith = Angle::degrees(90.0 * std::hypot(x, y));
  return direction_from(Angle::radians(std::atan2(x, y)), Angle::degrees(90.0) - from_zenith);
}

std::vector<double> plan_values(const Sky& sky, int diameter) {
  std::vector<double> values;
  for (int row = 0; row < diameter; ++row) {
    for (int column = 0; column < diameter; ++column) {
      const double x = 2.0 * (column + 0.5) / diameter - 1.0;
      const double y = 1.0 - 2.0 * (row + 0.5) / diameter;
      values.push_back(std::hypot(x, y) <= 1.0 ? sky.luminance(direction_on_plan(x, y)).value()
                                               : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return values;
}

ValueScale scale_of(const std::vector<double>& values) {
  std::vector<double> finite;
  for (const double v : values) {
    if (std::isfinite(v)) finite.push_back(v);
  }
  return round_scale(finite);
}

/// Where a direction above the horizon lies on the sheet.
PixelPosition place_of(Vec3 direction, double diameter) {
  const double from_zenith = 1.0 - altitude_of(direction).in_degrees() / 90.0;
  const double azimuth = azimuth_of(direction).in_radians(), half = 0.5 * diameter;
  return {kMargin + half + half * from_zenith * std::sin(azimuth),
          kMargin + half - half * from_zenith * std::cos(azimuth)};
}

void draw_circle(Canvas& canvas, PixelPosition centre, double radius, const LineStyle& style) {
  std::vector<PixelPosition> ring;
  for (int k = 0; k <= 180; ++k) {
    const double angle = 2.0 * kPi * k / 180.0;
    ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  canvas.line(ring, style);
}

void draw_compass(Canvas& canvas, double diameter) {
  const double middle = kMargin + 0.5 * diameter;
  for (const double altitude : {0.0, 30.0, 60.0}) {
    draw_circle(canvas, {middle, middle}, 0.5 * diameter * (1.0 - altitude / 90.0),
                {.width = 1.0, .colour = {255, 255, 255}, .opacity = 0.5});
  }
  const TextStyle style{16.0, {32, 36, 40}, true, TextAlign::Centre};
  canvas.text({middle, kMargin - 9.0}, "N", style);
  canvas.text({middle, kMargin + diameter + 21.0}, "S", style);
  canvas.text({0.5 * kMargin, middle + 6.0}, "W", style);
  canvas.text({1.5 * kMargin + diameter, middle + 6.0}, "E", style);
}

void check_sky(const Sky& sky) {
  if (!sky.model) throw InputError("there is no sky to draw: the sky is 'none' or it is night");
}

}  // namespace

FieldMesh sky_mesh(const Sky& sky, const SkyPartition& partition) {
  check_sky(sky);
  FieldMesh mesh;
  FieldValues luminance{"luminance_cd_m2", {}}, solid_angle{"solid_angle_sr", {}},
      illuminance{"illuminance_lux", {}};
  for (const SkyElement& element : partition.elements) {
    std::vector<std::uint32_t> corners;
    for (const Vec3 corner : outline(element.cell)) {
      corners.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      mesh.points.push_back(corner);
    }
    mesh.add_polygon(corners);
    luminance.values.push_back(element.luminance.value());
    solid_angle.values.push_back(element.solid_angle);
    illuminance.values.push_back(element.illuminance_vector.z);
  }
  mesh.cell_values = {std::move(luminance), std::move(solid_angle), std::move(illuminance)};
  mesh.texts = {{"sky", {sky.description}}, {"partition", {partition.description}}};
  return mesh;
}

Image sky_panorama(const Sky& sky, int height) {
  check_sky(sky);
  Image image(2 * height, height);
  for (int row = 0; 2 * row < height; ++row) {
    const Angle altitude = Angle::degrees(90.0 - 180.0 * (row + 0.5) / height);
    for (int column = 0; column < image.width; ++column) {
      const Angle azimuth = Angle::degrees(360.0 * (column + 0.5) / image.width - 180.0);
      image.at(column, row) = sky.model->colour(direction_from(azimuth, altitude));
    }
  }
  return image;
}

Image8 sky_plan(const Sky& sky, int diameter) {
  check_sky(sky);
  const std::vector<double> values = plan_values(sky, diameter);
  const ValueScale scale = scale_of(values);
  const int side = diameter + static_cast<int>(2.0 * kMargin);
  Canvas canvas(side, side + static_cast<int>(kLegendHeight));
  Image8 dome = false_colour(values, diameter, scale);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) dome.pixels[i] = {255, 255, 255};
  }
  canvas.paste(dome, static_cast<int>(kMargin), static_cast<int>(kMargin));
  draw_compass(canvas, diameter);
  if (sky.sun.normal_illuminance.value() > 0.0 && sky.sun.direction.z > 0.0) {
    draw_circle(canvas, place_of(sky.sun.direction, diameter), 7.0,
                {.width = 2.0, .colour = {200, 30, 30}});
  }
  draw_colour_bar(canvas, {kMargin, side + 6.0}, diameter,
                  {.scale = scale, .quantity = "Luminance of the sky", .unit = "cd/m2"});
  return canvas.image();
}

bool is_sky_output(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".vtp" || ending == ".hdr" || ending == ".exr" || ending == ".png";
}

void write_sky(const std::filesystem::path& path, const Sky& sky, const SkyPartition& partition) {
  if (!is_sky_output(path)) {
    throw InputError("cannot write '" + path.string() +
                     "': the ending must be .csv, .vtp, .hdr, .exr or .png");
  }
  const PictureInfo info{.title = sky.description, .time = {}, .units = "cd/m2"};
  if (path.extension() == ".vtp") {
    write_vtp(path, sky_mesh(sky, partition));
  } else if (path.extension() == ".png") {
    write_png(path, sky_plan(sky), info);
  } else {
    write_luminance_image(path, sky_panorama(sky), info);
  }
}

}  // namespace tenku
