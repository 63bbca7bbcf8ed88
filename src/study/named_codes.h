/// Names in a field: a number for each cell, and a table of what the numbers mean.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>

#include "output/field_writer.h"

namespace tenku {

/// Numbers for names, in the order in which they come.
template <class Key>
class NamedCodes {
 public:
  explicit NamedCodes(std::string name) : codes_{name, {}}, names_{std::move(name), {}} {}

  /// The next cell's. `name_of_key` is called for keys that are new.
  template <class NameOf>
  void add(const Key& key, const NameOf& name_of_key) {
    const auto [found, is_new] = code_.emplace(key, static_cast<std::int32_t>(code_.size()));
    if (is_new) names_.values.emplace_back(name_of_key());
    codes_.codes.push_back(found->second);
  }
  /// Where the name itself is the key.
  void add(const Key& name) {
    add(name, [&] { return name; });
  }
  void move_to(FieldMesh& mesh) {
    mesh.cell_codes.push_back(std::move(codes_));
    mesh.texts.push_back(std::move(names_));
  }

 private:
  FieldCodes codes_;
  FieldText names_;
  std::unordered_map<Key, std::int32_t> code_;
};

}  // namespace tenku
