/// Sensors on a level plane in a room.
#pragma once

#include "illuminance/sensor.h"
#include "study/lit_scene.h"

namespace tenku {

/// Sensors facing up, in the middles of squares of about `spacing_m`, at a height in the
/// coordinates of the scene file.
///
/// Kept are those with something below them and, if there are any such, something above: what
/// stands outside of the room is left out, and a courtyard has a plane too.
/// @throws InputError  a height that is not finite, a spacing that is not positive, more than a
///                     million sensors, or none
Sensors work_plane(const LitScene& lit, double height, double spacing_m);

}  // namespace tenku
