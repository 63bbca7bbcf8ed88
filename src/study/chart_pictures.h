/// The stages of a chart that compare pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "study/lit_scene.h"
#include "study/speed_accuracy.h"
#include "view/camera.h"

namespace tenku {

/// What the pictures of a chart show.
struct ChartView {
  PerspectiveView view;
  int bounces = 5;
};

/// Adds settings of one stage, and the reference that they are held against. All pictures have the
/// exposure of the first one. The scene is kept by reference.
using PictureStage = void(const LitScene& lit, const ChartView& view, std::uint64_t seed,
                          std::vector<ChartSetting>& settings,
                          std::vector<ChartReference>& references);

/// `picture`: engines and levels of detail, `paper` among them, against a picture by slices.
PictureStage add_picture_stage;

/// `mirrors`: by beams, by rays, or not at all, up to some depth.
PictureStage add_mirror_stage;

/// `fly-through`: frames of an arc about what is seen, from points that are lit once, and frame by
/// frame.
PictureStage add_fly_through_stage;

/// Whether the scene has mirrors to compare.
bool has_mirrors(const LitScene& lit);

}  // namespace tenku
