/// The box of mesh_texts.h packed by Draco.
#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <string>

#include "tests/scene/gltf_texts.h"

namespace tenku {

/// The box packed by libdraco's own encoder.
inline std::string packed_box() {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(12);
  const int position =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  std::uint32_t face = 0;
  for_each_triangle([&](const auto& triangle) {
    const auto a = y_up(triangle[0]), b = y_up(triangle[1]), c = y_up(triangle[2]);
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(face++), a.data(), b.data(),
                                      c.data());
  });
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) return "";
  return {buffer.data(), buffer.size()};
}

inline std::string draco_json(const std::string& packed) {
  std::string json = gltf_json(data_uri(packed));
  const auto put = [&](const std::string& old, const std::string& now) {
    json.replace(json.find(old), old.size(), now);
  };
  put(R"("material":0)", R"("material":0,"extensions":{"KHR_draco_mesh_compression":)"
                         R"({"bufferView":0,"attributes":{"POSITION":0}}})");
  put(R"("bufferView":0,"componentType":5126)", R"("componentType":5126)");
  put(R"("byteLength":96},)", R"("byteLength":)" + std::to_string(packed.size()) + "},");
  put(R"("byteLength":168)", R"("byteLength":)" + std::to_string(packed.size()));
  put(R"("scene":0,)", R"("scene":0,"extensionsRequired":["KHR_draco_mesh_compression"],)");
  return json;
}

}  // namespace tenku
