#include <utility>

#include "scene/gltf_scene.h"
#include "scene/input_file.h"
#include "scene/mesh_readers.h"

namespace tenku {

RawScene read_gltf(const std::filesystem::path& path, Progress& progress) {
  GltfDocument document(read_input_file(path), path.string(), path.parent_path());
  progress.stop_if_cancelled();
  GltfScene scene(progress);
  scene.raw().scene.format = "glTF 2.0";
  scene.raw().axes = kYUpAxes;
  scene.raw().axes_are_given = true;
  FeatureNames features{.are_given = false, .names = feature_ids(document), .tile = path.stem()};
  features.are_given = !features.names.empty();
  scene.add(document, Affine{}, std::move(features));
  return std::move(scene.raw());
}

}  // namespace tenku
