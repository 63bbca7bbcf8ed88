#include "scene/terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "scene/ground_heights.h"
#include "scene/set_on_ground.h"
#include "scene/terrain_reader.h"
#include "scene/thin_grid.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

constexpr double kWallPerRadian = 4.0 / std::numbers::pi;
constexpr double kEarth_m = 6371008.8;  // mean radius
constexpr double kRefraction = 0.13;    // of the curvature, for light along the ground

/// Seen from above, of a point beyond a box.
double distance_beyond(const Extent& box, Vec3 p) {
  return std::hypot(std::max({box.min.x - p.x, p.x - box.max.x, 0.0}),
                    std::max({box.min.y - p.y, p.y - box.max.y, 0.0}));
}

/// What the map's coordinates of an elevation model are called for a scene.
std::string map_of(const Scene& scene) {
  if (!scene.georeference) return "";
  if (!scene.georeference->crs.empty()) return scene.georeference->crs;
  return map_about(scene.georeference->origin);
}

/// An elevation model in the local frame of a scene.
class LocalTerrain {
 public:
  LocalTerrain(RawScene& raw, const fs::path& path, const Extent& city)
      : raw_(raw), path_(path), city_(city), model_(read_elevation_model(path, map_of(raw.scene))) {
    refuse_other_place();
    bring_here();
  }

  HeightGrid grid() const { return {model_.rows, model_.columns, model_.points}; }
  const std::vector<Vec3>& points() const { return model_.points; }

  /// The longest step between neighbours at the corner of the grid, m.
  double step_m() const {
    const Vec3 a = model_.points[0], b = model_.points[1], c = model_.points[model_.columns];
    return std::max(std::hypot(b.x - a.x, b.y - a.y), std::hypot(c.x - a.x, c.y - a.y));
  }

  /// Leaves out what lies over terrain of the city, but for a seam of one pixel.
  void yield_to(const GroundHeights& own) {
    if (!own.is_any()) return;
    const std::size_t rows = model_.rows, columns = model_.columns;
    std::vector<std::uint8_t> is_under(model_.points.size());
    for (std::size_t k = 0; k < is_under.size(); ++k) {
      const Vec3 p = model_.points[k];
      is_under[k] = !(distance_beyond(city_, p) > 0.0) && own.at(p.x, p.y).has_value();
    }
    for (std::size_t y = 1; y + 1 < rows; ++y) {
      for (std::size_t x = 1; x + 1 < columns; ++x) {
        bool is_amid = true;
        for (std::size_t k = 0; k < 9; ++k) {
          is_amid &= is_under[(y + k / 3 - 1) * columns + x + k % 3 - 1] != 0;
        }
        if (is_amid) model_.points[y * columns + x].z = std::nan("");
      }
    }
  }

 private:
  void refuse_other_place() {
    if (!raw_.scene.georeference && !model_.crs.empty()) {
      throw InputError(path_.string() + ": the elevation model is in " + model_.crs +
                       " and the scene has no place; give --crs, or --lat and --lon");
    }
    if (model_.crs.empty() && raw_.scene.georeference) {
      raw_.findings.add({"terrain_without_crs", Severity::Warning, "", path_.filename().string(),
                         "the elevation model names no coordinate reference system",
                         raw_.scene.georeference->crs.empty()
                             ? "taken to be metres about the origin of the scene"
                             : "taken to be in " + raw_.scene.georeference->crs});
    }
  }

  void bring_here() {
    const Scene& scene = raw_.scene;
    const bool has_datum = !scene.georeference || !scene.georeference->crs.empty();
    const double unit = scene.georeference && !scene.map_frame.is_geographic()
                            ? scene.georeference->metres_per_unit
                            : 1.0;
    for (Vec3& p : model_.points) {
      if (std::isnan(p.z)) {
        raw_.findings.add({"terrain_hole", Severity::Warning, "", path_.filename().string(),
                           "pixels of the elevation model have no height", "left open"});
      }
      if (has_datum) p = scene.map_frame.to_local({p.x, p.y, p.z / unit});
    }
    if (!has_datum) level_at_origin();
    for (Vec3& p : model_.points) {
      const double far = distance_beyond(city_, p);
      p.z -= (1.0 - kRefraction) * far * far / (2.0 * kEarth_m);
    }
  }

  /// Heights of a model without a reference system begin where it stands.
  void level_at_origin() {
    const Vec3* nearest = nullptr;
    for (const Vec3& p : model_.points) {
      if (std::isnan(p.z)) continue;
      if (!nearest || std::hypot(p.x, p.y) < std::hypot(nearest->x, nearest->y)) nearest = &p;
    }
    if (!nearest) return;
    const double height = nearest->z;
    for (Vec3& p : model_.points) p.z -= height;
    raw_.findings.add({"terrain_levelled", Severity::Note, "", path_.filename().string(),
                       "the scene does not say how high its origin lies",
                       fmt::format("the terrain was lowered by {:.2f} m, to 0 there", height)});
  }

  RawScene& raw_;
  const fs::path& path_;
  const Extent city_;
  ElevationModel model_;
};

std::uint8_t unnamed_lod(Scene& scene) {
  auto at = std::find(scene.lods.begin(), scene.lods.end(), "");
  if (at == scene.lods.end()) at = scene.lods.insert(at, "");
  return static_cast<std::uint8_t>(at - scene.lods.begin());
}

void append_triangles(RawScene& raw, const std::string& name, const std::vector<Vec3>& points,
                      const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Scene& scene = raw.scene;
  std::vector<std::uint32_t> vertex(points.size(), kNone);
  SurfaceFacts facts;
  facts.type = SurfaceType::Ground;
  facts.object = static_cast<std::uint32_t>(scene.objects.size());
  facts.lod = unnamed_lod(scene);
  for (const auto& triangle : triangles) {
    for (const std::uint32_t corner : triangle) {
      if (vertex[corner] == kNone) {
        vertex[corner] = static_cast<std::uint32_t>(scene.vertices.size());
        scene.vertices.push_back(points[corner]);
      }
      scene.surfaces.vertex.push_back(vertex[corner]);
    }
    end_ring(scene.surfaces);
    end_surface(scene.surfaces, facts);
  }
  scene.objects.push_back({name, "TINRelief"});
  raw.is_building.push_back(0);
  scene.lod_triangles[""] += triangles.size();
}

}  // namespace

double skyline_angle(double tolerance_pct) {
  return kSkylineShare * tolerance_pct / 100.0 / kWallPerRadian;
}

void add_terrain(RawScene& raw, const std::vector<fs::path>& files, const ReadOptions& options,
                 Progress& progress) {
  if (files.empty()) return;
  const Extent city = extent_of_surfaces(raw.scene);
  const double angle = skyline_angle(options.tolerance_pct);
  for (const fs::path& path : files) {
    LocalTerrain terrain(raw, path, city);
    progress.stop_if_cancelled();
    terrain.yield_to(GroundHeights(raw, city));
    const double step = terrain.step_m();
    const auto triangles = thin_grid(terrain.grid(), [&](Vec3 p, std::size_t reach) {
      return angle * std::max(0.0, distance_beyond(city, p) - step * static_cast<double>(reach));
    });
    if (triangles.empty()) throw InputError(path.string() + ": no terrain that could be used");
    append_triangles(raw, path.stem().string(), terrain.points(), triangles);
    progress.stop_if_cancelled();
  }
  raw.scene.has_terrain = true;
  set_on_ground(raw, GroundHeights(raw, city), options.on_terrain);
}

}  // namespace tenku
