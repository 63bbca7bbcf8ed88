#include "view/mirror_method.h"

#include "core/error.h"

namespace tenku {

MirrorMethod mirror_method_named(const std::string& name) {
  if (name == "auto") return MirrorMethod::Auto;
  if (name == "beams") return MirrorMethod::Beams;
  if (name == "rays") return MirrorMethod::Rays;
  if (name == "off") return MirrorMethod::Off;
  throw InputError("cannot follow mirrors by '" + name + "'; there are auto, beams, rays and off");
}

void check_mirror_depth(int depth) {
  constexpr int kDeepest = 64;
  if (depth < 0 || depth > kDeepest) {
    throw InputError("depth " + std::to_string(depth) + " of mirrors is not within 0..64");
  }
}

}  // namespace tenku
