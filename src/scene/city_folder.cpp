#include "scene/city_folder.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/error.h"
#include "scene/georeference.h"

namespace tenku {
namespace fs = std::filesystem;
namespace {

void refuse_other_place(const RawScene& city, const RawScene& tile, const fs::path& file) {
  const bool is_same_crs =
      city.crs == tile.crs || (!city.crs.empty() && !tile.crs.empty() &&
                               Crs::parse(city.crs).id == Crs::parse(tile.crs).id);
  if (!is_same_crs || city.has_registry_axes != tile.has_registry_axes) {
    throw InputError(file.string() + ": the coordinate reference system '" + tile.crs +
                     "' is not that of the tiles before it, '" + city.crs + "'");
  }
  if (city.place || tile.place) {
    throw InputError(file.string() + ": a tile with a place of its own cannot be joined to others");
  }
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Adds `by` to all but the first `kept`, leaving kNone as it is.
void append_shifted(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& from,
                    std::size_t by, std::size_t skipped = 0) {
  for (std::size_t k = skipped; k < from.size(); ++k) {
    to.push_back(from[k] == kNone ? kNone : from[k] + static_cast<std::uint32_t>(by));
  }
}

void append_lods(Scene& city, const Scene& tile) {
  for (const std::uint8_t lod : tile.surfaces.lod) {
    const std::string& label = tile.lods[lod];
    auto at = std::find(city.lods.begin(), city.lods.end(), label);
    if (at == city.lods.end()) {
      if (city.lods.size() == 255) throw InputError("there are more than 255 levels of detail");
      at = city.lods.insert(at, label);
    }
    city.surfaces.lod.push_back(static_cast<std::uint8_t>(at - city.lods.begin()));
  }
  for (const auto& [label, triangles] : tile.lod_triangles) {
    city.lod_triangles[label] += triangles;
  }
}

void append_surfaces(RawScene& city, const RawScene& tile) {
  Surfaces& to = city.scene.surfaces;
  const Surfaces& from = tile.scene.surfaces;
  const std::size_t vertices = to.vertex.size(), rings = to.first_vertex.size() - 1;
  append_shifted(to.vertex, from.vertex, city.scene.vertices.size());
  append_shifted(to.first_vertex, from.first_vertex, vertices, 1);
  append_shifted(to.first_ring, from.first_ring, rings, 1);
  append(to.type, from.type);
  append_shifted(to.object, from.object, city.scene.objects.size());
  append_shifted(to.material, from.material, city.file_materials.size());
  append_shifted(to.shell, from.shell, city.is_inner_shell.size());
}

void append_objects(Scene& city, std::vector<SceneObject> objects) {
  const auto first = static_cast<std::uint32_t>(city.objects.size());
  for (SceneObject& object : objects) {
    if (object.parent != kNone) object.parent += first;
    city.objects.push_back(std::move(object));
  }
}

}  // namespace

std::vector<fs::path> files_in(const fs::path& folder,
                               const std::function<bool(const fs::path&)>& is_wanted) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; entry != end && !error;
       entry.increment(error)) {
    if (entry->is_regular_file() && is_wanted(entry->path())) files.push_back(entry->path());
  }
  if (error) throw InputError("cannot read the folder " + folder.string() + ": " + error.message());
  // The order of a folder is that of its file system; that of names is the same everywhere.
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> tiles_in(const fs::path& folder,
                               const std::function<bool(const fs::path&)>& is_tile) {
  std::vector<fs::path> tiles = files_in(folder, is_tile);
  if (tiles.empty()) {
    throw InputError(folder.string() + " is a folder without scene files that could be tiles");
  }
  return tiles;
}

void append_tile(RawScene& city, RawScene tile, const fs::path& file) {
  refuse_other_place(city, tile, file);
  if (city.scene.vertices.size() + tile.scene.vertices.size() >= kNone) {
    throw InputError(file.string() + ": more than 4 billion vertices with the tiles before");
  }
  append_surfaces(city, tile);
  append_lods(city.scene, tile.scene);
  append_objects(city.scene, std::move(tile.scene.objects));
  append(city.scene.vertices, tile.scene.vertices);
  append(city.file_materials, tile.file_materials);
  append(city.is_building, tile.is_building);
  append(city.is_inner_shell, tile.is_inner_shell);
  city.scene.is_city |= tile.scene.is_city;
  city.scene.has_terrain |= tile.scene.has_terrain;
  city.shares_vertices &= tile.shares_vertices;
  if (city.scene.format != tile.scene.format) city.scene.format = "several formats";
  for (const Finding& finding : tile.findings.take()) city.findings.add(finding);
}

}  // namespace tenku
