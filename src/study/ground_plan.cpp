#include "study/ground_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr double kMostCells = 60000.0;
constexpr int kMostCrowns = 16;  // layers of leaves over the ground

bool is_given(const LitScene& lit, std::uint32_t triangle) {
  return lit.scene().objects[lit.soup().object[triangle]].id == kGroundObjectId;
}

bool is_ground(SurfaceType type) {
  return type == SurfaceType::Ground || type == SurfaceType::Road || type == SurfaceType::Water ||
         type == SurfaceType::Floor;
}

std::vector<PlanFace> building_faces(const LitScene& lit) {
  std::vector<PlanFace> faces;
  for (std::uint32_t t = 0; t < lit.soup().size(); ++t) {
    const SurfaceType type = broad_type(lit.soup(), t);
    if (is_ground(type) || type == SurfaceType::Vegetation || is_given(lit, t)) continue;
    const auto& [a, b, c] = lit.soup().triangles[t];
    const auto& v = lit.soup().vertices;
    faces.push_back({{v[a], v[b], v[c]}, lit.soup().object[t]});
  }
  return faces;
}

}  // namespace

std::optional<Vec3> ground_below(const LitScene& lit, Vec3 from) {
  for (int layer = 0; layer < kMostCrowns; ++layer) {
    const auto hit = lit.rays().first_hit(from, {0.0, 0.0, -1.0});
    if (!hit) return std::nullopt;
    const Vec3 at = from - Vec3{0.0, 0.0, hit->distance_m};
    const SurfaceType type = broad_type(lit.soup(), hit->triangle);
    if (is_ground(type)) return at;
    if (type != SurfaceType::Vegetation) return std::nullopt;
    from = at - Vec3{0.0, 0.0, std::max(1e-3, 2.0 * lit.rays().lift_m())};
  }
  return std::nullopt;
}

void GroundPlan::fill(const SensorIlluminance& values) {
  for (std::size_t i = 0; i < cell.size(); ++i) grid.values[cell[i]] = values.total_lux(i);
}

GroundPlan ground_plan(const LitScene& lit, double spacing_m) {
  const Extent box = lit.extent();
  const double width = box.size().x, height = box.size().y;
  GroundPlan plan;
  PlanGrid& grid = plan.grid;
  grid.cell_m = std::max(spacing_m, std::sqrt(width * height / kMostCells));
  grid.west = box.min.x;
  grid.north = box.max.y;
  grid.columns = std::max(1, static_cast<int>(std::ceil(width / grid.cell_m)));
  grid.rows = std::max(1, static_cast<int>(std::ceil(height / grid.cell_m)));
  const auto cells = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  grid.values.assign(cells, std::numeric_limits<double>::quiet_NaN());
  std::vector<std::optional<Vec3>> ground(cells);
  parallel_for(cells, 256, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      const auto column = static_cast<double>(k % static_cast<std::size_t>(grid.columns));
      const auto row = static_cast<double>(k / static_cast<std::size_t>(grid.columns));
      ground[k] = ground_below(lit, {grid.west + (column + 0.5) * grid.cell_m,
                                     grid.north - (row + 0.5) * grid.cell_m, box.max.z + 1.0});
    }
  });
  for (std::size_t k = 0; k < cells; ++k) {
    if (!ground[k]) continue;
    plan.cell.push_back(k);
    plan.sensors.position.push_back(*ground[k]);
    plan.sensors.normal.push_back(kZenith);
  }
  plan.buildings = building_faces(lit);
  return plan;
}

}  // namespace tenku
