/// The triangles of glTF documents, put into one scene. Private to this module.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "scene/affine.h"
#include "scene/gltf_document.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Names of the features (buildings) that the vertices of a document belong to.
struct FeatureNames {
  bool are_given = false;
  std::vector<std::string> names;  ///< [feature], where they are known
  std::string tile;                ///< stands before the number of a feature without a name
};

/// Reads meshes into a scene, one document after the other.
class GltfScene {
 public:
  explicit GltfScene(Progress& progress) : progress_(progress) {
    raw_.is_mesh = true;
    raw_.shares_vertices = false;
    raw_.scene.lods = {""};
  }

  /// @param frame     from the document's axes to the scene file's
  /// @param features  names from outside the document (`b3dm`)
  /// @throws InputError naming the file
  void add(GltfDocument& document, const Affine& frame, FeatureNames features = {});

  RawScene& raw() { return raw_; }

 private:
  struct Node;
  struct Primitive;

  void check_extensions();
  void read_materials();
  std::vector<std::size_t> roots() const;
  void add_node(std::size_t index, const Affine& parent, std::vector<Node>& open,
                std::vector<std::uint8_t>& met);
  void add_mesh(std::size_t index, const std::string& node_name, std::size_t node,
                const Affine& frame);
  void read_primitive(JsonElement primitive, Primitive& to);
  void add_primitive(const Primitive& primitive, const std::string& object, const Affine& frame);
  std::string feature_name(double feature) const;
  void tell(Severity severity, const char* code, const std::string& what, const char* repair);

  Progress& progress_;
  RawScene raw_;
  ObjectsByName objects_;
  GltfDocument* document_ = nullptr;  ///< being read
  FeatureNames features_;
  std::uint32_t first_material_ = 0;  ///< of the document, among those of the scene
  std::size_t triangles_ = 0;
};

/// The centre that the extension CESIUM_RTC gives, in the axes of the scene; zero if there is none.
Vec3 rtc_centre(const GltfDocument& document);

/// Ids of features out of the extension EXT_structural_metadata; none if it has none.
std::vector<std::string> feature_ids(GltfDocument& document);

/// What a material of glTF is like; `given` is false where it says nothing about light.
///
/// Base colour is the diffuse reflectance, brought down to 0.9 where it is more. Metals that are
/// not rough mirror. Transmission and blended opacity let light pass. Emission is in cd/m2.
///
/// Source   "glTF 2.0 Specification" (2021), section 3.9 and appendix B; extensions
///          KHR_materials_transmission, KHR_materials_ior, KHR_materials_emissive_strength.
RawScene::FileMaterial gltf_material(JsonElement material, const JsonSource& source, RawScene& raw);

}  // namespace tenku
