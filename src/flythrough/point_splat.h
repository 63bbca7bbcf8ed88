/// Which stored point each sample of a picture shows: the item buffer of gathering and of playback.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/extent.h"
#include "flythrough/stored_points.h"
#include "view/camera.h"

namespace tenku {

/// How points become discs on the screen. Gathering and playback must use the same rule: what
/// gathering finds covered is covered in playback.
struct SplatRule {
  /// A point is drawn as a round disc of this many times its footprint across.
  double overlap = 1.5;
  /// Discs are at least this wide, so that points finer than the samples are met by some.
  double least_pixels = 0.6;
  /// Points whose footprint would be wider than this are not drawn: finer ones were gathered for
  /// such views.
  double coarsest_pixels = 1.4, coarsest_edge_pixels = 0.7;

  double seam_pixels = 0.02;  ///< by which discs reach over the borders of their surfaces

  /// The rule of gathering: a little stricter, so that what is covered stays so when positions and
  /// footprints are rounded.
  SplatRule stricter() const {
    return {0.95 * overlap, 0.95 * least_pixels, 0.998 * coarsest_pixels,
            0.998 * coarsest_edge_pixels, 0.5 * seam_pixels};
  }
  double coarsest(bool is_edge) const { return is_edge ? coarsest_edge_pixels : coarsest_pixels; }
};

/// Points of a chunk, ready to be drawn.
///
/// Frame    about `origin`, in float.
struct SplatChunk {
  struct Point {
    float x, y, z, footprint_m, nx, ny, nz;
    std::uint16_t material;
    std::uint16_t is_edge;
    PointBorders borders;
  };
  Vec3 origin;
  Extent extent;  ///< of the positions, local frame
  float finest_m = 0.0F;
  std::vector<Point> points;

  Vec3 position(std::size_t i) const {
    return origin + Vec3{double{points[i].x}, double{points[i].y}, double{points[i].z}};
  }
  Vec3 normal(std::size_t i) const {
    return {double{points[i].nx}, double{points[i].ny}, double{points[i].nz}};
  }
};

SplatChunk splat_chunk(const StoredPoints& points);

/// Points drawn as discs against depth.
///
/// Of discs on one surface the nearest centre wins (a shallow cone on each disc), of surfaces the
/// nearer. A disc ends at the borders of its surface. Points seen from behind are not drawn. Same
/// bits for any number of threads.
///
/// Shape    arrays [row][column][sample] of the view's pixels, each with its four samples at the
///          places `kRayPlaces` of the rays of `render_view`; empty before `draw`.
class SplatBuffer {
 public:
  static constexpr std::size_t kSamples = 4;
  static constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

  /// @throws InputError as `PerspectiveCamera`
  SplatBuffer(const PerspectiveView& view, const SplatRule& rule);

  /// Whether any point of the chunk may be drawn: its box is in the picture, its finest points fine
  /// enough.
  bool may_show(const Extent& box, float finest_m) const;

  /// Draws chunks; the points are numbered through in their order. What was drawn before is lost.
  void draw(std::span<const SplatChunk* const> chunks);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Number of the point that a sample shows, or `kNothing`.
  const std::vector<std::uint32_t>& item() const { return item_; }
  /// Place of a sample in the arrays.
  std::size_t index(int x, int y, std::size_t sample) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
            static_cast<std::size_t>(x)) *
               kSamples +
           sample;
  }
  /// Of a point by its number: the place of its chunk among those drawn, and its own in the chunk.
  struct Place {
    std::size_t chunk, point;
  };
  Place place(std::uint32_t item) const;
  /// 1 / (distance along the line of sight's axis), 0 where nothing is, 1/m.
  const std::vector<float>& inverse_depth() const { return nearness_; }

 private:
  struct Disc;
  void project(const SplatChunk& chunk, std::uint32_t first, std::vector<Disc>& discs) const;
  void add_borders(const SplatChunk::Point& point, Vec3 from_eye, Disc& disc) const;
  void fill(const Disc& disc, int top, int bottom);

  PerspectiveCamera camera_;
  SplatRule rule_;
  int width_, height_;
  Vec3 right_, down_, corner_;  ///< of the image plane at distance 1, a pixel a step
  double pixel_;                ///< width of a pixel there
  std::vector<std::uint32_t> item_, first_;
  std::vector<float> nearness_;
};

}  // namespace tenku
