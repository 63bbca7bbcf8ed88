#include "flythrough/playback.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "view/pixel_paths.h"
#include "view/tone_map.h"

namespace tenku {
namespace {

constexpr std::size_t kToneFrames = 5;

/// A larger picture shows the same points with the same gaps between them.
SplatRule rule_for(int width, int gathered_width) {
  SplatRule rule;
  const double larger = std::max(1.0, static_cast<double>(width) / gathered_width);
  rule.coarsest_pixels *= larger, rule.coarsest_edge_pixels *= larger;
  return rule;
}

}  // namespace

std::vector<Rgb> shown_luminance(const StoreHeader& header, const StoredPoints& points,
                                 const PointLight& light) {
  std::vector<Rgb> shown;
  shown.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.material[i] >= header.materials.size()) {
      throw InputError("the store names a material that it does not have");
    }
    const StoreMaterial& m = header.materials[points.material[i]];
    shown.push_back((1.0 / kPi) * (light.total_lux(i) * m.reflectance + m.emission_lm_m2));
  }
  return shown;
}

std::size_t playable_chunks(const PointStore& store, std::size_t lighting) {
  if (store.frames_done() == 0) throw InputError("the store has no complete frame to play");
  if (lighting >= store.lightings().size()) {
    throw InputError("the store has no lighting " + std::to_string(lighting) + ", only " +
                     std::to_string(store.lightings().size()));
  }
  for (std::size_t c = 0; c < store.chunks_done(); ++c) {
    if (store.has_light(c, lighting)) continue;
    throw InputError("lighting " + std::to_string(lighting) +
                     " of the store is not complete: relight it once more");
  }
  return store.chunks_done();
}

FramePlayer::FramePlayer(const PointStore& store, const PlaybackRequest& request)
    : store_(store), request_(request), chunks_(playable_chunks(store, request.lighting)) {
  const CameraPath& path = store.header().path;
  if (request_.width == 0 && request_.height == 0) {
    request_.width = path.width, request_.height = path.height;
  } else if (request_.height == 0) {
    request_.height =
        static_cast<int>(std::lround(1.0 * request_.width * path.height / path.width));
  } else if (request_.width == 0) {
    request_.width =
        static_cast<int>(std::lround(1.0 * request_.height * path.width / path.height));
  }
  rule_ = rule_for(request_.width, path.width);
  const PerspectiveCamera checked(view(0));
}

PerspectiveView FramePlayer::view(std::size_t frame) const {
  PerspectiveView view = store_.header().path.view(frame);
  view.width = request_.width, view.height = request_.height;
  return view;
}

Image FramePlayer::frame(std::size_t frame) {
  ++frame_count_;
  const PerspectiveView view = this->view(frame);
  SplatBuffer buffer(view, rule_);
  std::vector<const LitChunk*> lit;
  std::vector<const SplatChunk*> shown;
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const ChunkInfo& info = store_.chunks()[c];
    if (!buffer.may_show(info.extent, info.finest_m)) continue;
    lit.push_back(&lit_chunk(c));
    shown.push_back(&lit.back()->chunk);
  }
  buffer.draw(shown);
  const StoreLighting& sky = store_.lightings()[request_.lighting];
  const PerspectiveCamera camera(view);
  Image image(view.width, view.height);
  const auto sample_colour = [&](int x, int y, std::size_t s) {
    const std::uint32_t item = buffer.item()[buffer.index(x, y, s)];
    if (item == SplatBuffer::kNothing) {
      return sky.sky_map.colour(camera.ray(x + kRayPlaces[s][0], y + kRayPlaces[s][1]),
                                sky.below_horizon);
    }
    const auto [chunk, point] = buffer.place(item);
    return lit[chunk]->colour[point];
  };
  parallel_for(static_cast<std::size_t>(view.height), 16, [&](IndexRange rows) {
    for (auto y = static_cast<int>(rows.begin); y < static_cast<int>(rows.end); ++y) {
      for (int x = 0; x < view.width; ++x) {
        Rgb sum;
        for (std::size_t s = 0; s < SplatBuffer::kSamples; ++s) sum = sum + sample_colour(x, y, s);
        image.at(x, y) = (1.0 / SplatBuffer::kSamples) * sum;
      }
    }
  });
  drop_oldest();
  return image;
}

const FramePlayer::LitChunk& FramePlayer::lit_chunk(std::size_t chunk) {
  LitChunk& slot = chunks_[chunk];
  slot.used = frame_count_;
  if (!slot.is_held) {
    const StoredPoints points = store_.points(chunk);
    slot.chunk = splat_chunk(points);
    slot.colour = shown_luminance(store_.header(), points, store_.light(chunk, request_.lighting));
    slot.is_held = true;
    held_ += points.size();
  }
  return slot;
}

// After the frame, which needs all of its chunks at once.
void FramePlayer::drop_oldest() {
  while (held_ > request_.points_in_memory) {
    LitChunk* oldest = nullptr;
    for (LitChunk& slot : chunks_) {
      if (slot.is_held && (oldest == nullptr || slot.used < oldest->used)) oldest = &slot;
    }
    held_ -= oldest->chunk.points.size();
    *oldest = {};
  }
}

FilmTone film_tone(FramePlayer& player) {
  double log_sum = 0.0;
  std::vector<double> values;
  const std::size_t count = std::min(kToneFrames, player.frames());
  for (std::size_t k = 0; k < count; ++k) {
    const Image image = player.frame((2 * k + 1) * player.frames() / (2 * count));
    log_sum += std::log(exposure_of(image, {}));
    for (const Rgb& pixel : image.pixels) values.push_back(luminance_of(pixel));
  }
  return {std::exp(log_sum / static_cast<double>(count)), round_scale(values)};
}

}  // namespace tenku
