#include "output/field_writer.h"

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/version.h"
#include "output/field_codec.h"

namespace tenku {
namespace {

void check_length(const std::string& name, std::size_t have, std::size_t want) {
  if (have == want) return;
  throw InputError("field array " + name + " has " + std::to_string(have) + " values, the mesh " +
                   std::to_string(want));
}

void check(const FieldMesh& mesh) {
  const std::size_t points = mesh.points.size();
  const std::size_t cells = mesh.polygon_count() > 0 ? mesh.polygon_count() : points;
  for (const auto& array : mesh.point_values) check_length(array.name, array.values.size(), points);
  for (const auto& array : mesh.cell_values) check_length(array.name, array.values.size(), cells);
  for (const auto& array : mesh.cell_codes) check_length(array.name, array.codes.size(), cells);
  for (const Vec3 point : mesh.points) {
    if (!is_finite(point)) throw InputError("a point of the field mesh is not finite");
  }
  for (const std::uint32_t corner : mesh.polygon_corners) {
    if (corner >= points) {
      throw InputError("corner " + std::to_string(corner) +
                       " of the field mesh is not one of its " + std::to_string(points) +
                       " points");
    }
  }
}

const FieldCodec& field_codec() {
  static const auto& codec = dynamic_cast<const FieldCodec&>(load_plugin("fields"));
  return codec;
}

}  // namespace

void write_vtp(const std::filesystem::path& path, const FieldMesh& mesh) {
  check(mesh);
  write_whole_file(path, field_codec().vtp_bytes(mesh, std::string(software_name())));
}

FieldMesh read_vtp(const std::filesystem::path& path) { return field_codec().read_vtp(path); }

std::string_view vtk_version() { return TENKU_VTK_VERSION; }

}  // namespace tenku
