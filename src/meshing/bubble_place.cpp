#include "meshing/bubble_place.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tenku {
namespace {

// In sizes. Bubbles that touch are 1 apart, and the nearest row lies sqrt(3) / 2 from an edge.
constexpr double kClear = 0.75;
constexpr double kClearOfPiece = 0.55;
constexpr double kLongestWay = 2.5;
constexpr double kMostMarks = 64.0;  // of a piece

}  // namespace

PieceMarks::PieceMarks(const BubbleFace& face) : grid_(face.pieces.size()) {
  for (std::uint32_t i = 0; i < face.pieces.size(); ++i) {
    const PlanePoint a = face.at[face.pieces[i].a], b = face.at[face.pieces[i].b];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double size = std::min(face.size_m[face.pieces[i].a], face.size_m[face.pieces[i].b]);
    const double n = std::clamp(std::ceil(length / (1.2 * size)), 1.0, kMostMarks);
    for (double k = 0.5; k < n; ++k) {
      grid_.insert(static_cast<std::uint32_t>(piece_.size()),
                   {a.x + k / n * (b.x - a.x), a.y + k / n * (b.y - a.y)}, size);
      piece_.push_back(i);
    }
  }
}

BubblePlacer::BubblePlacer(BubbleFace& face, std::size_t expected)
    : face_(face), marks_(face), grid_(std::max(expected, face.at.size())) {
  for (std::uint32_t i = 0; i < face.at.size(); ++i) {
    const PlanePoint p = face.at[i];
    grid_.insert(i, p, face.size_m[i]);
    low_ = i == 0 ? p : PlanePoint{std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = i == 0 ? p : PlanePoint{std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }
}

void BubblePlacer::fill(std::size_t most) {
  for (const BubblePiece& piece : face_.pieces) {
    add_beside(piece, true);
    if (!piece.is_outline) add_beside(piece, false);
  }
  for (std::size_t next = 0; next < fronts_.size() && face_.at.size() < most; ++next) {
    add_around(Front(fronts_[next]));
  }
}

bool BubblePlacer::add_if_free(PlanePoint from, PlanePoint to, double clear) {
  if (!(to.x > low_.x && to.x < high_.x && to.y > low_.y && to.y < high_.y)) return false;
  const double size = face_.size_at(to);
  // A step of many sizes into where bubbles are small: those beside fill that.
  const double way = std::hypot(to.x - from.x, to.y - from.y) / size;
  if (!is_size(size) || way > kLongestWay) return false;
  bool is_free = true;
  grid_.for_each_near(to, size, clear, [&](std::uint32_t i) {
    const double least = 0.5 * clear * (size + face_.size_m[i]);
    const double dx = face_.at[i].x - to.x, dy = face_.at[i].y - to.y;
    if (dx * dx + dy * dy < least * least) is_free = false;
  });
  if (!is_free) return false;
  marks_.for_each_near(to, size, std::max(way, kClearOfPiece), [&](std::uint32_t i) {
    if (!is_free) return;
    const PlanePoint a = face_.at[face_.pieces[i].a], b = face_.at[face_.pieces[i].b];
    is_free =
        distance_to_segment(to, a, b) >= kClearOfPiece * size && !segments_meet(from, to, a, b);
  });
  if (!is_free) return false;
  grid_.insert(face_.add(to, size), to, size);
  return true;
}

void BubblePlacer::add_beside(const BubblePiece& piece, bool is_left) {
  PlanePoint a = face_.at[piece.a], b = face_.at[piece.b];
  if (!is_left) std::swap(a, b);
  const PlanePoint middle{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 0.0)) return;
  const PlanePoint up{(a.y - b.y) / length, (b.x - a.x) / length};
  const double size = 0.5 * (face_.size_m[piece.a] + face_.size_m[piece.b]);
  const double across = std::min(0.5 * length, 0.8 * size);
  const double height = std::sqrt(size * size - across * across);
  const PlanePoint apex{middle.x + height * up.x, middle.y + height * up.y};
  constexpr double kOff = 1e-6;  // so that the piece itself is not in the way
  const PlanePoint from{middle.x + kOff * height * up.x, middle.y + kOff * height * up.y};
  if (!add_if_free(from, apex, kClear)) return;
  const double reach = std::hypot(apex.x - a.x, apex.y - a.y);
  fronts_.push_back({apex, {(apex.x - a.x) / reach, (apex.y - a.y) / reach}});
}

void BubblePlacer::add_around(const Front& front) {
  constexpr double kCos = 0.5, kSin = std::numbers::sqrt3 / 2.0;
  const PlanePoint d = front.along;
  const PlanePoint left{kCos * d.x - kSin * d.y, kSin * d.x + kCos * d.y};
  const PlanePoint right{kCos * d.x + kSin * d.y, -kSin * d.x + kCos * d.y};
  for (const PlanePoint along :
       {d, left, right, PlanePoint{-left.x, -left.y}, PlanePoint{-right.x, -right.y}}) {
    advance(front.at, along);
  }
}

void BubblePlacer::advance(PlanePoint from, PlanePoint along) {
  const double near = face_.size_at(from);
  const double far = face_.size_at({from.x + near * along.x, from.y + near * along.y});
  const double way = 0.5 * (near + far);
  const PlanePoint to{from.x + way * along.x, from.y + way * along.y};
  if (add_if_free(from, to, kClear)) fronts_.push_back({to, along});
}

}  // namespace tenku
