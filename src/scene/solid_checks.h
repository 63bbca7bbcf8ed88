/// What is wrong with solids among others: told, not mended.
#pragma once

#include "scene/raw_scene.h"

namespace tenku {

/// Adds findings of a scene that is placed and mended:
///  - `shell_in_parts`: a shell of a solid whose parts share no vertex
///  - `inner_shell_outside`: a cavity of a solid that lies outside of it, or leaves it
///  - `overlapping_buildings`: buildings or parts of them that are in one another, by 20 cm or
///  more.
///    Told of the one whose faces are found in the other. Corners and middles of faces are tried,
///    so that a pillar through a wide roof is not found from the roof but from the pillar.
///  - `no_geometry`: objects of a city that have no surfaces, nor have their parts.
///
/// Cost     0.2 s per million surfaces, and 10 us for each face beside another building.
void check_solids(RawScene& raw);

}  // namespace tenku
