#include "scene/gltf_draco.h"

#include <draco/compression/decode.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace tenku {
namespace {

const draco::PointAttribute& attribute_of(const draco::Mesh& mesh, std::size_t id, int components,
                                          const JsonSource& source) {
  const draco::PointAttribute* attribute =
      id < 65536 ? mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id)) : nullptr;
  if (attribute == nullptr || attribute->num_components() != components) {
    source.refuse("a mesh packed by Draco has no fit attribute " + std::to_string(id));
  }
  return *attribute;
}

template <int N>
std::array<double, N> value_of(const draco::PointAttribute& attribute, std::uint32_t point,
                               const JsonSource& source) {
  std::array<double, N> value{};
  const draco::AttributeValueIndex at = attribute.mapped_index(draco::PointIndex(point));
  if (at.value() >= attribute.size() || !attribute.ConvertValue<double, N>(at, value.data())) {
    source.refuse("a mesh packed by Draco is damaged: a value is missing");
  }
  return value;
}

}  // namespace

DracoMesh unpack_draco(std::string_view bytes, std::size_t positions,
                       std::optional<std::size_t> features, const JsonSource& source) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) {
    source.refuse(std::string("a mesh packed by Draco is damaged: ") +
                  result.status().error_msg_string());
  }
  const std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
  const draco::PointAttribute& position = attribute_of(*mesh, positions, 3, source);
  const std::uint32_t count = mesh->num_points();
  DracoMesh unpacked;
  unpacked.points.reserve(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto p = value_of<3>(position, k, source);
    unpacked.points.push_back({p[0], p[1], p[2]});
  }
  if (features) {
    const draco::PointAttribute& feature = attribute_of(*mesh, *features, 1, source);
    for (std::uint32_t k = 0; k < count; ++k) {
      unpacked.features.push_back(value_of<1>(feature, k, source)[0]);
    }
  }
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f))) {
      if (corner.value() >= count)
        source.refuse("a mesh packed by Draco is damaged: a corner is out of range");
      unpacked.indices.push_back(corner.value());
    }
  }
  return unpacked;
}

}  // namespace tenku
