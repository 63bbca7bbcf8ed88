/// The sky between two slices, told by the outlines that they have met.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "illuminance/outline_segment.h"
#include "illuminance/slice_light.h"
#include "visibility/sky_boundary.h"
#include "visibility/slice_tracer.h"

namespace tenku {

/// What a slice has found.
struct SkySlice {
  double azimuth = 0.0;             ///< radians, clockwise from north
  Vec3 along;                       ///< horizontal unit vector toward it
  LuxAndView light;                 ///< per radian of azimuth
  OutlineSegment low, high;         ///< what bounds the visible range
  OutlineEdge low_edge, high_edge;  ///< the same as edges of the mesh
  SliceHints hints;                 ///< to what bounds it
  bool is_behind = false;           ///< wholly behind the sensor
  bool is_open = false;             ///< some sky is visible
  bool is_outlined = false;         ///< one visible range, bounded by `low` and `high` alone
};

/// A part of the sky's boundary, with its azimuths.
struct BoundaryOutline {
  explicit BoundaryOutline(const BoundaryPiece& piece)
      : edge(piece.a, piece.b), begin(edge.begin()), turn(edge.turn()), outward(piece.outward) {}

  OutlineSegment edge;
  double begin, turn;  ///< azimuth of its first end, and the angle from there to the last, radians
  Vec3 outward;        ///< unit vector across it, toward the sky
};

/// What a sensor looks through and at.
struct SensorSight {
  const RayVisibility& rays;
  const SkyTable* table;  ///< null for no sky: only the view of it is found
  Vec3 origin, normal;
};

/// A visible range of altitudes, with the transmittance of the panes before it.
struct SeenPiece {
  Altitude low, high;
  double transmittance;
};

/// Cuts a visible range into pieces so short that one angle through the panes stands for each (by
/// the two-point Gauss rule on pairs); one piece in a scene without glass. Appends to `pieces` and
/// returns the rays sent.
int append_pieces(const SensorSight& sight, Vec3 along, const Altitude& low, const Altitude& high,
                  std::vector<SeenPiece>& pieces);

/// Light through the pieces of one half-plane.
LuxAndView light_through(const SliceLight& light, std::span<const SeenPiece> pieces);

/// The gap between two neighbouring slices of one sensor.
///
/// An outline is a straight edge with known ends: where the edge that bounds one slice
/// reaches on, the sky above it can be summed with no further ray. Where the edges of
/// both slices reach, the higher one counts. A building that ends before a lower one behind
/// it thus gives way at its very corner. Where neither reaches (a hole), the light is taken
/// to change along a line from the end of the one to the start of the other, or to lie between
/// that line and the open sky: the caller knows how far.
///
/// Error    things that neither slice has met are not known here.
class OutlineGap {
 public:
  /// @param width_rad  angle from `left` clockwise to `right`, below pi
  OutlineGap(const SkySlice& left, const SkySlice& right, double width_rad,
             const SensorSight& sight);

  /// The hole: none if it does not end after it begins. Offsets are angles from the left slice.
  const Bearing& hole_begin() const { return left_reach_; }
  const Bearing& hole_end() const { return right_reach_; }
  double hole() const { return std::max(0.0, right_reach_.offset - left_reach_.offset); }
  bool is_in_hole(double offset_rad) const {
    return offset_rad > left_reach_.offset && offset_rad < right_reach_.offset;
  }
  /// Whether the hole lies between two outlines, not beside a slice without one.
  bool is_between_outlines() const { return left_.is_outlined && right_.is_outlined; }

  /// Light per radian, inside a hole that of the line.
  LuxAndView at(const Bearing& bearing) const;
  /// Whether the sky is taken to end where this part of its boundary lies in the gap. True for
  /// what lies in its hole, or outside the gap.
  bool ends_along(const BoundaryOutline& outline) const;
  /// Light per radian of the unobstructed sky.
  LuxAndView open_at(const Bearing& bearing) const;
  /// Light of the gap outside its hole: by the two-point Gauss rule on parts over which the
  /// outlines bend little.
  /// @param is_fine  good to 1e-5 of the light, not to 1e-3
  LuxAndView known(bool is_fine = false) const;
  /// Light where the hole begins and where it ends, per radian.
  LuxAndView left_end() const;
  LuxAndView right_end() const;
  /// Rays through panes so far.
  std::uint64_t rays_sent() const { return rays_sent_; }

 private:
  /// Whose edges count in a part of the gap.
  struct Sides {
    bool left, right;
  };
  /// The visible range in one half-plane.
  struct Range {
    Altitude low, high;
  };

  /// Whether the sky is taken to show at an altitude; nothing where the bearing lies in a hole.
  std::optional<bool> shows(const Bearing& bearing, double sine) const;
  LuxAndView seen(const Bearing& bearing, Sides sides) const;
  /// Where the edges of both sides are equally high, between two bearings; the second if nowhere.
  Bearing crossing(Bearing from, Bearing to) const;
  Range range_at(const SliceLight& light, Vec3 along, Sides sides) const;
  /// How far the outlines bend between two bearings, radians.
  double bend(const Bearing& from, const Bearing& middle, const Bearing& to, Sides sides) const;
  /// How finely parts are cut.
  struct Cutting {
    double most_bend;   ///< radians of altitude times radians of azimuth
    double most_width;  ///< radians
    int halvings;
  };
  static const Cutting kCoarse, kFine;
  LuxAndView sum_between(Sides sides, const Bearing& from, const Bearing& to,
                         const Cutting& cutting, int depth = 0) const;

  const SkySlice &left_, &right_;
  double width_;
  const SensorSight& sight_;
  mutable std::uint64_t rays_sent_ = 0;
  Bearing left_reach_, right_reach_;  ///< to where the outlines of either side go on
};

}  // namespace tenku
