#include "output/gltf_writer.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace tenku {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
void append(std::string& bytes, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

/// The buffer and what describes it, array by array.
struct Buffer {
  std::string bytes;
  Json views = Json::array(), accessors = Json::array();

  /// Adds the description of what was appended since `begin`; returns its index.
  std::size_t describe(std::size_t begin, std::size_t count, const char* type) {
    constexpr int kFloat = 5126, kVertices = 34962;
    views.push_back({{"buffer", 0},
                     {"byteOffset", begin},
                     {"byteLength", bytes.size() - begin},
                     {"target", kVertices}});
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", kFloat},
                         {"count", count},
                         {"type", type}});
    return accessors.size() - 1;
  }
};

std::size_t add_points(Buffer& buffer, const std::vector<Vec3>& points) {
  const std::size_t begin = buffer.bytes.size();
  constexpr float kNone = std::numeric_limits<float>::infinity();
  std::array<float, 3> low{kNone, kNone, kNone}, high{-kNone, -kNone, -kNone};
  for (const Vec3 p : points) {
    const std::array<float, 3> out{static_cast<float>(p.x), static_cast<float>(p.z),
                                   static_cast<float>(-p.y)};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], out[k]);
      high[k] = std::max(high[k], out[k]);
      append(buffer.bytes, out[k]);
    }
  }
  const std::size_t index = buffer.describe(begin, points.size(), "VEC3");
  buffer.accessors[index]["min"] = low;
  buffer.accessors[index]["max"] = high;
  return index;
}

Json attributes_of(const GltfMesh& mesh, Buffer& buffer) {
  Json attributes{{"POSITION", add_points(buffer, mesh.points)}};
  std::size_t begin = buffer.bytes.size();
  for (const auto& colour : mesh.colours) {
    for (const float channel : colour) append(buffer.bytes, channel);
  }
  attributes["COLOR_0"] = buffer.describe(begin, mesh.colours.size(), "VEC3");
  for (const GltfValues& values : mesh.values) {
    begin = buffer.bytes.size();
    for (const float value : values.values) append(buffer.bytes, value);
    attributes[values.name] = buffer.describe(begin, values.values.size(), "SCALAR");
  }
  return attributes;
}

void check(const GltfMesh& mesh) {
  bool is_whole = !mesh.points.empty() && mesh.points.size() % 3 == 0 &&
                  mesh.colours.size() == mesh.points.size();
  for (const GltfValues& values : mesh.values) {
    is_whole &= values.values.size() == mesh.points.size();
  }
  if (!is_whole) throw InputError("a mesh for glTF has arrays of different lengths, or none");
}

void append_chunk(std::string& file, const std::string& type, std::string bytes, char filler) {
  bytes.resize((bytes.size() + 3) / 4 * 4, filler);
  append(file, static_cast<std::uint32_t>(bytes.size()));
  file += type;
  file += bytes;
}

}  // namespace

std::string glb_of(const GltfMesh& mesh) {
  check(mesh);
  Buffer buffer;
  Json primitive{{"attributes", attributes_of(mesh, buffer)}, {"material", 0}, {"mode", 4}};
  Json json{{"asset", {{"version", "2.0"}, {"generator", "tenku"}}},
            {"extensionsUsed", {"KHR_materials_unlit"}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", {{{"mesh", 0}, {"name", mesh.name}}}},
            {"meshes", {{{"name", mesh.name}, {"primitives", Json::array({primitive})}}}},
            {"materials",
             {{{"doubleSided", true}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}}}},
            {"accessors", buffer.accessors},
            {"bufferViews", buffer.views},
            {"buffers", {{{"byteLength", buffer.bytes.size()}}}}};
  if (!mesh.extras_json.empty()) json["asset"]["extras"] = Json::parse(mesh.extras_json);
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (text.size() + buffer.bytes.size() + 64 > kMost) {
    throw InputError("a GLB file holds no more than 4 GB; choose a wider spacing");
  }
  std::string chunks;
  append_chunk(chunks, "JSON", text, ' ');
  append_chunk(chunks, std::string("BIN\0", 4), std::move(buffer.bytes), '\0');
  std::string file = "glTF";
  append(file, std::uint32_t{2});
  append(file, static_cast<std::uint32_t>(12 + chunks.size()));
  return file + chunks;
}

}  // namespace tenku
