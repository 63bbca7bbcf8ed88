#include "scene/read_scene.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "scene/city_folder.h"
#include "scene/citygml_reader.h"
#include "scene/cityjson_reader.h"
#include "scene/geometry_checks.h"
#include "scene/ground_plane.h"
#include "scene/honeybee_reader.h"
#include "scene/input_file.h"
#include "scene/materials.h"
#include "scene/mesh_readers.h"
#include "scene/near_tiles.h"
#include "scene/obj_reader.h"
#include "scene/placement.h"
#include "scene/radiance_reader.h"
#include "scene/repair.h"
#include "scene/set_on_ground.h"
#include "scene/solid_checks.h"
#include "scene/strict.h"
#include "scene/terrain.h"
#include "scene/terrain_reader.h"
#include "scene/text_cursor.h"
#include "scene/tile_head.h"
#include "scene/tileset_reader.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

const std::string kCoarseLod = "1";  // of tiles far away

enum class Format { CityJson, CityGml, Obj, Ply, Stl, Gltf, Honeybee, Tileset, Radiance, Terrain };

struct Ending {
  std::string_view text;
  Format format;
};
constexpr std::array<Ending, 16> kEndings{{{"tileset.json", Format::Tileset},
                                           {".b3dm", Format::Tileset},
                                           {".json", Format::CityJson},
                                           {".jsonl", Format::CityJson},
                                           {".gml", Format::CityGml},
                                           {".citygml", Format::CityGml},
                                           {".xml", Format::CityGml},
                                           {".obj", Format::Obj},
                                           {".ply", Format::Ply},
                                           {".stl", Format::Stl},
                                           {".gltf", Format::Gltf},
                                           {".glb", Format::Gltf},
                                           {".hbjson", Format::Honeybee},
                                           {".rad", Format::Radiance},
                                           {".tif", Format::Terrain},
                                           {".tiff", Format::Terrain}}};

std::optional<Format> known_format(const fs::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  for (const Ending& ending : kEndings) {
    if (name.ends_with(ending.text)) return ending.format;
  }
  return std::nullopt;
}

Format format_of(const fs::path& path) {
  if (const auto format = known_format(path)) return *format;
  throw InputError(
      path.string() +
      ": the format is not known by this name; scenes are .city.json, .city.jsonl, "
      ".gml, .obj, .gltf, .glb, .hbjson, .ply, .stl, .rad, .tif, tileset.json or .b3dm, or "
      "one of them with .gz");
}

RawScene read_file(const fs::path& path, const ReadOptions& options, Progress& progress) {
  switch (format_of(path)) {
    case Format::Obj:
      return read_obj(path, progress);
    case Format::CityGml:
      return read_citygml(path, options.building_lod, progress);
    case Format::Ply:
      return read_ply(path, progress);
    case Format::Stl:
      return read_stl(path, progress);
    case Format::Gltf:
      return read_gltf(path, progress);
    case Format::Honeybee:
      return read_honeybee(path, progress);
    case Format::Tileset:
      return read_tileset(path, progress);
    case Format::Radiance:
      return read_radiance(path, progress);
    case Format::Terrain:
      return read_terrain(path, options.crs, progress);
    case Format::CityJson:
      break;
  }
  std::string bytes = read_input_file(path);
  progress.stop_if_cancelled();
  return read_cityjson(std::move(bytes), path.string(), options.building_lod, progress);
}

bool is_city_file(const fs::path& path) {
  const std::optional<Format> format = known_format(path);
  return format == Format::CityGml || format == Format::CityJson;
}

bool is_terrain_file(const fs::path& path) { return known_format(path) == Format::Terrain; }

void add_tiles(RawScene& city, std::span<const fs::path> tiles, const ReadOptions& options,
               Progress& progress) {
  for (const fs::path& tile : tiles) append_tile(city, read_file(tile, options, progress), tile);
}

RawScene read_tiles(std::span<const fs::path> tiles, const ReadOptions& options,
                    Progress& progress) {
  RawScene city = read_file(tiles[0], options, progress);
  add_tiles(city, tiles.subspan(1), options, progress);
  return city;
}

/// What changes the light at the place of the options.
RawScene read_around(const std::vector<fs::path>& tiles, const ReadOptions& options,
                     Progress& progress) {
  std::vector<TileHead> heads;
  for (const fs::path& tile : tiles) {
    heads.push_back(format_of(tile) == Format::CityGml ? head_of_citygml(tile, progress)
                                                       : head_of_cityjson(tile));
    progress.stop_if_cancelled();
  }
  const TileChoice choice = choose_tiles(heads, *options.around, options);
  std::vector<fs::path> whole, coarse;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (choice.use[t] == TileUse::Whole) whole.push_back(tiles[t]);
    if (choice.use[t] == TileUse::Coarse) coarse.push_back(tiles[t]);
  }
  RawScene city = read_tiles(whole, options, progress);
  ReadOptions at_lod_1 = options;
  at_lod_1.building_lod = kCoarseLod;
  add_tiles(city, coarse, at_lod_1, progress);
  tell_of_tiles(choice, *options.around, options, city.findings);
  return city;
}

/// A file, or a folder of tiles.
RawScene read_raw(const fs::path& path, const ReadOptions& options, Progress& progress) {
  if (!fs::is_directory(path)) return read_file(path, options, progress);
  if (fs::exists(path / "tileset.json")) return read_tileset(path / "tileset.json", progress);
  const std::vector<fs::path> tiles = tiles_in(path, is_city_file);
  return options.around ? read_around(tiles, options, progress)
                        : read_tiles(tiles, options, progress);
}

/// Those of the options, then those in the folder of the city.
std::vector<fs::path> terrain_files(const fs::path& path, const ReadOptions& options) {
  std::vector<fs::path> files = options.terrain;
  if (fs::is_directory(path) && !fs::exists(path / "tileset.json")) {
    for (fs::path& file : files_in(path, is_terrain_file)) files.push_back(std::move(file));
  }
  return files;
}

/// What the scene stands on.
void set_down(RawScene& raw, const fs::path& path, const ReadOptions& options, Progress& progress) {
  const Extent box = extent_of_surfaces(raw.scene);
  add_terrain(raw, terrain_files(path, options), options, progress);
  if (raw.scene.has_terrain) check_on_ground(raw, GroundHeights(raw, box));
  add_ground(raw, options.ground);
}

void refuse_empty(const RawScene& raw, const fs::path& path, const char* which) {
  if (raw.scene.surfaces.size() > 0 && !raw.scene.vertices.empty()) return;
  throw InputError(path.string() + ": there are no surfaces" + which + " in it");
}

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// Sums and products of lengths stay finite below it, and no map, in whatever unit, reaches it.
constexpr double kLargestCoordinate = 1e12;

void refuse_huge(const RawScene& raw, const fs::path& path) {
  for (const Vec3 v : raw.scene.vertices) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest <= kLargestCoordinate) continue;
    char number[32];
    std::snprintf(number, sizeof number, "%g", largest);
    throw InputError(path.string() + ": a coordinate of " + number + " is beyond all measure");
  }
}

bool is_of_the_ground(SurfaceType type) {
  return type == SurfaceType::Ground || type == SurfaceType::Road || type == SurfaceType::Water ||
         type == SurfaceType::Vegetation;
}

/// A city as a plain mesh: what no name tells apart is a building.
void mark_buildings(RawScene& raw) {
  if (!raw.is_mesh || !raw.scene.is_city) return;
  const Surfaces& surfaces = raw.scene.surfaces;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (!is_of_the_ground(surfaces.type[s])) raw.is_building[surfaces.object[s]] = 1;
  }
}

void count_mesh_triangles(RawScene& raw) {
  Scene& scene = raw.scene;
  if (!raw.is_mesh) return;
  const std::size_t rings = scene.surfaces.first_vertex.size() - 1;
  scene.lod_triangles[""] = scene.surfaces.vertex.size() + 2 * rings - 4 * scene.surfaces.size();
}

void repair(RawScene& raw, Progress& progress) {
  tidy_rings(raw);
  progress.stop_if_cancelled();
  orient_shells(raw);
  type_building_surfaces(raw);
  progress.stop_if_cancelled();
  drop_flat_surfaces(raw);
  check_polygons(raw);
  progress.stop_if_cancelled();
}

}  // namespace

GroundChoice GroundChoice::parse(const std::string& text) {
  if (text == "auto") return {Kind::Auto, 0.0};
  if (text == "none") return {Kind::None, 0.0};
  const auto height = finite_number(text);
  if (!height) throw InputError("--ground is 'auto', 'none' or a height, not '" + text + "'");
  return {Kind::Height, *height};
}

PlaceLookedAt PlaceLookedAt::parse(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(finite_number(text.substr(begin, end - begin)).value_or(kNoNumber));
    begin = end + 1;
  }
  const bool are_numbers = std::none_of(numbers.begin(), numbers.end(),
                                        [](double number) { return std::isnan(number); });
  if (numbers.size() != 3 || !are_numbers || !(numbers[2] > 0.0)) {
    throw InputError(
        "--around is x,y in the coordinates of the file and a distance in metres, not '" + text +
        "'");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

OnTerrain on_terrain_named(const std::string& text) {
  if (text == "auto") return OnTerrain::Auto;
  if (text == "keep") return OnTerrain::Keep;
  if (text == "move") return OnTerrain::Move;
  throw InputError("--on-terrain is 'auto', 'keep' or 'move', not '" + text + "'");
}

Scene read_scene(const fs::path& path, const ReadOptions& options, Progress& progress) {
  progress.begin("reading the scene", 0);
  const auto named =
      options.materials ? read_materials(*options.materials) : std::map<std::string, Material>{};
  RawScene raw = read_raw(path, options, progress);
  refuse_empty(raw, path, "");
  count_mesh_triangles(raw);
  merge_vertices(raw);
  refuse_empty(raw, path, " with vertices");
  refuse_huge(raw, path);
  place_scene(raw, options);
  mark_buildings(raw);
  repair(raw, progress);
  refuse_empty(raw, path, " that have an area");
  check_geometry(raw);
  check_solids(raw);
  progress.stop_if_cancelled();
  set_down(raw, path, options, progress);
  if (options.strict) refuse_mended(raw, path);
  assign_materials(raw, named);
  raw.scene.findings = raw.findings.take();
  progress.end(std::to_string(raw.scene.objects.size()) + " objects, " +
               std::to_string(raw.scene.surfaces.size()) + " surfaces");
  return std::move(raw.scene);
}

}  // namespace tenku
