/// Which tiles of a city change the light at a place. Private to this module.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/raw_scene.h"
#include "scene/tile_head.h"

namespace tenku {

/// What is done with a tile.
enum class TileUse : std::uint8_t {
  Whole,
  Coarse,  ///< read at LOD 1
  Out
};

struct TileChoice {
  std::vector<TileUse> use;  ///< [tile]
  double least_out_m = 0.0;  ///< distance of the nearest tile left out, beyond the place
  double coarse_m = 0.0;     ///< distance from which on tiles are read at LOD 1
};

/// Chooses tiles by how high they rise over the horizon of the place.
///
/// A skyline that is wrong by an angle all around takes 4 / pi of it from the light of a wall
/// (`skyline_angle`). Tiles that rise by less than the angle that takes a tenth of the tolerance
/// are left out. Where roofs that are wrong by 3 m, as those of LOD 1 may be, are seen under less,
/// tiles are read at LOD 1. Heights count from the lowest point of the tiles at the place.
///
/// A tile that does not tell where it lies is read whole.
/// @throws InputError if no tile reaches into the place, or its reference system is not known
TileChoice choose_tiles(std::span<const TileHead> tiles, const PlaceLookedAt& place,
                        const ReadOptions& options);

/// What was chosen, as findings.
void tell_of_tiles(const TileChoice& choice, const PlaceLookedAt& place, const ReadOptions& options,
                   FindingCounter& findings);

}  // namespace tenku
