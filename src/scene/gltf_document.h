/// A glTF document with its buffers: JSON, and numbers out of accessors. Private to this module.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/json_source.h"

namespace tenku {

/// Numbers of an accessor, one element after the other.
struct AccessorNumbers {
  std::vector<double> values;
  std::size_t components = 1;

  std::size_t size() const { return values.size() / components; }
  Vec3 point(std::size_t k) const { return {values[3 * k], values[3 * k + 1], values[3 * k + 2]}; }
};

/// The JSON of a `.gltf` or `.glb` file and the bytes that it refers to: its binary chunk, `data:`
/// URIs, files beside it.
///
/// Source   The Khronos Group, "glTF 2.0 Specification" (2021), sections 3.6 and 4.4.
class GltfDocument {
 public:
  /// @param bytes   a `.gltf` or `.glb` file
  /// @param folder  of the files that it names
  /// @throws InputError  naming the file: cut off, not JSON, another version
  GltfDocument(std::string bytes, const std::string& name, std::filesystem::path folder);

  JsonElement json() const { return json_; }
  const JsonSource& source() const { return source_; }

  /// Item of a list of the document, such as `meshes`.
  JsonElement item(const char* list, std::size_t index) const;

  /// Bytes of a buffer view.
  std::string_view view(std::size_t buffer_view);

  /// Numbers of an accessor, sparse values put in, normalized integers made fractions.
  /// @param type  `SCALAR` or `VEC3`
  /// @throws InputError if it is of another type or reaches out of its buffer
  AccessorNumbers numbers(std::size_t accessor, std::string_view type);

 private:
  struct Layout;
  void read_glb(std::string_view bytes);
  std::string_view buffer(std::size_t index);
  std::string load(const std::string& uri);
  void read_dense(JsonElement accessor, const Layout& layout, AccessorNumbers& numbers);
  void read_sparse(JsonElement accessor, const Layout& layout, AccessorNumbers& numbers);
  void read_values(std::string_view bytes, std::size_t stride, const Layout& layout,
                   std::size_t count, double* values) const;

  JsonSource source_;
  std::filesystem::path folder_;
  simdjson::dom::parser parser_;
  JsonElement json_;
  std::string bytes_;
  std::optional<std::string_view> binary_;  ///< chunk of a GLB
  mutable std::map<std::string, std::vector<JsonElement>> lists_;
  std::map<std::size_t, std::string> loaded_;  ///< buffers out of URIs
};

}  // namespace tenku
