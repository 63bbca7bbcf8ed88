/// Flaws that are mended while a scene is read: each is counted as a finding.
#pragma once

#include <cstddef>
#include <functional>

#include "scene/raw_scene.h"

namespace tenku {

/// Makes vertices with equal coordinates one, and drops those that no surface uses.
void merge_vertices(RawScene& raw);

/// Takes repeated vertices out of rings; drops rings with fewer than three distinct vertices,
/// and surfaces whose outer ring is one.
void tidy_rings(RawScene& raw);

/// Drops the surfaces of which `is_dropped` says so; it is asked once about each, before any goes.
/// Their vertices stay.
/// @return how many
std::size_t drop_surfaces(RawScene& raw, const std::function<bool(std::size_t)>& is_dropped);

/// Drops surfaces all of whose vertices lie within a micrometre of one line.
void drop_flat_surfaces(RawScene& raw);

/// Closed shells of solids and closed buildings that are inside out are turned; open shells are
/// told.
void orient_shells(RawScene& raw);

/// Gives building surfaces without a type one by their normal.
void type_building_surfaces(RawScene& raw);

/// Tells polygons that are not flat or that cut themselves; they are triangulated as they are.
void check_polygons(RawScene& raw);

}  // namespace tenku
