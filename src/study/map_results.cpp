#include "study/map_results.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "study/surface_means.h"

namespace tenku {
namespace {

constexpr double kMostCells = 1e8;
constexpr double kOutside = -1e-9;  // of a triangle, so that no square falls between two

struct Squares {
  double west, north, cell;
  std::size_t rows, columns;

  Squares(const SensorGrid& grid, double cell_m) : cell(cell_m) {
    Extent box;
    for (const auto& part : grid.corner_point) {
      for (const Vec3 p : part) box.add(p);
    }
    const Vec3 size = box.size();
    cell = std::max(cell, std::sqrt(size.x * size.y / kMostCells));
    west = cell * std::floor(box.min.x / cell);
    north = cell * std::ceil(box.max.y / cell);
    columns = 1 + static_cast<std::size_t>((box.max.x - west) / cell);
    rows = 1 + static_cast<std::size_t>((north - box.min.y) / cell);
  }
  double x(std::size_t column) const { return west + (static_cast<double>(column) + 0.5) * cell; }
  double y(std::size_t row) const { return north - (static_cast<double>(row) + 0.5) * cell; }
  /// The first and one beyond the last of `count` squares whose middles are between, by steps from
  /// an edge of the map.
  std::pair<std::size_t, std::size_t> between(double from, double to, std::size_t count) const {
    const auto at = [&](double v) {
      return static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(count)));
    };
    return {at(std::ceil(from / cell - 0.5 - 1e-9)), at(std::floor(to / cell - 0.5 + 1e-9) + 1.0)};
  }
};

/// A triangle of the grid from above, with the values at its corners.
class TopTriangle {
 public:
  TopTriangle(const std::array<Vec3, 3>& corner) : a_(corner[0]) {
    u_ = corner[1] - a_, v_ = corner[2] - a_;
    area_ = u_.x * v_.y - u_.y * v_.x;
  }
  bool is_upright() const { return !(std::abs(area_) > 1e-12 * dot(u_, u_)); }
  /// Shares of the corners at a place; none beside the triangle.
  std::optional<std::array<double, 3>> shares(double x, double y) const {
    const double px = x - a_.x, py = y - a_.y;
    const double s = (px * v_.y - py * v_.x) / area_, t = (u_.x * py - u_.y * px) / area_;
    if (!(s >= kOutside && t >= kOutside && s + t <= 1.0 - kOutside)) return std::nullopt;
    return std::array<double, 3>{1.0 - s - t, s, t};
  }

 private:
  Vec3 a_, u_, v_;
  double area_;
};

/// The map's own place of squares, and what it is called.
void place(const LitScene& lit, double west, double north, double cell, MapRaster& raster) {
  const Scene& scene = lit.scene();
  const bool is_geographic = scene.map_frame.is_geographic();
  const auto on_map = [&](double x, double y) {
    return is_geographic ? Vec3{x, y, 0.0} : scene.map_frame.to_file({x, y, 0.0});
  };
  const Vec3 o = on_map(west, north);
  const Vec3 e = on_map(west + cell, north) - o, s = on_map(west, north - cell) - o;
  raster.to_map = {o.x, e.x, s.x, o.y, e.y, s.y};
  raster.crs = is_geographic ? map_about(scene.georeference->origin) : map_crs(lit);
}

MapLayer::Polygon polygon_of(const Scene& scene, std::size_t s) {
  const Surfaces& surfaces = scene.surfaces;
  MapLayer::Polygon polygon;
  for (std::uint32_t r = surfaces.first_ring[s]; r < surfaces.first_ring[s + 1]; ++r) {
    MapLayer::Ring ring;
    for (const std::uint32_t v : surfaces.ring(r)) {
      ring.push_back(scene.map_frame.to_file(scene.vertices[v]));
    }
    polygon.push_back(std::move(ring));
  }
  return polygon;
}

std::vector<double> numbers(const LuxValues& values) { return {values.begin(), values.end()}; }

MapLayer layer_named(const char* name) { return {name, {kLuxNames.begin(), kLuxNames.end()}, {}}; }

}  // namespace

std::string map_crs(const LitScene& lit) {
  return lit.scene().georeference ? lit.scene().georeference->crs : std::string();
}

MapRaster raster_of_grid(const LitScene& lit, const SensorGrid& grid,
                         const SensorIlluminance& values, double cell_m) {
  const Squares squares(grid, cell_m);
  MapRaster raster;
  raster.rows = squares.rows, raster.columns = squares.columns;
  place(lit, squares.west, squares.north, squares.cell, raster);
  const std::size_t cells = raster.rows * raster.columns;
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (const char* name : kLuxNames) {
    const bool is_lux = std::string_view(name).ends_with("_lux");
    raster.bands.push_back({name, is_lux ? "lx" : "", std::vector<float>(cells, none)});
  }
  std::vector<float> height(cells, -std::numeric_limits<float>::infinity());
  for (std::size_t part = 0; part < grid.corner_point.size(); ++part) {
    const auto& corner = grid.corner_point[part];
    const TopTriangle top(corner);
    if (top.is_upright()) continue;
    Extent box;
    for (const Vec3 p : corner) box.add(p);
    const auto columns =
        squares.between(box.min.x - squares.west, box.max.x - squares.west, raster.columns);
    const auto rows =
        squares.between(squares.north - box.max.y, squares.north - box.min.y, raster.rows);
    std::array<LuxValues, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = lux_values(values, grid.corner_sensor[part][k]);
    for (std::size_t row = rows.first; row < rows.second; ++row) {
      for (std::size_t column = columns.first; column < columns.second; ++column) {
        const auto share = top.shares(squares.x(column), squares.y(row));
        if (!share) continue;
        const auto& [a, b, c] = *share;
        const auto z = static_cast<float>(a * corner[0].z + b * corner[1].z + c * corner[2].z);
        const std::size_t cell = row * raster.columns + column;
        if (!(z > height[cell])) continue;
        height[cell] = z;
        for (std::size_t k = 0; k < kLuxValues; ++k) {
          raster.bands[k].values[cell] =
              static_cast<float>(a * at[0][k] + b * at[1][k] + c * at[2][k]);
        }
      }
    }
  }
  return raster;
}

MapRaster raster_of_squares(const LitScene& lit, const PlanGrid& grid) {
  MapRaster raster;
  raster.rows = static_cast<std::size_t>(grid.rows);
  raster.columns = static_cast<std::size_t>(grid.columns);
  place(lit, grid.west, grid.north, grid.cell_m, raster);
  return raster;
}

std::vector<MapLayer> layers_of_grid(const LitScene& lit, const SensorGrid& grid,
                                     const SensorIlluminance& values) {
  const Scene& scene = lit.scene();
  const Surfaces& surfaces = scene.surfaces;
  const SurfaceMeans means = surface_means(scene, grid, values);
  MapLayer faces = layer_named("surfaces"), buildings = layer_named("buildings");
  // Ground surfaces of an object; where it has none, its roofs.
  std::vector<std::vector<std::size_t>> ground(scene.objects.size()), roof(scene.objects.size());
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const std::uint32_t object = surfaces.object[s];
    if (!std::isnan(means.of_surfaces[s][0])) {
      faces.features.push_back({scene.objects[object].id,
                                std::string(name_of(surfaces.type[s])),
                                {polygon_of(scene, s)},
                                numbers(means.of_surfaces[s])});
    }
    if (surfaces.type[s] == SurfaceType::Ground) ground[object].push_back(s);
    if (surfaces.type[s] == SurfaceType::Roof) roof[object].push_back(s);
  }
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    if (roof[k].empty() || std::isnan(means.of_objects[k][0])) continue;
    MapLayer::Feature one{
        scene.objects[k].id, scene.objects[k].type, {}, numbers(means.of_objects[k])};
    for (const std::size_t s : ground[k].empty() ? roof[k] : ground[k]) {
      one.outline.push_back(polygon_of(scene, s));
    }
    buildings.features.push_back(std::move(one));
  }
  return {std::move(faces), std::move(buildings)};
}

}  // namespace tenku
