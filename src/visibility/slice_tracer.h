/// The visible sky in a vertical slice: the skyline, found exactly with a few rays.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/altitude.h"
#include "core/vec3.h"
#include "visibility/ray_visibility.h"

namespace tenku {

struct AltitudeRange {
  Altitude low, high;
};

/// An edge of the mesh that bounds the visible sky, by its two vertices; none where the bound is
/// the end of the slice itself.
struct OutlineEdge {
  std::uint32_t a = MeshAdjacency::kNone, b = MeshAdjacency::kNone;

  friend constexpr bool operator==(OutlineEdge, OutlineEdge) = default;
};

/// Triangles that bound the sky of a slice, for slices beside it to follow first.
struct SliceHints {
  std::uint32_t low_triangle = MeshAdjacency::kNone, high_triangle = MeshAdjacency::kNone;
};

/// Altitudes at which the sky shows in one vertical half-plane, in rising order.
struct VisibleSlice {
  static constexpr int kMaximum = 16;
  int count = 0;
  std::array<AltitudeRange, kMaximum> range;
  OutlineEdge low_edge, high_edge;
  SliceHints hints;

  /// Takes the part between `low` and `high` away. What no longer fits is dropped.
  void remove(const Altitude& low, const Altitude& high);
};

/// Follows outlines in vertical half-planes through one point.
///
/// A ray finds a triangle that hides the sky; from there the mesh itself is followed in the
/// plane, from triangle to neighbour, until it turns back: that is where its outline stands,
/// exactly. The next ray is sent just beyond. Triangles that bounded the last slice, and those
/// beside this one, are followed first: what they hide needs no ray.
///
/// Parts below which sky may show (`FloatingParts`), up to the largest 64 as seen from here, are
/// cut triangle by triangle: what of the slice they hide is taken away exactly.
///
/// The result is a claim, not a proof: something else that floats between the two ends of the
/// visible range is not seen by it. `check` sends a ray at an altitude of the caller's choice and
/// tells the truth there; what it finds is remembered for the slices that follow. The caller
/// corrects the claim by the checks, so that its estimates are unbiased whatever the claim misses.
///
/// Threads  one tracer a thread; many may share the ray engine.
class SliceTracer {
 public:
  /// Floating parts that are smaller as seen from a point are not known: a hundred-thousandth of
  /// the sky.
  static constexpr double kLeastPart_rad = 0.003;
  static constexpr double kNoParts = std::numeric_limits<double>::infinity();

  /// @param least_part_rad  half the angle that encloses a floating part
  SliceTracer(const RayVisibility& rays, Vec3 origin, double least_part_rad = kLeastPart_rad);

  /// Visible altitudes in [low, high] toward `along`, a horizontal unit vector, with
  /// 0 <= low <= high <= pi/2.
  /// @param before, after  what bounds slices on either side, where that is known
  VisibleSlice trace(Vec3 along, const Altitude& low, const Altitude& high, SliceHints before = {},
                     SliceHints after = {});

  /// Whether the sky shows at `altitude`, in the azimuth last traced. `claimed` is what `trace`
  /// said there.
  bool check(double altitude_rad, bool claimed);

  /// Product of the transmittances of the panes at `altitude`, in the azimuth last traced.
  double glass_transmission(double altitude_rad);

  /// A floating part as seen from here.
  struct SeenPart {
    std::uint32_t index;  ///< of `FloatingParts`
    Vec3 to;              ///< the middle of the cylinder around it, from here
    double level;         ///< metres to there, level
    double radius, half_height;

    double azimuth_rad() const;     ///< of its middle
    double half_width_rad() const;  ///< pi if it stands overhead
    double solid_angle() const;     ///< of what encloses it
    double sine() const;            ///< of the altitude of its middle
    /// Whether all of it lies below an altitude.
    bool is_below(const Altitude& altitude) const {
      return (to.z + half_height) * altitude.cosine < (level - radius) * altitude.sine;
    }
  };
  /// Floating parts that slices may meet.
  const std::vector<SeenPart>& parts();

  /// Floating things that checks have met so far.
  int floating() const { return floating_count_; }

  std::uint64_t rays_sent() const { return rays_sent_; }

 private:
  /// The vertical plane of the slice, in distances along (r) and across (s) it.
  struct Plane {
    Vec3 along, across;
  };
  /// A point in the plane: horizontal distance and height, both from the origin and times `scale`,
  /// which is positive.
  struct PlanePoint {
    double r, z, scale;
  };
  /// A vertex seen from the origin, and how far beside the plane it lies.
  struct Corner {
    Vec3 at;
    double side = 0.0;
  };
  /// Where the mesh turns back.
  struct Outline {
    PlanePoint point;
    std::uint32_t triangle;  ///< the last one on the way
    OutlineEdge edge;

    Altitude altitude() const;
    double distance() const;  ///< metres
    /// Whether it lies further than `other` by an angle (small, radians) in the sense of the walk.
    bool is_past(const Altitude& other, int sense, double by_rad = 0.0) const;
  };
  /// Where the visible part of a slice ends, and what it remembers for the next slice.
  struct End {
    std::uint32_t hint = MeshAdjacency::kNone;
    OutlineEdge edge;
  };

  /// A triangle that the slice cuts, by the two of its edges that it crosses.
  struct Cut {
    std::uint32_t triangle;
    std::array<unsigned, 2> edge;
    std::array<PlanePoint, 2> point;
  };

  Vec3 direction(const Altitude& altitude) const;
  Corner corner(std::uint32_t vertex) const;
  static bool parted(const Corner& a, const Corner& b) {
    return (a.side >= 0.0) != (b.side >= 0.0);
  }
  /// Where the plane cuts an edge with ends on either side.
  PlanePoint edge_point(const Corner& a, const Corner& b) const;
  std::array<Corner, 3> corners(std::uint32_t triangle) const;
  /// @param at  the corners of the triangle
  /// @returns false where it lies beside the slice, or behind it
  bool cut(std::uint32_t triangle, const std::array<Corner, 3>& at, Cut& result) const;
  bool cut(std::uint32_t triangle, Cut& result) const {
    return cut(triangle, corners(triangle), result);
  }
  /// The same of the triangle or a neighbour, whichever the slice cuts.
  bool cut_near(std::uint32_t triangle, Cut& result) const;
  /// Follows the mesh from a cut toward rising (+1) or falling (-1) altitude.
  Outline follow(const Cut& start, int sense) const;
  /// Climbs (or descends) from `start` until the sky shows or `limit` is passed.
  Altitude find_end(const Altitude& start, const Altitude& limit, int sense, End& end,
                    const std::array<std::uint32_t, 2>& hints);
  /// Takes away what a floating part hides.
  void remove_part(std::uint32_t part, VisibleSlice& slice) const;
  void remember(std::uint32_t triangle);
  bool zenith_is_open();

  static constexpr int kFloating = 6;
  static constexpr std::size_t kMostParts = 64;

  const RayVisibility& rays_;
  Vec3 origin_;
  Plane plane_{};
  std::uint64_t rays_sent_ = 0;
  End low_end_, high_end_;
  int zenith_ = -1;  ///< -1 not asked yet, 0 hidden, 1 open
  std::array<std::uint32_t, kFloating> floating_{};
  int floating_count_ = 0, floating_next_ = 0;
  double least_part_rad_;
  std::vector<SeenPart> parts_;
  bool has_parts_ = false;  ///< they have been looked for
};

}  // namespace tenku
