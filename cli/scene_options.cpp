#include "cli/scene_options.h"

#include <cmath>

#include "cli/option_list.h"
#include "core/error.h"

namespace tenku {
namespace {

UpAxis up_axis(const std::string& text) {
  if (text == "auto") return UpAxis::ByFormat;
  if (text == "y") return UpAxis::Y;
  if (text == "z") return UpAxis::Z;
  throw InputError("--up is 'y' or 'z', not '" + text + "'");
}

}  // namespace

void add_scene_options(OptionList& app, SceneOptions& options) {
  app.add_option(
         "SCENE", options.scene,
         "scene file (.city.json, .city.jsonl, .gml, .obj, .gltf, .glb, .hbjson, .ply, .stl, "
         ".rad, also with .gz) or folder of tiles")
      .required();
  app.add_option("--materials", options.materials, "TOML file of materials by name");
  app.add_option("--rotate", options.rotate_deg, "turn the model clockwise by degrees");
  app.add_option("--scale", options.scale, "metres per unit of the file (default 1)");
  app.add_option("--up", options.up, "axis of the file that points up: y or z");
  app.add_option("--crs", options.crs,
                 "coordinate reference system of the file, such as EPSG:6677");
  app.add_option("--ground", options.ground,
                 "auto (under a city without terrain), none, or a height of the file");
  app.add_option("--terrain", options.terrain,
                 "GeoTIFF of heights under and around the scene; may be given again")
      .given_again();
  app.add_option(
      "--on-terrain", options.on_terrain,
      "auto (moves buildings onto the terrain if all stand at one height), keep or move");
  app.add_option(
      "--around", options.around,
      "x,y in the coordinates of the file, and metres: grids lie within that of it to east, "
      "west, north and south, and of a folder the tiles are read that matter there");
  app.add_flag("--strict", options.strict,
               "refuse a scene of which something would be mended, left out or guessed");
  app.add_option("--building-lod", options.building_lod,
                 "level of detail to read, such as 1 or 2.2 (default: the highest of each object)");
}

ReadOptions read_options(const SceneOptions& options) {
  if (!std::isfinite(options.rotate_deg)) throw InputError("--rotate must be a finite number");
  ReadOptions read;
  read.building_lod = options.building_lod;
  read.rotate = Angle::degrees(options.rotate_deg);
  read.scale = options.scale;
  read.up = up_axis(options.up);
  read.crs = options.crs;
  read.ground = GroundChoice::parse(options.ground);
  read.terrain.assign(options.terrain.begin(), options.terrain.end());
  read.on_terrain = on_terrain_named(options.on_terrain);
  read.strict = options.strict;
  if (!options.around.empty()) read.around = PlaceLookedAt::parse(options.around);
  if (!options.materials.empty()) read.materials = options.materials;
  return read;
}

}  // namespace tenku
