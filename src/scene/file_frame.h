/// From the coordinates of the scene file to local metres, and back.
#pragma once

#include <array>

#include "core/units.h"
#include "core/vec3.h"

namespace tenku {

/// Map between the coordinates of a scene file and the local frame.
///
/// Either affine, local = L (file - origin), or, for a file in degrees, a transverse Mercator
/// projection about the origin with scale 1 there.
///
/// Frame    local: x east, y true north, z up, metres; true at the origin.
/// Error    affine from a projected CRS: the origin's scale and convergence are used everywhere.
///          5 km away, in EPSG:28992, 2056, 6677 and 31255, lengths are off by at most 1.2e-5 and
///          directions by 0.06 degrees (tested), both growing with the distance. In degrees:
///          lengths by d^2 / 2 R^2 at distance d east or west, 3e-7 at 5 km. Lengths are those on
///          the ellipsoid: at height h true ones are longer by h / R, 1e-4 at 600 m.
/// Threads  immutable but for assignment.
class FileFrame {
 public:
  /// The file's coordinates are local already.
  FileFrame() = default;

  using Rows = std::array<Vec3, 3>;
  /// local = rows (file - origin)
  static FileFrame affine(Vec3 origin, Rows rows);

  /// File in degrees: (longitude, latitude, height) or, if `latitude_first`, (latitude, longitude,
  /// height); `origin` is a point of the file. The map is turned clockwise by `turn`.
  static FileFrame geographic(Vec3 origin, bool latitude_first, Angle turn = {});

  Vec3 origin() const { return origin_; }  ///< in coordinates of the file
  bool is_geographic() const { return geographic_; }

  Vec3 to_local(Vec3 file_point) const;
  Vec3 to_file(Vec3 local_point) const;
  /// Unit vector in local axes of a direction in the axes of the file, of any length but zero. For
  /// a file in degrees the axes are east and north in the file's order.
  Vec3 direction_to_local(Vec3 file_direction) const;
  /// The other way round.
  Vec3 direction_to_file(Vec3 local_direction) const;

 private:
  Vec3 origin_{};
  Rows rows_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Rows inverse_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double northing_ = 0.0;  ///< of the origin, in degrees' projection
  bool geographic_ = false, latitude_first_ = false;
};

}  // namespace tenku
