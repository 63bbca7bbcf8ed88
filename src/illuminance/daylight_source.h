/// What shines on the scene.
#pragma once

#include <memory>

#include "illuminance/sky_table.h"
#include "sky_models/sky_model.h"

namespace tenku {

/// The sky as a table (null: none) and the sun (zero illuminance: none).
struct DaylightSource {
  std::unique_ptr<SkyTable> sky;
  SolarDisc sun;

  /// Illuminance of the unobstructed horizontal plane from both, lux.
  double unobstructed_lux() const;
};

}  // namespace tenku
