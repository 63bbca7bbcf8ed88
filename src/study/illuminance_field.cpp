#include "study/illuminance_field.h"

#include <array>
#include <string>
#include <unordered_map>

#include "output/table_writer.h"

namespace tenku {
namespace {

using Pick = std::vector<std::uint32_t>;

FieldValues picked(std::string name, const std::vector<double>& values, const Pick& sensor) {
  FieldValues field{std::move(name), {}};
  field.values.reserve(sensor.size());
  for (const std::uint32_t s : sensor) field.values.push_back(values[s]);
  return field;
}

void add_light(FieldMesh& mesh, const SensorIlluminance& values, std::span<const Decided> decided,
               const Pick& sensor) {
  std::vector<double> total(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) total[i] = values.total_lux(i);
  mesh.point_values.push_back(picked("sun_lux", values.sun_lux, sensor));
  mesh.point_values.push_back(picked("sky_lux", values.sky_lux, sensor));
  mesh.point_values.push_back(picked("reflected_lux", values.reflected_lux, sensor));
  mesh.point_values.push_back(picked("total_lux", total, sensor));
  mesh.point_values.push_back(picked("error_lux", values.error_lux, sensor));
  mesh.point_values.push_back(picked("sky_view", values.sky_view, sensor));
  if (decided.empty()) return;
  std::vector<double> codes;
  for (const Decided d : decided) codes.push_back(static_cast<double>(d));
  mesh.point_values.push_back(picked("decided", codes, sensor));
}

std::string text_of(Vec3 v) {
  return shortest_text(v.x) + " " + shortest_text(v.y) + " " + shortest_text(v.z);
}

/// What takes a point of the mesh back to the file; a file in degrees has no such matrix.
void add_way_back(FieldMesh& mesh, const FileFrame& frame) {
  mesh.texts.push_back({"origin", {text_of(frame.origin())}});
  if (frame.is_geographic()) return;
  const Vec3 x = frame.to_file({1, 0, 0}) - frame.origin(),
             y = frame.to_file({0, 1, 0}) - frame.origin(),
             z = frame.to_file({0, 0, 1}) - frame.origin();
  mesh.texts.push_back({"to_file",
                        {text_of({x.x, y.x, z.x}) + " " + text_of({x.y, y.y, z.y}) + " " +
                         text_of({x.z, y.z, z.z})}});
}

/// Codes of the objects that the grid touches, in the order of their first part.
void add_cells(FieldMesh& mesh, const LitScene& lit, const SensorGrid& grid) {
  FieldCodes type{"surface_type", {}}, object{"object_id", {}};
  FieldText type_names{"surface_type", {}}, object_names{"object_id", {}};
  for (int t = 0; t < kSurfaceTypes; ++t) {
    type_names.values.emplace_back(name_of(static_cast<SurfaceType>(t)));
  }
  std::unordered_map<std::uint32_t, std::int32_t> code;
  for (const std::uint32_t triangle : grid.triangle) {
    type.codes.push_back(static_cast<std::int32_t>(lit.soup().surface_type[triangle]));
    const std::uint32_t o = lit.soup().object[triangle];
    const auto [found, is_new] = code.emplace(o, static_cast<std::int32_t>(code.size()));
    if (is_new) object_names.values.push_back(lit.scene().objects[o].id);
    object.codes.push_back(found->second);
  }
  mesh.cell_codes = {std::move(type), std::move(object)};
  mesh.texts.push_back(std::move(type_names));
  mesh.texts.push_back(std::move(object_names));
}

}  // namespace

void add_place(FieldMesh& mesh, const LitScene& lit) {
  const auto& at = lit.scene().georeference;
  mesh.texts.push_back({"crs", {at ? at->crs : ""}});
  if (at) {
    mesh.texts.push_back(
        {"grid_convergence_deg", {shortest_text(at->grid_convergence.in_degrees())}});
  }
  add_way_back(mesh, lit.scene().frame);
  mesh.texts.push_back({"sky", {lit.sky().description}});
}

FieldMesh field_of_grid(const LitScene& lit, const SensorGrid& grid,
                        const SensorIlluminance& values, std::span<const Decided> decided) {
  FieldMesh mesh;
  Pick sensor;
  for (std::size_t part = 0; part < grid.corner_sensor.size(); ++part) {
    std::array<std::uint32_t, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(grid.corner_point[part][k]);
      sensor.push_back(grid.corner_sensor[part][k]);
    }
    mesh.add_polygon(corners);
  }
  add_light(mesh, values, decided, sensor);
  add_place(mesh, lit);
  add_cells(mesh, lit, grid);
  return mesh;
}

FieldMesh field_of_points(const LitScene& lit, const Sensors& sensors,
                          const SensorIlluminance& values, std::span<const Decided> decided) {
  FieldMesh mesh;
  mesh.points = sensors.position;
  Pick sensor(sensors.size());
  for (std::uint32_t i = 0; i < sensor.size(); ++i) sensor[i] = i;
  add_light(mesh, values, decided, sensor);
  add_place(mesh, lit);
  return mesh;
}

}  // namespace tenku
