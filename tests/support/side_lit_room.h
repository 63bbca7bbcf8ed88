/// The room that several tests take.
#pragma once

#include "support/test_scene.h"

namespace tenku::testing_support {

/// Room of 6 x 8 x 3 m with an opening of 3 x 1.5 m in its south wall, in the open; walls reflect
/// 0.5, the floor 0.2, the ceiling 0.7.
inline TestScene side_lit_room() {
  TestScene scene;
  scene.materials = {grey_material(0.5), grey_material(0.2), grey_material(0.7)};
  scene.level({0, 0, 6, 8}, 0, 1);
  scene.level({0, 0, 6, 8}, 3, 2);
  scene.wall({0, 0, 0, 8}, 0, 3);
  scene.wall({6, 0, 6, 8}, 0, 3);
  scene.wall({0, 8, 6, 8}, 0, 3);
  scene.wall({0, 0, 1.5, 0}, 0, 3);
  scene.wall({4.5, 0, 6, 0}, 0, 3);
  scene.wall({1.5, 0, 4.5, 0}, 0, 0.9);
  scene.wall({1.5, 0, 4.5, 0}, 2.4, 3);
  return scene;
}

}  // namespace tenku::testing_support
