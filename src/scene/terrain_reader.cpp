#include "scene/terrain_reader.h"

#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "scene/elevation_model.h"
#include "scene/georeference.h"

namespace tenku {
namespace {

// Two triangles each; more than that no scene of ours has been lit with.
constexpr std::size_t kMostPixels = 4'000'000;

const ElevationCodec& elevation_codec() {
  static const auto& codec = dynamic_cast<const ElevationCodec&>(load_plugin("terrain"));
  return codec;
}

void add_triangle(Scene& scene, const std::array<std::uint32_t, 3>& corners) {
  for (const std::uint32_t corner : corners) scene.surfaces.vertex.push_back(corner);
  end_ring(scene.surfaces);
  SurfaceFacts facts;
  facts.type = SurfaceType::Ground;
  end_surface(scene.surfaces, facts);
}

/// The pixels that have heights, as vertices; kNone for the others.
std::vector<std::uint32_t> add_vertices(RawScene& raw, const ElevationModel& model,
                                        double metres_per_unit, const std::string& file) {
  std::vector<std::uint32_t> vertex(model.points.size(), kNone);
  for (std::size_t k = 0; k < model.points.size(); ++k) {
    Vec3 p = model.points[k];
    if (std::isnan(p.z)) {
      raw.findings.add({"terrain_hole", Severity::Warning, "", file,
                        "pixels of the elevation model have no height", "left open"});
      continue;
    }
    p.z /= metres_per_unit;
    vertex[k] = static_cast<std::uint32_t>(raw.scene.vertices.size());
    raw.scene.vertices.push_back(p);
  }
  return vertex;
}

/// Seen from above counter-clockwise, whichever way the rows run.
void add_cells(Scene& scene, const ElevationModel& model,
               const std::vector<std::uint32_t>& vertex) {
  const std::size_t n = model.columns;
  const Vec3 o = model.points[0], e = model.points[1] - o, s = model.points[n] - o;
  const bool runs_south = e.x * s.y - e.y * s.x < 0.0;
  for (std::size_t k = 0; k + n < model.points.size(); ++k) {
    if (k % n == n - 1) continue;
    const std::uint32_t a = vertex[k], b = vertex[k + (runs_south ? n : 1)];
    const std::uint32_t c = vertex[k + n + 1], d = vertex[k + (runs_south ? 1 : n)];
    if (a == kNone || b == kNone || c == kNone || d == kNone) continue;
    add_triangle(scene, {a, b, c});
    add_triangle(scene, {a, c, d});
  }
}

}  // namespace

ElevationModel read_elevation_model(const std::filesystem::path& path, const std::string& crs) {
  ElevationModel model = elevation_codec().read(path, crs);
  if (model.rows < 2 || model.columns < 2) {
    throw InputError(path.string() + ": an elevation model has two rows and two columns or more");
  }
  return model;
}

RawScene read_terrain(const std::filesystem::path& path, const std::string& crs,
                      Progress& progress) {
  const ElevationModel model = read_elevation_model(path, crs);
  progress.stop_if_cancelled();
  if (model.points.size() > kMostPixels) {
    throw InputError(path.string() +
                     ": more than 4 million pixels; around a scene (--terrain) they are thinned");
  }
  RawScene raw;
  raw.scene.format = "GeoTIFF";
  raw.scene.is_city = raw.scene.has_terrain = true;
  raw.scene.lods = {""};
  raw.crs = crs.empty() ? model.crs : crs;
  raw.scene.objects.push_back({path.stem().string(), "TINRelief"});
  raw.is_building = {0};
  const double unit = raw.crs.empty() ? 1.0 : Crs::parse(raw.crs).metres_per_unit;
  const bool is_degrees = !raw.crs.empty() && Crs::parse(raw.crs).geographic;
  const auto vertex = add_vertices(raw, model, is_degrees ? 1.0 : unit, path.filename().string());
  add_cells(raw.scene, model, vertex);
  raw.scene.lod_triangles[""] = raw.scene.surfaces.size();
  return raw;
}

}  // namespace tenku
