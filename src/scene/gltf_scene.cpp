#include "scene/gltf_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "scene/gltf_draco.h"
#include "scene/obj_reader.h"

namespace tenku {
namespace {

/// A file of a few kilobytes can ask for one mesh a million times.
constexpr std::size_t kMostTriangles = 100'000'000;

/// What must be understood to see the shapes right; all else of KHR_materials and KHR_texture is
/// about looks.
constexpr std::array<std::string_view, 8> kUnderstood{
    "KHR_draco_mesh_compression", "KHR_mesh_quantization",   "CESIUM_RTC",
    "EXT_structural_metadata",    "EXT_mesh_features",       "EXT_texture_webp",
    "KHR_lights_punctual",        "CESIUM_primitive_outline"};

bool is_understood(std::string_view name) {
  return name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") ||
         std::find(kUnderstood.begin(), kUnderstood.end(), name) != kUnderstood.end();
}

Affine matrix_of(JsonElement matrix, const JsonSource& source) {
  const auto m = source.numbers(matrix, 16, "matrix");
  return {{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}}, {m[12], m[13], m[14]}};
}

/// Of a quaternion x, y, z, w of any length but zero.
Affine rotation_of(const std::vector<double>& q, const JsonSource& source) {
  const double norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(norm > 0.0) || !std::isfinite(norm)) source.refuse("a rotation has no direction");
  const double s = 2.0 / norm, x = q[0], y = q[1], z = q[2], w = q[3];
  return {{{{1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
            {s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)},
            {s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)}}},
          {}};
}

Affine frame_of(JsonElement node, const JsonSource& source) {
  if (const auto matrix = JsonSource::member(node, "matrix")) return matrix_of(*matrix, source);
  Affine frame;
  if (const auto scale = JsonSource::member(node, "scale")) {
    const Vec3 s = source.point(*scale, "scale");
    frame.columns = {{{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}}};
  }
  if (const auto rotation = JsonSource::member(node, "rotation")) {
    frame = rotation_of(source.numbers(*rotation, 4, "rotation"), source) * frame;
  }
  if (const auto translation = JsonSource::member(node, "translation")) {
    frame = Affine::moved(source.point(*translation, "translation")) * frame;
  }
  return frame;
}

/// Corners of triangles out of the indices of a list, a strip or a fan.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<std::uint32_t>& indices,
                                                       std::size_t mode) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const std::size_t count = indices.size();
  if (mode == 4) {
    for (std::size_t k = 0; k + 2 < count; k += 3) {
      triangles.push_back({indices[k], indices[k + 1], indices[k + 2]});
    }
  }
  for (std::size_t k = 0; mode == 5 && k + 2 < count; ++k) {
    triangles.push_back({indices[k], indices[k + 1 + k % 2], indices[k + 2 - k % 2]});
  }
  for (std::size_t k = 1; mode == 6 && k + 1 < count; ++k) {
    triangles.push_back({indices[k], indices[k + 1], indices[0]});
  }
  return triangles;
}

}  // namespace

struct GltfScene::Node {
  std::size_t index;
  Affine parent;
};

struct GltfScene::Primitive {
  std::vector<Vec3> points;
  std::vector<double> features;  ///< [point], or none
  std::vector<std::uint32_t> indices;
  std::size_t mode = 4;
  std::uint32_t material = kNone;
};

void GltfScene::tell(Severity severity, const char* code, const std::string& what,
                     const char* repair) {
  raw_.findings.add({code, severity, "", document_->source().place(), what, repair});
}

void GltfScene::check_extensions() {
  const JsonSource& source = document_->source();
  for (const JsonElement name : source.list(document_->json(), "extensionsRequired")) {
    std::string_view text;
    if (name.get(text) != simdjson::SUCCESS) source.refuse("'extensionsRequired' should be names");
    if (is_understood(text)) continue;
    source.refuse("the file cannot be read without the extension " + std::string(text) +
                  ", which is not understood here");
  }
  for (const JsonElement name : source.list(document_->json(), "extensionsUsed")) {
    std::string_view text;
    if (name.get(text) != simdjson::SUCCESS) continue;
    if (text == "EXT_mesh_gpu_instancing") {
      tell(Severity::Warning, "ignored_instances", "meshes are repeated by EXT_mesh_gpu_instancing",
           "each is read once");
    } else if (text == "KHR_lights_punctual") {
      tell(Severity::Note, "ignored_light", "lights without a surface are not read", "left out");
    }
  }
}

void GltfScene::read_materials() {
  const JsonSource& source = document_->source();
  first_material_ = static_cast<std::uint32_t>(raw_.file_materials.size());
  for (const JsonElement material : source.list(document_->json(), "materials")) {
    raw_.file_materials.push_back(gltf_material(material, source, raw_));
  }
}

/// Nodes of the scene that is shown; of a file without scenes those that are no other's child.
std::vector<std::size_t> GltfScene::roots() const {
  const JsonSource& source = document_->source();
  const JsonElement json = document_->json();
  if (JsonSource::member(json, "scenes")) {
    const std::size_t shown = source.whole_if_given(json, "scene").value_or(0);
    return source.wholes(document_->item("scenes", shown), "nodes");
  }
  const std::vector<JsonElement> nodes = source.list(json, "nodes");
  std::vector<std::uint8_t> is_child(nodes.size());
  for (const JsonElement node : nodes) {
    for (const std::size_t child : source.wholes(node, "children")) {
      if (child < nodes.size()) is_child[child] = 1;
    }
  }
  std::vector<std::size_t> roots;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (is_child[k] == 0) roots.push_back(k);
  }
  return roots;
}

void GltfScene::add(GltfDocument& document, const Affine& frame, FeatureNames features) {
  document_ = &document;
  features_ = std::move(features);
  check_extensions();
  read_materials();
  if (JsonSource::member(document.json(), "animations") ||
      JsonSource::member(document.json(), "skins")) {
    tell(Severity::Note, "ignored_animation", "animations and skins are not read",
         "meshes are as they rest");
  }
  std::vector<std::uint8_t> met(document.source().list(document.json(), "nodes").size());
  std::vector<Node> open;
  for (const std::size_t root : roots()) open.push_back({root, frame});
  std::reverse(open.begin(), open.end());
  while (!open.empty()) {
    progress_.stop_if_cancelled();
    const Node node = open.back();
    open.pop_back();
    add_node(node.index, node.parent, open, met);
  }
}

void GltfScene::add_node(std::size_t index, const Affine& parent, std::vector<Node>& open,
                         std::vector<std::uint8_t>& met) {
  const JsonSource& source = document_->source();
  const JsonElement node = document_->item("nodes", index);
  if (met[index] != 0) source.refuse("node " + std::to_string(index) + " hangs in two places");
  met[index] = 1;
  const Affine frame = parent * frame_of(node, source);
  if (const auto mesh = source.whole_if_given(node, "mesh")) {
    add_mesh(*mesh, source.text(node, "name"), index, frame);
  }
  const std::size_t first = open.size();
  for (const std::size_t child : source.wholes(node, "children")) open.push_back({child, frame});
  std::reverse(open.begin() + static_cast<std::ptrdiff_t>(first), open.end());
}

void GltfScene::add_mesh(std::size_t index, const std::string& node_name, std::size_t node,
                         const Affine& frame) {
  const JsonSource& source = document_->source();
  const JsonElement mesh = document_->item("meshes", index);
  std::string name = node_name.empty() ? source.text(mesh, "name") : node_name;
  if (name.empty()) name = "node " + std::to_string(node);
  for (const JsonElement primitive : source.list(mesh, "primitives")) {
    progress_.stop_if_cancelled();
    Primitive read;
    read.mode = source.whole_if_given(primitive, "mode").value_or(4);
    if (read.mode > 6)
      source.refuse("the mode " + std::to_string(read.mode) + " of a mesh is not known");
    if (read.mode < 4) {
      tell(Severity::Note, "not_a_surface", "points and lines neither cast nor receive light",
           "left out");
      continue;
    }
    if (JsonSource::member(primitive, "targets")) {
      tell(Severity::Note, "ignored_animation", "animations and skins are not read",
           "meshes are as they rest");
    }
    read_primitive(primitive, read);
    add_primitive(read, name, frame);
  }
}

void GltfScene::read_primitive(JsonElement primitive, Primitive& to) {
  const JsonSource& source = document_->source();
  if (const auto material = source.whole_if_given(primitive, "material")) {
    document_->item("materials", *material);
    to.material = first_material_ + static_cast<std::uint32_t>(*material);
  }
  const auto attributes = JsonSource::member(primitive, "attributes");
  const auto position = attributes ? source.whole_if_given(*attributes, "POSITION") : std::nullopt;
  if (!position) source.refuse("a mesh has no positions");
  const char* feature_key = "_BATCHID";
  for (const char* key : {"_BATCHID", "_FEATURE_ID_0"}) {
    if (JsonSource::member(*attributes, key)) feature_key = key;
  }
  const auto extensions = JsonSource::member(primitive, "extensions");
  const auto packed =
      extensions ? JsonSource::member(*extensions, "KHR_draco_mesh_compression") : std::nullopt;
  if (packed) {
    const auto ids = JsonSource::member(*packed, "attributes");
    if (!ids) source.refuse("a mesh packed by Draco has no 'attributes'");
    const auto feature =
        features_.are_given ? source.whole_if_given(*ids, feature_key) : std::nullopt;
    DracoMesh mesh = unpack_draco(document_->view(source.whole(*packed, "bufferView")),
                                  source.whole(*ids, "POSITION"), feature, source);
    to.mode = 4;  // whatever the packed mesh was made of
    to.points = std::move(mesh.points);
    to.features = std::move(mesh.features);
    to.indices = std::move(mesh.indices);
    return;
  }
  const AccessorNumbers points = document_->numbers(*position, "VEC3");
  to.points.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) to.points.push_back(points.point(k));
  const auto feature = source.whole_if_given(*attributes, feature_key);
  if (features_.are_given && feature) to.features = document_->numbers(*feature, "SCALAR").values;
  if (const auto indices = source.whole_if_given(primitive, "indices")) {
    for (const double index : document_->numbers(*indices, "SCALAR").values) {
      if (!(index >= 0.0 && index < static_cast<double>(to.points.size()))) {
        source.refuse("a vertex index is out of range: there are " +
                      std::to_string(to.points.size()) + " vertices");
      }
      to.indices.push_back(static_cast<std::uint32_t>(index));
    }
  } else {
    for (std::uint32_t k = 0; k < to.points.size(); ++k) to.indices.push_back(k);
  }
}

std::string GltfScene::feature_name(double feature) const {
  const bool is_named = feature >= 0.0 && feature < static_cast<double>(features_.names.size());
  if (is_named) {
    const std::string& name = features_.names[static_cast<std::size_t>(feature)];
    if (!name.empty()) return name;
  }
  return features_.tile + "/" + std::to_string(static_cast<long long>(std::llround(feature)));
}

void GltfScene::add_primitive(const Primitive& primitive, const std::string& object,
                              const Affine& frame) {
  const JsonSource& source = document_->source();
  auto triangles = triangles_of(primitive.indices, primitive.mode);
  triangles_ += triangles.size();
  Scene& scene = raw_.scene;
  if (triangles_ > kMostTriangles || scene.vertices.size() + primitive.points.size() >= kNone) {
    source.refuse("more than 100 million triangles");
  }
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const Vec3 p : primitive.points) {
    const Vec3 placed = frame(p);
    if (!is_finite(placed)) source.refuse("a coordinate of '" + object + "' is not finite");
    scene.vertices.push_back(placed);
  }
  SurfaceFacts facts;
  facts.material = primitive.material;
  if (facts.material != kNone) {
    facts.type = type_by_name(raw_.file_materials[facts.material].material.name);
  }
  if (facts.type == SurfaceType::Unknown) facts.type = type_by_name(object);
  scene.has_terrain |= facts.type == SurfaceType::Ground || facts.type == SurfaceType::Road;
  const bool by_feature =
      primitive.features.size() == primitive.points.size() && !primitive.features.empty();
  if (!by_feature) facts.object = objects_.find_or_add(raw_, object);
  double last = std::nan("");
  const bool is_mirrored = frame.determinant() < 0.0;
  for (auto [a, b, c] : triangles) {
    if (by_feature && primitive.features[a] != last) {
      last = primitive.features[a];
      facts.object = objects_.find_or_add(raw_, feature_name(last));
    }
    if (is_mirrored) std::swap(b, c);
    for (const std::uint32_t v : {a, b, c}) scene.surfaces.vertex.push_back(first + v);
    end_ring(scene.surfaces);
    end_surface(scene.surfaces, facts);
  }
}

}  // namespace tenku
