#include "study/mesh_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/extent.h"
#include "reports/mesh_page.h"

namespace tenku {
namespace {

constexpr int kWidth = 620, kHeight = 480;
constexpr double kWhiteShare = 0.05, kOnBox = 1e-4;

/// Whether a face lies on the box about the scene and looks away from it.
bool is_outside(const Extent& box, Vec3 centre, Vec3 normal) {
  const double near = kOnBox * box.longest_side();
  const auto out = [&](double at, double n, double low, double high) {
    return (std::abs(at - low) < near && n < -0.5 && high - low > near) ||
           (std::abs(at - high) < near && n > 0.5 && high - low > near);
  };
  return out(centre.x, normal.x, box.min.x, box.max.x) ||
         out(centre.y, normal.y, box.min.y, box.max.y) ||
         out(centre.z, normal.z, box.min.z, box.max.z);
}

std::vector<MeshTriangle> triangles_of(const MeshLoop& loop) {
  const ElementMesh& mesh = loop.mesh();
  const SidePoints& points = loop.interior().points();
  const SurfaceLight& surfaces = loop.interior().surfaces();
  const InteriorLight& light = loop.light();
  const Extent box = extent_of(mesh.vertices);
  std::vector<MeshTriangle> triangles;
  for (std::size_t s = 0; s < mesh.sides(); ++s) {
    if (is_outside(box, mesh.centre(s / 2), mesh.normal(s))) continue;
    MeshTriangle triangle;
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned place = s % 2 == 0 ? k : 2 - k;
      const std::uint32_t i = points.corner[s][place];
      triangle.corners[k] = mesh.vertices[mesh.elements[s / 2][place]];
      const Rgb lux =
          Rgb::grey(light.points.sun_lux[i] + light.points.sky_lux[i]) + light.corners.lux[i];
      triangle.radiosity[k] = surfaces.emission_lm_m2[s / 2] + surfaces.reflectance[s / 2] * lux;
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

/// What a share of the area of all lit faces is brighter than, lamps left out.
double white_of(const MeshLoop& loop) {
  const ElementMesh& mesh = loop.mesh();
  std::vector<std::pair<double, double>> bright;  // radiosity, area
  double all = 0.0;
  for (std::size_t s = 0; s < mesh.sides(); ++s) {
    const Rgb sent = loop.light().corners.radiosity[s];
    const double most = std::max({sent.r, sent.g, sent.b});
    if (!(most > 0.0) || loop.interior().surfaces().emits(s / 2)) continue;
    bright.emplace_back(most, mesh.area_m2(s / 2));
    all += bright.back().second;
  }
  std::sort(bright.rbegin(), bright.rend());
  double area = 0.0;
  for (const auto& [radiosity, here] : bright) {
    area += here;
    if (area > kWhiteShare * all) return radiosity;
  }
  return 1.0;
}

}  // namespace

std::string mesh_report(const std::string& title, const std::vector<NamedMesh>& meshes) {
  const std::vector<MeshTriangle> first = triangles_of(*meshes.front().second);
  const PerspectiveView view = view_of_all(first, kWidth, kHeight);
  const double white = white_of(*meshes.front().second);
  std::vector<MeshPageColumn> columns;
  for (const auto& [name, loop] : meshes) {
    const InteriorTimes times = loop->times();
    columns.push_back(
        {name,
         {{"elements", fmt::format("{}", loop->mesh().size())},
          {"vertices", fmt::format("{}", loop->mesh().vertices.size())},
          {"meshes solved", fmt::format("{}", loop->rounds().size())},
          {"missed between corners, estimated",
           fmt::format("{:.2g} %", loop->rounds().back().missed_pct)},
          {"form factors and solution",
           fmt::format("{:.2f} s", times.form_factors_s + times.daylight_s + times.solve_s)},
          {"size field", fmt::format("{:.3f} s", loop->size_field_s())},
          {"meshing anew", fmt::format("{:.3f} s", loop->remesh_s())}},
         draw_mesh(triangles_of(*loop), view, white)});
  }
  return mesh_page(title, columns);
}

}  // namespace tenku
