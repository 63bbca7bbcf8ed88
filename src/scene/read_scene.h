/// From a scene file to a scene: the one door for all formats.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/units.h"
#include "scene/scene.h"
#include "site/location.h"

namespace tenku {

/// Horizontal ground under the scene.
struct GroundChoice {
  enum class Kind { Auto, None, Height };
  Kind kind = Kind::Auto;
  double height = 0.0;  ///< in the coordinates of the file, for `Kind::Height`

  /// @param text  `auto`, `none` or a height
  /// @throws InputError otherwise
  static GroundChoice parse(const std::string& text);
};

/// Whether terrain of the options moves buildings: `Auto` where all stand at one height.
enum class OnTerrain { Auto, Keep, Move };
/// @param text  `auto`, `keep` or `move`
/// @throws InputError otherwise
OnTerrain on_terrain_named(const std::string& text);

/// Where a scene is looked at: a square with sides to east and north.
struct PlaceLookedAt {
  double x = 0.0, y = 0.0;  ///< of its middle, in the coordinates of the file
  double half_m = 0.0;      ///< half of a side

  /// @param text  `x,y,half`
  /// @throws InputError unless it is three numbers, the last positive
  static PlaceLookedAt parse(const std::string& text);
};

enum class UpAxis { ByFormat, Y, Z };

/// How to read what the file does not say itself.
struct ReadOptions {
  std::string building_lod;  ///< empty: the highest of each object; or `1`, `2.2`
  Angle rotate;              ///< turns the model clockwise, seen from above
  double scale = 1.0;        ///< metres (or units of the CRS) per unit of the file
  UpAxis up = UpAxis::ByFormat;
  std::string crs;  ///< `EPSG:N`, in place of what the file says
  GroundChoice ground;
  std::vector<std::filesystem::path> terrain;  ///< elevation models beside the scene
  OnTerrain on_terrain = OnTerrain::Auto;
  double tolerance_pct = 2.0;                      ///< to which terrain around the scene is thinned
  std::optional<std::filesystem::path> materials;  ///< TOML
  /// Of a folder of tiles those are read that change the light here.
  std::optional<PlaceLookedAt> around;
  bool strict = false;           ///< refuse what would be mended, left out or guessed
  std::optional<Location> site;  ///< of the local origin, in place of what the file says
};

/// Reads a scene in one of the formats of docs/scene_files.md, by the name of the file and also
/// compressed by gzip, or a folder of tiles.
///
/// Flaws that can be repaired or borne are findings of the scene; the rest is refused.
///
/// @throws InputError  naming the file and the line or object id: file absent, unreadable, cut off,
///                     of another format; coordinate not finite; index out of range; no surfaces
Scene read_scene(const std::filesystem::path& path, const ReadOptions& options, Progress& progress);

}  // namespace tenku
