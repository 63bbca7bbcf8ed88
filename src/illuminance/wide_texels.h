/// Regions whose shadow maps are coarser than their tolerance asks.
#pragma once

#include <optional>
#include <span>

#include "core/finding.h"
#include "illuminance/planned_region.h"
#include "scene/file_frame.h"

namespace tenku {

/// A finding if maps had wider texels than wanted, as there are only so many regions and texels.
/// Counts the regions and names the middle of the worst. What is narrower than a texel and joined
/// to nothing wider may be missed; the intervals hold it on the whole, as they come from pilots.
/// @param frame  of the scene, for the place in its file
std::optional<Finding> wide_texels(std::span<const PlannedRegion> regions, const FileFrame& frame);

}  // namespace tenku
