/// Frames of a store as pictures of luminance.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/rgb.h"
#include "flythrough/point_splat.h"
#include "flythrough/point_store.h"
#include "view/image.h"
#include "view/value_scale.h"

namespace tenku {

/// What of a store is played, and how large.
struct PlaybackRequest {
  std::size_t lighting = 0;
  int width = 0, height = 0;                  ///< pixels; 0: as the store was gathered for
  std::size_t points_in_memory = 16'000'000;  ///< of 56 bytes; more are read again
};

/// How a film is shown, the same for all its frames.
struct FilmTone {
  double exposure = 1.0;  ///< from cd/m2 to light in which 1 is white before the curve
  ValueScale scale;       ///< of false colour, cd/m2
};

/// Luminance that each point shows, cd/m2. Shape  [point].
std::vector<Rgb> shown_luminance(const StoreHeader& header, const StoredPoints& points,
                                 const PointLight& light);

/// Draws the frames whose points are all there.
///
/// Each sample of a pixel shows one point or the sky; a pixel is the mean of its four. A point's
/// colour is the same in all frames.
///
/// Units    cd/m2, linear Rec. 709.
/// Threads  one at a time; same bits for any number of threads.
class FramePlayer {
 public:
  /// @param store  kept by reference
  /// @throws InputError  no such lighting, or not of all points; a size out of range
  FramePlayer(const PointStore& store, const PlaybackRequest& request);

  std::size_t frames() const { return store_.frames_done(); }
  PerspectiveView view(std::size_t frame) const;
  Image frame(std::size_t frame);

 private:
  struct LitChunk {
    SplatChunk chunk;
    std::vector<Rgb> colour;
    std::size_t used = 0;
    bool is_held = false;
  };
  const LitChunk& lit_chunk(std::size_t chunk);
  void drop_oldest();

  const PointStore& store_;
  PlaybackRequest request_;
  SplatRule rule_;
  std::vector<LitChunk> chunks_;
  std::size_t held_ = 0, frame_count_ = 0;
};

/// Chunks whose points the playable frames need.
/// @throws InputError  no frame is complete; no such lighting, or not of all points
std::size_t playable_chunks(const PointStore& store, std::size_t lighting);

/// From some frames spread over the film: the geometric mean of their luminance becomes middle
/// grey, as in a single picture (`ToneMapOptions`).
FilmTone film_tone(FramePlayer& player);

}  // namespace tenku
