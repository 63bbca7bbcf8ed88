#include "scene/materials.h"

#include <array>

namespace tenku {
namespace {

constexpr std::array<double, kSurfaceTypes> kReflectance{
    0.30,  // unknown
    0.20,  // ground
    0.35,  // wall
    0.25,  // roof
    0.70,  // ceiling
    0.20,  // floor
    0.10,  // window: what a pane of a facade sends back diffusely, frames and curtains included
    0.30,  // door
    0.15,  // road
    0.07,  // water
    0.20,  // vegetation
};

/// Finds, for each surface, the named material that is most specific.
class MaterialTable {
 public:
  MaterialTable(RawScene& raw, const std::map<std::string, Material>& named);
  void assign();
  void tell_unused();

 private:
  std::uint32_t index_of(const std::string& name);
  std::uint32_t of_object(std::uint32_t object) const;
  std::vector<bool> objects_of_windows() const;

  RawScene& raw_;
  const std::map<std::string, Material>& named_;
  std::map<std::string, std::uint32_t> index_;  ///< of named materials in use
  std::vector<std::uint32_t> by_object_, by_group_, by_file_material_;
  std::array<std::uint32_t, kSurfaceTypes> by_type_{};
};

std::uint32_t MaterialTable::index_of(const std::string& name) {
  const auto found = named_.find(name);
  if (found == named_.end()) return kNone;
  auto& materials = raw_.scene.materials;
  const auto [at, is_new] = index_.try_emplace(name, static_cast<std::uint32_t>(materials.size()));
  if (is_new) materials.push_back(found->second);
  return at->second;
}

MaterialTable::MaterialTable(RawScene& raw, const std::map<std::string, Material>& named)
    : raw_(raw), named_(named) {
  auto& materials = raw.scene.materials;
  materials.clear();
  for (std::uint32_t t = 0; t < kSurfaceTypes; ++t) {
    materials.push_back(default_material(static_cast<SurfaceType>(t)));
  }
  for (std::uint32_t t = 0; t < kSurfaceTypes; ++t) {
    const std::uint32_t own = index_of(std::string(name_of(static_cast<SurfaceType>(t))));
    by_type_[t] = own == kNone ? t : own;
  }
  for (const RawScene::FileMaterial& file_material : raw.file_materials) {
    std::uint32_t at = index_of(file_material.material.name);
    if (at == kNone && file_material.given) {
      at = static_cast<std::uint32_t>(materials.size());
      materials.push_back(file_material.material);
    }
    by_file_material_.push_back(at);
  }
  for (const SceneObject& object : raw.scene.objects) {
    by_object_.push_back(index_of(object.id));
    by_group_.push_back(object.group.empty() ? kNone : index_of(object.group));
  }
}

std::uint32_t MaterialTable::of_object(std::uint32_t object) const {
  // Parents can be circular in a broken file; no sound hierarchy is deeper than this.
  constexpr int kDeepest = 16;
  for (int depth = 0; object != kNone && depth < kDeepest; ++depth) {
    if (by_object_[object] != kNone) return by_object_[object];
    object = raw_.scene.objects[object].parent;
  }
  return kNone;
}

/// Objects that are nothing but windows: their own name means these.
std::vector<bool> MaterialTable::objects_of_windows() const {
  const Surfaces& surfaces = raw_.scene.surfaces;
  std::vector<bool> result(raw_.scene.objects.size(), true);
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces.type[s] != SurfaceType::Window) result[surfaces.object[s]] = false;
  }
  return result;
}

void MaterialTable::assign() {
  Surfaces& surfaces = raw_.scene.surfaces;
  const std::size_t objects = raw_.scene.objects.size();
  std::vector<std::uint32_t> own(objects);
  for (std::uint32_t o = 0; o < objects; ++o) {
    // A group that is an object of its own is told by material first, then as a group.
    const bool is_group = by_group_[o] != kNone && by_object_[o] == by_group_[o];
    own[o] = is_group ? kNone : of_object(o);
  }
  const std::vector<bool> only_windows = objects_of_windows();
  const auto is_glass = [&](std::uint32_t m) { return raw_.scene.materials[m].is_glass(); };
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const std::uint32_t object = surfaces.object[s], file = surfaces.material[s];
    std::uint32_t chosen = by_type_[static_cast<std::size_t>(surfaces.type[s])];
    for (const std::uint32_t more :
         {by_group_[object], file == kNone ? kNone : by_file_material_[file]}) {
      if (more != kNone) chosen = more;
    }
    const bool is_window = surfaces.type[s] == SurfaceType::Window || is_glass(chosen);
    const bool is_meant = !is_window || (only_windows[object] && by_object_[object] != kNone);
    if (own[object] != kNone && (is_meant || is_glass(own[object]))) chosen = own[object];
    surfaces.material[s] = chosen;
  }
}

void MaterialTable::tell_unused() {
  for (const auto& [name, material] : named_) {
    if (index_.contains(name)) continue;
    raw_.findings.add({"unused_material", Severity::Warning, "", name,
                       "no object, material, group or surface type is called '" + name + "'",
                       "check the name in the materials file"});
  }
}

}  // namespace

Material default_material(SurfaceType type) {
  Material material;
  material.name = name_of(type);
  material.reflectance = Rgb::grey(kReflectance[static_cast<std::size_t>(type)]);
  return material;
}

void assign_materials(RawScene& raw, const std::map<std::string, Material>& named) {
  MaterialTable table(raw, named);
  table.assign();
  table.tell_unused();
}

}  // namespace tenku
