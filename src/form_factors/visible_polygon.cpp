#include "form_factors/visible_polygon.h"

#include <algorithm>

namespace tenku {
namespace {

constexpr double kTouching = 1e-9;  // of the distance: what is as near as that is on the plane

/// A polygon with many corners, in two.
std::pair<ConvexPolygon, ConvexPolygon> halves(const ConvexPolygon& polygon) {
  const std::size_t middle = polygon.size() / 2;
  ConvexPolygon one, other;
  for (std::size_t k = 0; k <= middle; ++k) one.add(polygon[k]);
  for (std::size_t k = middle; k < polygon.size(); ++k) other.add(polygon[k]);
  other.add(polygon[0]);
  return {one, other};
}

}  // namespace

bool may_hide(const ConvexPolygon& other, Vec3 other_nearness, const ConvexPolygon& polygon,
              Vec3 nearness) {
  const auto before = [&](Vec3 p) { return dot(nearness, p) < 1.0 - kTouching; };
  const auto behind = [&](Vec3 p) { return dot(other_nearness, p) > 1.0 + kTouching; };
  return std::any_of(other.begin(), other.end(), before) &&
         std::any_of(polygon.begin(), polygon.end(), behind);
}

void VisiblePolygon::hide_behind(const ConvexPolygon& other) {
  const ConvexPolygon before = cut(other, [&](Vec3 p) { return 1.0 - dot(nearness_, p); });
  if (before.empty()) return;
  // The planes through edges look inward where the corners run counter-clockwise.
  Vec3 normal{};
  for (std::size_t k = 2; k < before.size(); ++k) {
    normal = normal + cross(before[k - 1] - before[0], before[k] - before[0]);
  }
  const double sense = dot(normal, before[0]) < 0.0 ? -1.0 : 1.0;
  next_.clear();
  for (const ConvexPolygon& piece : piece_) take_away(piece, before, sense);
  piece_.swap(next_);
}

void VisiblePolygon::take_away(const ConvexPolygon& piece, const ConvexPolygon& other,
                               double sense) {
  if (piece.size() > ConvexPolygon::kMaximum / 2) {
    const auto [one, two] = halves(piece);
    take_away(one, other, sense);
    take_away(two, other, sense);
    return;
  }
  const std::size_t before = next_.size();
  ConvexPolygon rest = piece;
  for (std::size_t k = 0; k < other.size() && !rest.empty(); ++k) {
    const Vec3 from = other[k], to = other[k + 1 < other.size() ? k + 1 : 0];
    if (!(length(to - from) > kTouching * length(to))) continue;  // no plane: twice the same corner
    const Vec3 inward = sense * cross(from, to);
    const ConvexPolygon outside = cut(rest, [&](Vec3 p) { return -dot(inward, p); });
    if (!outside.empty()) next_.push_back(outside);
    rest = cut(rest, [&](Vec3 p) { return dot(inward, p); });
  }
  if (rest.empty()) {  // nothing of it is hidden: it stays in one
    next_.resize(before);
    next_.push_back(piece);
  }
}

}  // namespace tenku
