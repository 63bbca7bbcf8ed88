#include "study/radiosity_field.h"

#include <array>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/random.h"
#include "scene/scene.h"
#include "study/illuminance_field.h"
#include "study/named_codes.h"

namespace tenku {
namespace {

constexpr double kNormalSteps = 100.0;  // of a normal's component that tells two ways to face

std::uint64_t surface_key(std::uint32_t object, std::uint32_t material, Vec3 doubled_area) {
  Vec3 n = normalized(doubled_area);
  if (n.z < 0.0 || (n.z == 0.0 && (n.x < 0.0 || (n.x == 0.0 && n.y < 0.0)))) n = -n;
  return mix_rounded(mix_bits((std::uint64_t{object} << 32U) + material),
                     {kNormalSteps * n.x, kNormalSteps * n.y, kNormalSteps * n.z});
}

/// What the triangles of an object that face one way are.
class SurfaceTypes {
 public:
  explicit SurfaceTypes(const TriangleSoup& soup) {
    for (std::uint32_t t = 0; t < soup.size(); ++t) {
      const auto& [a, b, c] = soup.triangles[t];
      const Vec3 area =
          cross(soup.vertices[b] - soup.vertices[a], soup.vertices[c] - soup.vertices[a]);
      type_.emplace(surface_key(soup.object[t], soup.material[t], area), soup.surface_type[t]);
    }
  }
  SurfaceType of(const ElementMesh& mesh, std::size_t element) const {
    const auto found = type_.find(
        surface_key(mesh.object[element], mesh.material[element], mesh.doubled_area(element)));
    return found != type_.end() ? found->second : SurfaceType::Unknown;
  }

 private:
  std::unordered_map<std::uint64_t, SurfaceType> type_;
};

/// The corners of a side in the order in which it faces outward.
std::array<std::uint32_t, 3> facing(std::array<std::uint32_t, 3> corner, std::size_t side) {
  if (side % 2 == 1) std::swap(corner[1], corner[2]);
  return corner;
}

/// Points of the field: one for each point of the mesh and material there.
class FieldPoints {
 public:
  FieldPoints(const ElementMesh& mesh, const Interior& interior, const InteriorLight& light)
      : mesh_(mesh), interior_(interior), light_(light) {}

  void add(FieldMesh& field, std::size_t side, double lift_m) {
    std::array<std::uint32_t, 3> ids{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t point = interior_.points().corner[side][k];
      const std::uint64_t key = std::uint64_t{point} << 32U | mesh_.material[side / 2];
      const auto [found, is_new] = id_.emplace(key, static_cast<std::uint32_t>(point_.size()));
      ids[k] = found->second;
      if (!is_new) continue;
      const std::uint32_t number = mesh_.elements[side / 2][k];
      const Vec3 vertex = mesh_.vertices[number];
      field.points.push_back(vertex + lift_m * interior_.points().sensors.normal[point]);
      point_.push_back(point);
      vertex_.push_back(number);
      const Rgb direct = Rgb::grey(light_.points.sun_lux[point] + light_.points.sky_lux[point]);
      radiosity_.push_back(interior_.surfaces().emission_lm_m2[side / 2] +
                           interior_.surfaces().reflectance[side / 2] *
                               (direct + light_.corners.lux[point]));
    }
    field.add_polygon(facing(ids, side));
  }

  void store(FieldMesh& field, std::span<const double> asked_size_m) const {
    const auto add = [&](std::string name, const auto& value) {
      FieldValues values{std::move(name), {}};
      for (std::size_t i = 0; i < point_.size(); ++i) values.values.push_back(value(i));
      field.point_values.push_back(std::move(values));
    };
    const SensorIlluminance& lit = light_.points;
    add("sun_lux", [&](std::size_t i) { return lit.sun_lux[point_[i]]; });
    add("sky_lux", [&](std::size_t i) { return lit.sky_lux[point_[i]]; });
    add("reflected_lux", [&](std::size_t i) { return lit.reflected_lux[point_[i]]; });
    add("total_lux", [&](std::size_t i) { return lit.total_lux(point_[i]); });
    add("illuminance_lux", [&](std::size_t i) { return lit.total_lux(point_[i]); });
    add("error_lux", [&](std::size_t i) { return lit.error_lux[point_[i]]; });
    add("sky_view", [&](std::size_t i) { return lit.sky_view[point_[i]]; });
    add("radiosity_lm_m2", [&](std::size_t i) { return luminance_of(radiosity_[i]); });
    add("radiosity_r_lm_m2", [&](std::size_t i) { return radiosity_[i].r; });
    add("radiosity_g_lm_m2", [&](std::size_t i) { return radiosity_[i].g; });
    add("radiosity_b_lm_m2", [&](std::size_t i) { return radiosity_[i].b; });
    if (asked_size_m.empty()) return;
    add("asked_size_m", [&](std::size_t i) { return asked_size_m[vertex_[i]]; });
  }

 private:
  const ElementMesh& mesh_;
  const Interior& interior_;
  const InteriorLight& light_;
  std::unordered_map<std::uint64_t, std::uint32_t> id_;
  std::vector<std::uint32_t> point_, vertex_;
  std::vector<Rgb> radiosity_;
};

}  // namespace

FieldMesh field_of_radiosity(const LitScene& lit, const ElementMesh& mesh, const Interior& interior,
                             const InteriorLight& light, std::span<const double> asked_size_m) {
  FieldMesh field;
  FieldPoints points(mesh, interior, light);
  FieldValues radiosity{"element_radiosity_lm_m2", {}}, unshot{"unshot_lm_m2", {}},
      size{"element_size_m", {}};
  FieldCodes patch{"patch", {}}, face{"side", {}};
  NamedCodes<std::uint32_t> types("surface_type"), objects("object_id"), materials("material");
  const SurfaceTypes known(lit.soup());
  for (std::size_t p = 0; p < mesh.patches(); ++p) {
    for (std::size_t s = 2 * mesh.patch_begin[p]; s < 2 * mesh.patch_begin[p + 1]; ++s) {
      if (light.is_lit[interior.points().corner[s][0]] == 0) continue;
      const std::size_t e = s / 2;
      points.add(field, s, lit.rays().lift_m());
      radiosity.values.push_back(luminance_of(light.corners.radiosity[s]));
      unshot.values.push_back(luminance_of(light.shots.sides.unshot[s]));
      size.values.push_back(mesh.mean_edge_m(e));
      patch.codes.push_back(static_cast<std::int32_t>(p));
      face.codes.push_back(static_cast<std::int32_t>(s % 2));
      const SurfaceType type = known.of(mesh, e);
      types.add(static_cast<std::uint32_t>(type), [&] { return std::string(name_of(type)); });
      objects.add(mesh.object[e], [&] { return lit.scene().objects[mesh.object[e]].id; });
      materials.add(mesh.material[e], [&] { return lit.scene().materials[mesh.material[e]].name; });
    }
  }
  points.store(field, asked_size_m);
  field.cell_values = {std::move(radiosity), std::move(unshot), std::move(size)};
  field.cell_codes = {std::move(patch), std::move(face)};
  types.move_to(field);
  objects.move_to(field);
  materials.move_to(field);
  add_place(field, lit);
  return field;
}

FieldMesh field_of_shots(const LitScene& lit, const ElementMesh& mesh, const SurfaceLight& surfaces,
                         const ShotView& view) {
  FieldMesh field;
  FieldValues radiosity{"radiosity_lm_m2", {}}, ambient{"with_ambient_lm_m2", {}},
      unshot{"unshot_lm_m2", {}};
  FieldCodes face{"side", {}};
  for (std::size_t s = 0; s < mesh.sides(); ++s) {
    const Rgb sent = view.sides.radiosity[s];
    if (!(luminance_of(sent) > 0.0)) continue;
    std::array<std::uint32_t, 3> ids{};
    for (std::size_t k = 0; k < 3; ++k) {
      ids[k] = static_cast<std::uint32_t>(field.points.size());
      field.points.push_back(mesh.vertices[mesh.elements[s / 2][k]] +
                             lit.rays().lift_m() * mesh.normal(s));
    }
    field.add_polygon(facing(ids, s));
    radiosity.values.push_back(luminance_of(sent));
    ambient.values.push_back(luminance_of(sent + surfaces.reflectance[s / 2] * view.ambient));
    unshot.values.push_back(luminance_of(view.sides.unshot[s]));
    face.codes.push_back(static_cast<std::int32_t>(s % 2));
  }
  field.cell_values = {std::move(radiosity), std::move(ambient), std::move(unshot)};
  field.cell_codes = {std::move(face)};
  add_place(field, lit);
  return field;
}

}  // namespace tenku
