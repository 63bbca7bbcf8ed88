/// A frame of a store as playback shows it, and how alike two pictures are.
#pragma once

#include <cmath>
#include <vector>

#include "flythrough/point_splat.h"
#include "flythrough/point_store.h"
#include "view/image.h"
#include "view/pixel_paths.h"

namespace tenku::testing_support {

struct PlayedFrame {
  Image luminance;
  std::size_t empty_samples = 0;  ///< that show no point
};

inline PlayedFrame played_frame(const PointStore& store, std::size_t frame,
                                std::size_t lighting = 0) {
  const SplatRule rule;
  const StoreHeader& header = store.header();
  const PerspectiveView view = header.path.view(frame);
  SplatBuffer buffer(view, rule);
  std::vector<SplatChunk> chunks;
  std::vector<std::vector<Rgb>> colour;
  std::vector<const SplatChunk*> shown;
  for (std::size_t c = 0; c < store.chunks().size(); ++c) {
    if (!buffer.may_show(store.chunks()[c].extent, store.chunks()[c].finest_m)) continue;
    const StoredPoints points = store.points(c);
    const PointLight light = store.light(c, lighting);
    chunks.push_back(splat_chunk(points));
    colour.emplace_back();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const StoreMaterial& m = header.materials[points.material[i]];
      colour.back().push_back((1.0 / kPi) *
                              (light.total_lux(i) * m.reflectance + m.emission_lm_m2));
    }
  }
  for (const SplatChunk& chunk : chunks) shown.push_back(&chunk);
  buffer.draw(shown);
  const StoreLighting& sky = store.lightings()[lighting];
  const PerspectiveCamera camera(view);
  PlayedFrame played{Image(view.width, view.height), 0};
  for (int y = 0; y < buffer.height(); ++y) {
    for (int x = 0; x < buffer.width(); ++x) {
      Rgb sum;
      for (std::size_t s = 0; s < SplatBuffer::kSamples; ++s) {
        const auto item = buffer.item()[buffer.index(x, y, s)];
        if (item == SplatBuffer::kNothing) {
          ++played.empty_samples;
          sum = sum + sky.sky_map.colour(camera.ray(x + kRayPlaces[s][0], y + kRayPlaces[s][1]),
                                         sky.below_horizon);
        } else {
          const auto [chunk, point] = buffer.place(item);
          sum = sum + colour[chunk][point];
        }
      }
      played.luminance.at(x, y) = (1.0 / SplatBuffer::kSamples) * sum;
    }
  }
  return played;
}

}  // namespace tenku::testing_support
