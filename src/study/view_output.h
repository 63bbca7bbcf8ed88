/// Views as picture files.
#pragma once

#include <filesystem>
#include <string>

#include "output/image_writer.h"
#include "study/lit_scene.h"
#include "study/study.h"
#include "view/view_render.h"

namespace tenku {

/// @throws InputError  naming the kinds there are: luminance, illuminance, falsecolor
ViewKind view_kind_named(const std::string& name);

/// @throws InputError  if the ending is not .png, .exr or .hdr
void check_picture_ending(const std::filesystem::path& path);

/// Sets eye and target so that the scene is seen from the south-west, from above, as a whole.
void place_overview(const LitScene& lit, PerspectiveView& view);

/// PNG: tone-mapped, or in false colours with a legend. EXR and HDR: physical values, cd/m2 or lx.
void write_view(const std::filesystem::path& path, const RenderedView& view, ViewKind kind,
                const PictureInfo& info);

/// The picture as `write_view` puts it into a PNG.
Image8 picture_of(const RenderedView& view, ViewKind kind);

}  // namespace tenku
