/// What shines on the scene.
#pragma once

#include <memory>
#include <optional>

#include "illuminance/element_sky.h"
#include "illuminance/sky_table.h"
#include "sky_models/make_sky.h"
#include "sky_models/sky_model.h"
#include "sky_models/sky_partition.h"

namespace tenku {

/// The sky as a table (null: none) and the sun (zero illuminance: none).
struct DaylightSource {
  std::unique_ptr<SkyTable> sky;
  std::unique_ptr<ElementSky> elements;  ///< asked for by hand: sensors sum these, not slices
  SolarDisc sun;
  const SkyModel* model = nullptr;            ///< of the sky, not owned; null: none
  std::optional<PartitionRequest> partition;  ///< that `elements` were asked for by

  /// Illuminance of the unobstructed horizontal plane from both, lux.
  double unobstructed_lux() const;
  /// Of the sky, 0 where sensors sum slices.
  std::size_t element_count() const { return elements ? elements->size() : 0; }
};

/// Sun and skylight of a sky, whose model it refers to.
/// @param partition  the elements of the sky, where they are asked for by hand
/// @throws InputError as `partition_sky`
DaylightSource daylight_of(const Sky& sky,
                           const std::optional<PartitionRequest>& partition = std::nullopt);

}  // namespace tenku
