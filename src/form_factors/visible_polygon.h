/// What is left to be seen of a polygon behind others.
#pragma once

#include <vector>

#include "form_factors/convex_polygon.h"

namespace tenku {

/// Takes what stands before a flat polygon away from it, as seen from the origin.
///
/// Polygons are cut by the planes through the origin and the edges of what hides them: exact, and
/// without rays.
class VisiblePolygon {
 public:
  /// @param polygon   above the horizon
  /// @param nearness  of its plane, as in `SeenSide`
  VisiblePolygon(const ConvexPolygon& polygon, Vec3 nearness)
      : nearness_(nearness), piece_{polygon} {}

  /// Takes away what is behind `other`, of which only the part before the own plane counts.
  void hide_behind(const ConvexPolygon& other);

  /// What is left: polygons side by side.
  const std::vector<ConvexPolygon>& pieces() const { return piece_; }

 private:
  void take_away(const ConvexPolygon& piece, const ConvexPolygon& other, double sense);

  Vec3 nearness_;
  std::vector<ConvexPolygon> piece_, next_;
};

/// Whether `other` may hide a part of `polygon`: part of it is before the plane of the polygon, and
/// part of the polygon behind its own.
bool may_hide(const ConvexPolygon& other, Vec3 other_nearness, const ConvexPolygon& polygon,
              Vec3 nearness);

}  // namespace tenku
