/// Files of 3D Tiles for tests.
#pragma once

#include <cstdint>
#include <string>

#include "tests/scene/gltf_texts.h"

namespace tenku {

inline std::string subtree(std::string json, std::string bits) {
  while (json.size() % 8 != 0) json += ' ';
  while (bits.size() % 8 != 0) bits += '\0';
  return "subt" + bytes_of(std::uint32_t{1}) + bytes_of(std::uint64_t{json.size()}) +
         bytes_of(std::uint64_t{bits.size()}) + json + bits;
}

/// The box with a batch id a vertex: the lower four 0, the upper four 1.
inline std::string batched_glb() {
  std::string json = gltf_json("");
  const auto put = [&](const std::string& old, const std::string& now) {
    json.replace(json.find(old), old.size(), now);
  };
  put(R"("POSITION":0)", R"("POSITION":0,"_BATCHID":2)");
  put(R"("count":36,"type":"SCALAR"})",
      R"("count":36,"type":"SCALAR"},{"bufferView":2,"componentType":5121,"count":8,)"
      R"("type":"SCALAR"})");
  put(R"("byteLength":72}])", R"("byteLength":72},{"buffer":0,"byteOffset":168,"byteLength":8}])");
  put(R"("byteLength":168)", R"("byteLength":176)");
  return glb_of(json, gltf_buffer() + std::string(4, '\0') + std::string(4, '\1'));
}

inline std::string b3dm(const std::string& glb, std::string features, std::string batch) {
  const auto u32 = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
  const std::size_t length = 28 + features.size() + batch.size() + glb.size();
  return "b3dm" + u32(1) + u32(length) + u32(features.size()) + u32(0) + u32(batch.size()) +
         u32(0) + features + batch + glb;
}

}  // namespace tenku
