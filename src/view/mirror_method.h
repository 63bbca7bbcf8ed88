/// How a picture follows mirrors.
#pragma once

#include <string>

namespace tenku {

enum class MirrorMethod {
  Auto,   ///< beams where they are the faster, rays otherwise
  Beams,  ///< regions of the picture whose rays meet the same mirrors
  Rays,   ///< each ray by itself
  Off     ///< mirrors are black but for what they scatter
};

/// What a picture shows of mirrors.
struct MirrorOptions {
  MirrorMethod method = MirrorMethod::Auto;
  int depth = 4;          ///< mirrors in a row
  bool light_all = true;  ///< false: mirrors that scatter nothing are not lit, as only their
                          ///< illuminance would show
};

/// @throws InputError  naming the methods there are: auto, beams, rays, off
MirrorMethod mirror_method_named(const std::string& name);

/// @throws InputError  if the depth is not in 0..64
void check_mirror_depth(int depth);

}  // namespace tenku
