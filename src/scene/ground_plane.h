/// A ground for a city that has none.
#pragma once

#include "scene/raw_scene.h"

namespace tenku {

/// Adds a horizontal square of type Ground under the scene as the object `tenku:ground`, if the
/// choice asks for it. With `auto`: for a city without terrain, at its lowest point. It reaches
/// beyond the extent by 100 m or three times the height, whichever is more. A finding says so.
void add_ground(RawScene& raw, const GroundChoice& choice);

}  // namespace tenku
