/// A store of points as one web page that plays it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "flythrough/playback.h"
#include "flythrough/point_store.h"

namespace tenku {

/// What the page shows beside the store's own.
struct ViewerPageOptions {
  std::string title, told;  ///< `told`: one more sentence under the film
  FilmTone tone;
  std::size_t first_frame = 0, frames = 0;  ///< of the store
  std::size_t lighting = 0;                 ///< that is shown first, and must be complete
};

/// Lightings that all points have, `first` in front.
std::vector<std::size_t> complete_lightings(const PointStore& store, std::size_t first);

/// Writes one HTML file that asks for nothing outside of it: WebGL 2, the points in at most 20
/// bytes each, deflated, as base64. Chunk by chunk: memory does not grow with the store.
///
/// @throws InputError     the folder is not there; as `playable_chunks`
/// @throws ResourceError  if writing fails
/// @throws Cancelled      if the user asks to stop
void write_viewer_page(const std::filesystem::path& file, const PointStore& store,
                       const ViewerPageOptions& options, Progress& progress);

}  // namespace tenku
