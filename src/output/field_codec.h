/// VTK files as our own meshes. VTK stands behind, loaded at first use; others call `write_vtp`.
#pragma once

#include <filesystem>
#include <string>

#include "core/plugin.h"
#include "output/field_writer.h"

namespace tenku {

/// Turns meshes into VTK XML PolyData and back.
///
/// Threads  may be used by many at once.
class FieldCodec : public Plugin {
 public:
  /// The bytes of the file that `write_vtp` writes.
  /// @param mesh      sound: arrays of the right length, corners in range, finite points
  /// @param software  added as a text of that name
  /// @throws ResourceError if they cannot be made
  virtual std::string vtp_bytes(const FieldMesh& mesh, const std::string& software) const = 0;

  /// @throws InputError if the file cannot be read
  virtual FieldMesh read_vtp(const std::filesystem::path& path) const = 0;
};

}  // namespace tenku
