/// Scene files of boxes, put together as text.
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "core/vec3.h"

namespace tenku::testing_support {

/// An OBJ, object by object.
class ObjText {
 public:
  /// Closed box of its own object.
  void box(const std::string& id, Vec3 low, Vec3 size) {
    text_ += "o " + id + "\n";
    for (int k = 0; k < 8; ++k) {
      const bool far_x = k == 1 || k == 2 || k == 5 || k == 6, far_y = (k & 2) != 0;
      vertex({low.x + (far_x ? size.x : 0), low.y + (far_y ? size.y : 0),
              low.z + (k > 3 ? size.z : 0)});
    }
    for (const char* face : {"5 6 7 8", "4 3 2 1", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8"}) {
      text_ += "f";
      for (const char* c = face; *c != '\0'; c += c[1] == '\0' ? 1 : 2) {
        text_ += fmt::format(" {}", *c - '0' - 9);
      }
      text_ += "\n";
    }
  }
  void triangle(const std::string& id, Vec3 a, Vec3 b, Vec3 c) {
    text_ += "o " + id + "\n";
    for (const Vec3 v : {a, b, c}) vertex(v);
    text_ += "f -3 -2 -1\n";
  }
  const std::string& text() const { return text_; }

 private:
  void vertex(Vec3 v) { text_ += fmt::format("v {:.9g} {:.9g} {:.9g}\n", v.x, v.y, v.z); }
  std::string text_;
};

/// CityJSON of houses on a row, each a box, but the first `flat` ones with no height.
inline std::string city_of(int houses, int flat) {
  std::string objects, vertices;
  for (int h = 0; h < houses; ++h) {
    const int b = 8 * h, top = h < flat ? 0 : 9000;
    for (const int z : {0, top}) {
      for (const auto& [x, y] : {std::pair{0, 0}, {9, 0}, {9, 9}, {0, 9}}) {
        vertices += fmt::format("{}[{},{},{}]", vertices.empty() ? "" : ",", 1000 * (x + 20 * h),
                                1000 * y, z);
      }
    }
    std::string faces;
    for (const auto& f : {std::array{4, 5, 6, 7},
                          {3, 2, 1, 0},
                          {0, 1, 5, 4},
                          {1, 2, 6, 5},
                          {2, 3, 7, 6},
                          {3, 0, 4, 7}}) {
      faces += fmt::format("{}[[{},{},{},{}]]", faces.empty() ? "" : ",", b + f[0], b + f[1],
                           b + f[2], b + f[3]);
    }
    objects += fmt::format(R"({}"house{}":{{"type":"Building","geometry":[{{"type":"MultiSurface",)"
                           R"("lod":"1","boundaries":[{}]}}]}})",
                           objects.empty() ? "" : ",", h, faces);
  }
  return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],)"
         R"("translate":[0,0,0]},"CityObjects":{)" +
         objects + R"(},"vertices":[)" + vertices + "]}";
}

}  // namespace tenku::testing_support
