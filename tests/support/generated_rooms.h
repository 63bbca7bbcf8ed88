/// Rooms and buildings of given size for tests and benchmarks of radiosity.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "meshing/element_mesh.h"

namespace tenku::testing_support {

/// Edge lengths at most of patches, and of the elements in them.
struct MeshLengths {
  double patch_m, element_m;
};

/// Builds a mesh of rectangles and boxes, each face with an object number of its own.
class RoomBuilder {
 public:
  explicit RoomBuilder(MeshLengths lengths) : lengths_(lengths) {}

  /// A rectangle with the front toward cross(u, v).
  void add_rectangle(Vec3 corner, Vec3 u, Vec3 v) {
    const int across = pieces(length(u), lengths_.patch_m),
              up = pieces(length(v), lengths_.patch_m);
    for (int j = 0; j < up; ++j) {
      for (int i = 0; i < across; ++i) {
        add_patch(corner + (1.0 * i / across) * u + (1.0 * j / up) * v, (1.0 / across) * u,
                  (1.0 / up) * v);
      }
    }
    ++faces_;
  }

  /// The six faces of a box, fronts outward, or inward for a room.
  void add_box(Vec3 low, Vec3 high, bool inward) {
    const Vec3 x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
    const auto face = [&](Vec3 corner, Vec3 u, Vec3 v) {
      inward ? add_rectangle(corner, v, u) : add_rectangle(corner, u, v);
    };
    face(low, y, x);
    face(low + z, x, y);
    face(low, x, z);
    face(low + y, z, x);
    face(low, z, y);
    face(low + x, y, z);
  }

  std::uint32_t faces() const { return faces_; }
  const ElementMesh& mesh() const { return mesh_; }

 private:
  static int pieces(double length_m, double at_most_m) {
    return std::max(1, static_cast<int>(std::ceil(length_m / at_most_m - 1e-9)));
  }

  void add_patch(Vec3 corner, Vec3 u, Vec3 v) {
    const int across = pieces(length(u), lengths_.element_m);
    const int up = pieces(length(v), lengths_.element_m);
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (int j = 0; j <= up; ++j) {
      for (int i = 0; i <= across; ++i) {
        mesh_.vertices.push_back(corner + (1.0 * i / across) * u + (1.0 * j / up) * v);
      }
    }
    const auto row = static_cast<std::uint32_t>(across) + 1;
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(up); ++j) {
      for (std::uint32_t i = 0; i + 1 < row; ++i) {
        const std::uint32_t a = first + j * row + i;
        add_element({a, a + 1, a + row + 1});
        add_element({a, a + row + 1, a + row});
      }
    }
    mesh_.patch_begin.push_back(static_cast<std::uint32_t>(mesh_.size()));
  }

  void add_element(std::array<std::uint32_t, 3> corners) {
    mesh_.elements.push_back(corners);
    mesh_.material.push_back(0);
    mesh_.object.push_back(faces_);
  }

  MeshLengths lengths_;
  std::uint32_t faces_ = 0;
  ElementMesh mesh_;
};

/// A room of 5 by 4 by 2.8 m with a table-like block and a cupboard: 18 faces.
inline ElementMesh furnished_room(MeshLengths lengths) {
  RoomBuilder room(lengths);
  room.add_box({0, 0, 0}, {5, 4, 2.8}, true);
  room.add_box({1.2, 1.1, 0.1}, {2.7, 2.0, 0.8}, false);
  room.add_box({3.6, 2.6, 0.1}, {4.7, 3.5, 1.9}, false);
  return room.mesh();
}

/// A building of storeys of rooms in rows, each with a doorway to the next and five pieces of
/// furniture: 38 polygons a room.
inline ElementMesh furnished_building(int storeys, int rows, int columns, MeshLengths lengths) {
  RoomBuilder building(lengths);
  for (int room = 0; room < storeys * rows * columns; ++room) {
    const Vec3 at{4.2 * (room % columns), 4.2 * (room / columns % rows),
                  3.0 * (room / columns / rows)};
    const Vec3 x{4, 0, 0}, y{0, 4, 0}, z{0, 0, 2.7};
    building.add_rectangle(at, x, y);
    building.add_rectangle(at + z, y, x);
    building.add_rectangle(at, z, x);
    building.add_rectangle(at + y, x, z);
    for (const Vec3 side : {at, at + x}) {
      building.add_rectangle(side, 0.4 * y, z);
      building.add_rectangle(side + 0.6 * y, 0.4 * y, z);
      building.add_rectangle(side + 0.4 * y + 0.75 * z, 0.2 * y, 0.25 * z);
    }
    for (int k = 0; k < 5; ++k) {
      const Vec3 low = at + Vec3{0.3 + 0.7 * k, k % 2 == 0 ? 0.3 : 2.6, 0.05};
      building.add_box(low, low + Vec3{0.5, 0.9, 0.5 + 0.2 * k}, false);
    }
  }
  return building.mesh();
}

}  // namespace tenku::testing_support
