#include "study/lit_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/suggest.h"
#include "scene/flatten.h"
#include "scene/soup_triangle.h"

namespace tenku {
namespace {

constexpr double kGivenGroundSensors = 20000.0;

struct SurfaceGroup {
  std::string_view name;
  std::vector<SurfaceType> types;
};

const std::vector<SurfaceGroup>& surface_groups() {
  static const std::vector<SurfaceGroup> groups{
      {"ground", {SurfaceType::Ground, SurfaceType::Road, SurfaceType::Floor, SurfaceType::Water}},
      {"roofs", {SurfaceType::Roof}},
      {"walls", {SurfaceType::Wall, SurfaceType::Window, SurfaceType::Door}},
      {"windows", {SurfaceType::Window}},
  };
  return groups;
}

std::vector<SurfaceType> types_named(const std::string& name) {
  std::vector<std::string_view> known;
  for (const SurfaceGroup& group : surface_groups()) {
    if (group.name == name) return group.types;
    known.push_back(group.name);
  }
  if (const auto type = surface_type_named(name)) return {*type};
  for (int t = 0; t < kSurfaceTypes; ++t) known.push_back(name_of(static_cast<SurfaceType>(t)));
  throw InputError("there is no kind of surface named '" + name + "'" + suggestion(name, known));
}

/// Ground surfaces of buildings face down, into the ground: nobody asks for their light.
bool is_underside(const TriangleSoup& soup, std::uint32_t triangle, SurfaceType type) {
  if (type != SurfaceType::Ground && type != SurfaceType::Floor) return false;
  const auto& [a, b, c] = soup.triangles[triangle];
  const Vec3 n = cross(soup.vertices[b] - soup.vertices[a], soup.vertices[c] - soup.vertices[a]);
  return !(n.z > 0.0);
}

}  // namespace

SurfaceType broad_type(const TriangleSoup& soup, std::uint32_t triangle) {
  const SurfaceType type = soup.surface_type[triangle];
  if (type != SurfaceType::Unknown) return type;
  const auto& [a, b, c] = soup.triangles[triangle];
  const Vec3 n = cross(soup.vertices[b] - soup.vertices[a], soup.vertices[c] - soup.vertices[a]);
  return type_by_normal(n);
}

LitScene::LitScene(const std::filesystem::path& file, const ReadOptions& options,
                   const SkyMaker& make_sky, const std::optional<PartitionRequest>& partition,
                   GlPlatform gl, Progress& progress)
    : scene_(read_scene(file, options, progress)),
      soup_(std::make_unique<TriangleSoup>(flatten(scene_))) {
  progress.stop_if_cancelled();
  if (options.around) {
    const Vec3 middle = scene_.frame.to_local({options.around->x, options.around->y, 0.0});
    place_ = {middle.x, middle.y, options.around->half_m};
  }
  progress.begin("tree of boxes", 0);
  engines_ = std::make_unique<Engines>(*soup_, scene_.materials, gl);
  progress.end(std::to_string(soup_->size()) + " triangles");
  sky_ = make_sky(site());
  source_ = daylight_of(sky_, partition);
}

std::optional<Location> LitScene::site() const {
  if (!scene_.georeference) return std::nullopt;
  return scene_.georeference->origin;
}

Sensors LitScene::to_local(const Sensors& in_file) const {
  Sensors local;
  for (std::size_t i = 0; i < in_file.size(); ++i) {
    local.position.push_back(scene_.frame.to_local(in_file.position[i]));
    local.normal.push_back(normalized(scene_.frame.direction_to_local(in_file.normal[i])));
  }
  return local;
}

Sensors LitScene::to_file(const Sensors& local) const {
  Sensors in_file;
  for (std::size_t i = 0; i < local.size(); ++i) {
    in_file.position.push_back(scene_.frame.to_file(local.position[i]));
    in_file.normal.push_back(scene_.frame.direction_to_file(local.normal[i]));
  }
  return in_file;
}

Extent LitScene::extent() const {
  Extent box;
  for (std::size_t t = 0; t < soup_->size(); ++t) {
    if (scene_.objects[soup_->object[t]].id == kGroundObjectId) continue;
    for (const std::uint32_t v : soup_->triangles[t]) box.add(soup_->vertices[v]);
  }
  if (place_) {
    const auto hold = [&](double Vec3::*axis, double middle) {
      box.min.*axis = std::max(box.min.*axis, middle - place_->half_m);
      box.max.*axis = std::min(box.max.*axis, middle + place_->half_m);
    };
    hold(&Vec3::x, place_->x), hold(&Vec3::y, place_->y);
  }
  return box;
}

SensorGrid LitScene::grid(std::span<const std::string> surfaces, double spacing_m) const {
  std::array<bool, kSurfaceTypes> wanted{};
  for (const std::string& name : surfaces) {
    for (const SurfaceType type : types_named(name)) wanted[static_cast<std::size_t>(type)] = true;
  }
  std::vector<std::uint32_t> own, given;
  double given_area = 0.0;
  for (std::uint32_t t = 0; t < soup_->size(); ++t) {
    const SurfaceType type = broad_type(*soup_, t);
    if (!wanted[static_cast<std::size_t>(type)]) continue;
    if (is_underside(*soup_, t, type)) continue;
    if (scene_.objects[soup_->object[t]].id != kGroundObjectId) {
      own.push_back(t);
      continue;
    }
    if (scene_.has_terrain) continue;  // it only closes the horizon there
    given.push_back(t);
    given_area += area_m2(*soup_, t);
  }
  const GroundSquare* within = place_ ? &*place_ : nullptr;
  if (place_) given_area = std::min(given_area, 4.0 * place_->half_m * place_->half_m);
  SensorGrid grid;
  append_sensors(grid, *soup_, own, spacing_m, within);
  append_sensors(grid, *soup_, given,
                 std::max(spacing_m, std::sqrt(given_area / kGivenGroundSensors)), within);
  if (grid.sensors.size() == 0)
    throw InputError("the scene has no surfaces of the kinds asked for");
  return grid;
}

}  // namespace tenku
