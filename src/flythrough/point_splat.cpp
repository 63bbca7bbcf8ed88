#include "flythrough/point_splat.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "view/pixel_paths.h"

namespace tenku {
namespace {

constexpr double kNearest_m = 1e-4;
constexpr double kCone = 0.5;    // footprints that the rim of a disc lies behind its middle
constexpr double kSteep = 16.0;  // footprints in depth that a disc may reach
constexpr int kBands = 16;

}  // namespace

SplatChunk splat_chunk(const StoredPoints& points) {
  SplatChunk chunk;
  if (points.empty()) return chunk;
  chunk.extent = points.extent();
  chunk.origin = chunk.extent.middle();
  chunk.finest_m = std::numeric_limits<float>::infinity();
  chunk.points.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points.position[i] - chunk.origin, n = points.normal[i];
    chunk.points.push_back({static_cast<float>(p.x), static_cast<float>(p.y),
                            static_cast<float>(p.z), points.footprint_m[i], static_cast<float>(n.x),
                            static_cast<float>(n.y), static_cast<float>(n.z), points.material[i],
                            points.is_edge[i], points.borders[i]});
    chunk.finest_m = std::min(chunk.finest_m, points.footprint_m[i]);
  }
  return chunk;
}

/// A point on the screen: its inverse depth is linear there.
struct SplatBuffer::Disc {
  float x, y, radius;  // samples
  float nearness, by_x, by_y;
  float least, cone;  // of what a rim may differ; of squared pixels
  std::uint32_t item;
  int borders = 0;
  std::array<std::array<float, 3>, 2> border{};  ///< a dx + b dy + c > 0 within, pixels
};

SplatBuffer::SplatBuffer(const PerspectiveView& view, const SplatRule& rule)
    : camera_(view),
      rule_(rule),
      width_(camera_.width()),
      height_(camera_.height()),
      pixel_(camera_.footprint_m(1.0)) {
  const BeamView window = camera_.window();
  corner_ = window.direction({0.0, 0.0});
  right_ = window.direction({1.0, 0.0}) - corner_;
  down_ = window.direction({0.0, 1.0}) - corner_;
}

bool SplatBuffer::may_show(const Extent& box, float finest_m) const {
  const Vec3 eye = camera_.eye(), forward = camera_.forward();
  const Vec3 half = 0.5 * box.size(), middle = box.middle();
  // The farthest that any point can lie along the axis, and how fine a point must be there.
  const double reach =
      std::abs(forward.x) * half.x + std::abs(forward.y) * half.y + std::abs(forward.z) * half.z;
  const double farthest = dot(middle - eye, forward) + reach;
  if (farthest <= kNearest_m) return false;
  if (finest_m > rule_.coarsest_pixels * pixel_ * farthest) return false;
  // Planes through the eye and the picture's edges; discs reach over them by their radius.
  constexpr double margin = 4.0;
  const Vec3 last_column = corner_ + (width_ + margin) * right_,
             first_column = corner_ - margin * right_;
  const Vec3 last_row = corner_ + (height_ + margin) * down_, first_row = corner_ - margin * down_;
  const auto is_beyond = [&](Vec3 inward) {
    const double towards =
        std::abs(inward.x) * half.x + std::abs(inward.y) * half.y + std::abs(inward.z) * half.z;
    return dot(middle - eye, inward) + towards < 0.0;
  };
  const Vec3 up = -down_;
  const auto facing_right = [&](Vec3 column) {
    const Vec3 n = cross(column, up);
    return dot(n, right_) > 0.0 ? n : -n;
  };
  const auto facing_down = [&](Vec3 row) {
    const Vec3 n = cross(row, right_);
    return dot(n, down_) > 0.0 ? n : -n;
  };
  return !(is_beyond(facing_right(first_column)) || is_beyond(-facing_right(last_column)) ||
           is_beyond(facing_down(first_row)) || is_beyond(-facing_down(last_row)));
}

void SplatBuffer::project(const SplatChunk& chunk, std::uint32_t first,
                          std::vector<Disc>& discs) const {
  const Vec3 eye = camera_.eye() - chunk.origin, forward = camera_.forward();
  const double per = 1.0 / dot(right_, right_);
  const double from_x = dot(corner_, right_) * per, from_y = dot(corner_, down_) * per;
  for (std::size_t i = 0; i < chunk.points.size(); ++i) {
    const SplatChunk::Point& p = chunk.points[i];
    const Vec3 d = Vec3{double{p.x}, double{p.y}, double{p.z}} - eye;
    const double depth = dot(d, forward);
    if (!(depth > kNearest_m)) continue;
    const double size = p.footprint_m / (pixel_ * depth);
    if (size > rule_.coarsest(p.is_edge != 0)) continue;
    const Vec3 n{double{p.nx}, double{p.ny}, double{p.nz}};
    const double above = dot(n, d);  // negative: the side that was seen
    if (above >= 0.0) continue;
    const double x = dot(d, right_) * per / depth - from_x,
                 y = dot(d, down_) * per / depth - from_y;
    const double radius = 0.5 * std::max(rule_.least_pixels, rule_.overlap * size);
    if (x + radius < 0.0 || y + radius < 0.0 || x - radius > width_ || y - radius > height_)
      continue;
    const double nearness = 1.0 / depth;
    const double step = p.footprint_m * nearness * nearness;
    Disc disc{static_cast<float>(x),
              static_cast<float>(y),
              static_cast<float>(radius),
              static_cast<float>(nearness),
              static_cast<float>(dot(n, right_) / above),
              static_cast<float>(dot(n, down_) / above),
              static_cast<float>(kSteep * step),
              static_cast<float>(kCone * step / (radius * radius)),
              first + static_cast<std::uint32_t>(i),
              0,
              {}};
    if (p.is_edge != 0) add_borders(p, d, disc);
    discs.push_back(disc);
  }
}

void SplatBuffer::add_borders(const SplatChunk::Point& point, Vec3 from_eye, Disc& disc) const {
  const Vec3 normal{double{point.nx}, double{point.ny}, double{point.nz}};
  const TangentFrame frame = tangent_frame(normal);
  const Vec3 ray = (1.0 / dot(from_eye, camera_.forward())) * from_eye;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!point.borders.has(k)) continue;
    const double angle = point.borders.angle_rad(k);
    const Vec3 inward = std::cos(angle) * frame.tangent + std::sin(angle) * frame.bitangent;
    const Vec3 on_line =
        from_eye - (point.borders.distance_footprints(k) * point.footprint_m) * inward;
    // The plane of the line and the eye, positive towards the surface.
    Vec3 plane = cross(on_line, cross(normal, inward));
    if (dot(plane, inward) < 0.0) plane = -plane;
    const double a = dot(plane, right_), b = dot(plane, down_), scale = 1.0 / std::hypot(a, b);
    disc.border[static_cast<std::size_t>(disc.borders++)] = {
        static_cast<float>(scale * a), static_cast<float>(scale * b),
        static_cast<float>(scale * dot(plane, ray) + rule_.seam_pixels)};
  }
}

void SplatBuffer::fill(const Disc& disc, int top, int bottom) {
  const int x0 = std::max(0, static_cast<int>(std::floor(disc.x - disc.radius)));
  const int x1 = std::min(width_ - 1, static_cast<int>(std::floor(disc.x + disc.radius)));
  const int y0 = std::max(top, static_cast<int>(std::floor(disc.y - disc.radius)));
  const int y1 = std::min(bottom - 1, static_cast<int>(std::floor(disc.y + disc.radius)));
  const float most = disc.radius * disc.radius;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const std::size_t pixel = index(x, y, 0);
      const float to_x = static_cast<float>(x) - disc.x, to_y = static_cast<float>(y) - disc.y;
      for (std::size_t s = 0; s < kSamples; ++s) {
        const float dx = to_x + static_cast<float>(kRayPlaces[s][0]),
                    dy = to_y + static_cast<float>(kRayPlaces[s][1]);
        const float off = dx * dx + dy * dy;
        if (off > most) continue;
        bool is_within = true;
        for (int k = 0; k < disc.borders; ++k) {
          const auto& [a, b, c] = disc.border[static_cast<std::size_t>(k)];
          is_within = is_within && a * dx + b * dy + c > 0.0F;
        }
        if (!is_within) continue;
        const float slope = std::clamp(disc.by_x * dx + disc.by_y * dy, -disc.least, disc.least);
        const float nearness = std::max(disc.nearness + slope - disc.cone * off, 1e-9F);
        const std::size_t at = pixel + s;
        if (nearness > nearness_[at] || (nearness == nearness_[at] && disc.item < item_[at])) {
          nearness_[at] = nearness;
          item_[at] = disc.item;
        }
      }
    }
  }
}

void SplatBuffer::draw(std::span<const SplatChunk* const> chunks) {
  first_.assign(1, 0);
  for (const SplatChunk* chunk : chunks) {
    first_.push_back(first_.back() + static_cast<std::uint32_t>(chunk->points.size()));
  }
  std::vector<std::vector<Disc>> discs(chunks.size());
  parallel_for(chunks.size(), 1, [&](IndexRange range) {
    for (std::size_t c = range.begin; c < range.end; ++c) project(*chunks[c], first_[c], discs[c]);
  });
  item_.assign(index(0, height_, 0), kNothing);
  nearness_.assign(item_.size(), 0.0F);
  parallel_for(kBands, 1, [&](IndexRange range) {
    for (std::size_t band = range.begin; band < range.end; ++band) {
      const int top = static_cast<int>(band) * height_ / kBands,
                bottom = (static_cast<int>(band) + 1) * height_ / kBands;
      for (const auto& some : discs) {
        for (const Disc& disc : some) {
          if (disc.y + disc.radius < static_cast<float>(top) ||
              disc.y - disc.radius > static_cast<float>(bottom)) {
            continue;
          }
          fill(disc, top, bottom);
        }
      }
    }
  });
}

SplatBuffer::Place SplatBuffer::place(std::uint32_t item) const {
  const auto above = std::upper_bound(first_.begin(), first_.end(), item);
  const auto chunk = static_cast<std::size_t>(above - first_.begin()) - 1;
  return {chunk, item - first_[chunk]};
}

}  // namespace tenku
