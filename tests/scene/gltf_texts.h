/// The box of mesh_texts.h as glTF, y up.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>

#include "tests/scene/mesh_texts.h"

namespace tenku {

inline std::string base64_of(const std::string& bytes) {
  const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      bits = bits << 8U | (k + i < bytes.size() ? static_cast<unsigned char>(bytes[k + i]) : 0U);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      text += k + i <= bytes.size() ? letters[bits >> (18U - 6U * i) & 63U] : '=';
    }
  }
  return text;
}

/// (x, y, z) of the z-up box in glTF's axes: (x, z, -y).
inline std::array<float, 3> y_up(const std::array<float, 3>& v) { return {v[0], v[2], -v[1]}; }

/// 8 positions in 32-bit floats (96 bytes), then 36 indices in 16 bits (72 bytes).
inline std::string gltf_buffer() {
  std::string bytes;
  for (const auto& v : kBoxVertices) {
    for (const float x : y_up(v)) bytes += bytes_of(x);
  }
  for (const auto& f : kBoxFaces) {
    for (const std::size_t k : {0U, 1U, 2U, 0U, 2U, 3U}) {
      bytes += bytes_of(static_cast<std::uint16_t>(f[k]));
    }
  }
  return bytes;
}

/// @param uri   of the buffer, or empty for the chunk of a GLB
/// @param node  members of the node that has the mesh
inline std::string gltf_json(const std::string& uri, const std::string& node = R"("name":"box")") {
  const std::string where = uri.empty() ? "" : R"("uri":")" + uri + R"(",)";
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,)" +
         node +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
         R"("materials":[{"name":"brick","pbrMetallicRoughness":)"
         R"({"baseColorFactor":[0.5,0.25,0.125,1]}}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":96},)"
         R"({"buffer":0,"byteOffset":96,"byteLength":72}],)"
         R"("buffers":[{)" +
         where + R"("byteLength":168}]})";
}

inline std::string data_uri(const std::string& bytes) {
  return "data:application/octet-stream;base64," + base64_of(bytes);
}

inline std::string gltf_text(const std::string& node = R"("name":"box")") {
  return gltf_json(data_uri(gltf_buffer()), node);
}

inline std::string glb_of(std::string json, std::string bytes) {
  while (json.size() % 4 != 0) json += ' ';
  while (bytes.size() % 4 != 0) bytes += '\0';
  const auto u32 = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
  return "glTF" + u32(2) + u32(12 + 8 + json.size() + 8 + bytes.size()) + u32(json.size()) +
         "JSON" + json + u32(bytes.size()) + std::string("BIN\0", 4) + bytes;
}

inline std::string glb() { return glb_of(gltf_json(""), gltf_buffer()); }

}  // namespace tenku
