/// A box of 4 by 3 by 5 m in the encodings of plain meshes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>

namespace tenku {

inline constexpr std::array<std::array<float, 3>, 8> kBoxVertices{
    {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {0, 0, 5}, {4, 0, 5}, {4, 3, 5}, {0, 3, 5}}};
inline constexpr std::array<std::array<std::int32_t, 4>, 6> kBoxFaces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

template <class T>
std::string bytes_of(T value, std::endian order = std::endian::little) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return {bytes.data(), bytes.size()};
}

inline std::string ply_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ascii_ply() {
  std::string text = ply_header("ascii");
  for (const auto& v : kBoxVertices) {
    for (const float x : v) text += std::to_string(x) + " ";
    text += "\n";
  }
  for (const auto& f : kBoxFaces) {
    text += "4";
    for (const auto v : f) text += " " + std::to_string(v);
    text += "\n";
  }
  return text;
}

inline std::string binary_ply(std::endian order) {
  std::string text =
      ply_header(order == std::endian::big ? "binary_big_endian" : "binary_little_endian");
  for (const auto& v : kBoxVertices) {
    for (const float x : v) text += bytes_of(x, order);
  }
  for (const auto& f : kBoxFaces) {
    text += '\4';
    for (const auto v : f) text += bytes_of(v, order);
  }
  return text;
}

/// Calls `use` with the three vertices of each triangle of the box.
template <class Use>
void for_each_triangle(const Use& use) {
  for (const auto& f : kBoxFaces) {
    for (const std::size_t k : {1U, 2U}) {
      use(std::array{kBoxVertices[static_cast<std::size_t>(f[0])],
                     kBoxVertices[static_cast<std::size_t>(f[k])],
                     kBoxVertices[static_cast<std::size_t>(f[k + 1])]});
    }
  }
}

inline std::string ascii_stl() {
  std::string text = "solid box\n";
  for_each_triangle([&](const auto& triangle) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const auto& v : triangle) {
      text += "      vertex";
      for (const float x : v) text += " " + std::to_string(x);
      text += "\n";
    }
    text += "    endloop\n  endfacet\n";
  });
  return text + "endsolid box\n";
}

inline std::string binary_stl(std::string header) {
  header.resize(80, ' ');
  std::string text = header + bytes_of(std::uint32_t{12});
  for_each_triangle([&](const auto& triangle) {
    text += std::string(12, '\0');
    for (const auto& v : triangle) {
      for (const float x : v) text += bytes_of(x);
    }
    text += std::string(2, '\0');
  });
  return text;
}

inline const char* const kRadiance =
    "# a wall\nvoid plastic white\n0\n0\n5 .8 .7 .6 0 0\n\nwhite polygon wall_1\n0\n0\n12\n"
    "0 0 0\n4 0 0\n4 0 3\n0 0 3\n";

}  // namespace tenku
