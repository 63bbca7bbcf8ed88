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

/// Mean absolute difference of the codes of all channels, in units of 1/255.
inline double mean_difference(const Image8& a, const Image8& b) {
  double sum = 0.0;
  for (std::size_t p = 0; p < a.pixels.size(); ++p) {
    sum += std::abs(a.pixels[p].r - b.pixels[p].r) + std::abs(a.pixels[p].g - b.pixels[p].g) +
           std::abs(a.pixels[p].b - b.pixels[p].b);
  }
  return sum / (3.0 * static_cast<double>(a.pixels.size()));
}

/// Mean structural similarity of the green channels, over windows of 8 by 8.
///
/// Source   Z. Wang et al., "Image quality assessment: from error visibility to structural
///          similarity", IEEE TIP 13(4), 2004: K1 = 0.01, K2 = 0.03, L = 255.
inline double structural_similarity(const Image8& a, const Image8& b) {
  constexpr int kSide = 8;
  const double c1 = std::pow(0.01 * 255, 2), c2 = std::pow(0.03 * 255, 2), n = kSide * kSide;
  double sum = 0.0;
  std::size_t windows = 0;
  for (int y = 0; y + kSide <= a.height; y += 4) {
    for (int x = 0; x + kSide <= a.width; x += 4, ++windows) {
      double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
          const double u = a.at(x + i, y + j).g, v = b.at(x + i, y + j).g;
          sa += u, sb += v, saa += u * u, sbb += v * v, sab += u * v;
        }
      }
      const double ma = sa / n, mb = sb / n;
      const double va = saa / n - ma * ma, vb = sbb / n - mb * mb, cov = sab / n - ma * mb;
      sum += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  }
  return sum / static_cast<double>(windows);
}

}  // namespace tenku::testing_support
