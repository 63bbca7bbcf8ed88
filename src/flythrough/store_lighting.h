/// What a store keeps of the sun and the sky that light it.
#pragma once

#include <string>

#include "flythrough/point_store.h"
#include "illuminance/daylight_source.h"
#include "sky_models/make_sky.h"

namespace tenku {

/// The sky's map is one degree fine. White is what a white level surface in the open shows, and
/// below the horizon lies an open ground of reflectance 0.2, as in `render_view`.
/// @param time  as it is to be told; may be empty
StoreLighting lighting_of(const Sky& sky, const DaylightSource& source, const std::string& time);

}  // namespace tenku
