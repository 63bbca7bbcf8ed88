/// Reader of Honeybee models.
#pragma once

#include <filesystem>

#include "core/progress.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Reads the rooms, faces, apertures, doors and shades of an `.hbjson` file with their Radiance
/// modifiers. Apertures and doors are cut out of their faces; a face that two rooms share is there
/// once; air boundaries let light pass.
///
/// Source   Ladybug Tools, "Honeybee Schema" (Model, Room, Face, Aperture, Door, Shade, ShadeMesh).
/// @throws InputError  naming file and object, and as `read_input_file`
RawScene read_honeybee(const std::filesystem::path& path, Progress& progress);

}  // namespace tenku
