/// Results on surfaces, for ParaView and other readers of VTK files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec3.h"

namespace tenku {

/// Numbers on the points or on the polygons of a mesh.
struct FieldValues {
  std::string name;  ///< with the unit: `sky_lux`
  std::vector<double> values;
};

/// Codes on the polygons of a mesh: an index into the text of the same name, such as `object_id`.
struct FieldCodes {
  std::string name;
  std::vector<std::int32_t> codes;
};

/// Text that belongs to the whole mesh; several values make a list.
struct FieldText {
  std::string name;
  std::vector<std::string> values;
};

/// Mesh with values, ready to be written.
///
/// Frame    local east, north, up; the texts `origin` and `to_file` lead to the scene file's.
/// Units    metres; the arrays carry theirs in the name.
/// Shape    polygon k has the corners polygon_corners[polygon_ends[k - 1] .. polygon_ends[k]).
///          Point arrays are [point], cell arrays [polygon]; a mesh without polygons is a cloud of
///          points, whose cells are its points.
struct FieldMesh {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> polygon_corners, polygon_ends;
  std::vector<FieldValues> point_values, cell_values;
  std::vector<FieldCodes> cell_codes;
  std::vector<FieldText> texts;  ///< `crs`, `origin`, `sky`, names of codes

  void add_polygon(std::span<const std::uint32_t> corners) {
    polygon_corners.insert(polygon_corners.end(), corners.begin(), corners.end());
    polygon_ends.push_back(static_cast<std::uint32_t>(polygon_corners.size()));
  }
  std::size_t polygon_count() const { return polygon_ends.size(); }
};

/// Writes `mesh` as VTK XML PolyData (`.vtp`), binary and compressed, with the text `software`
/// added.
///
/// Error    points and values are stored as 32-bit floats; codes exactly.
/// @throws InputError if an array has the wrong length, a corner is out of range, a point is not
///         finite, or the folder does not exist; ResourceError if writing fails or the plug-in
///         `fields` cannot be loaded
void write_vtp(const std::filesystem::path& path, const FieldMesh& mesh);

/// Reads back what `write_vtp` wrote.
/// @throws InputError if the file cannot be read
FieldMesh read_vtp(const std::filesystem::path& path);

/// Version of VTK, such as `9.1.0`; does not load it.
std::string_view vtk_version();

}  // namespace tenku
