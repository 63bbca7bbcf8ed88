/// Points on surfaces that shine, for paths to look at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vec3.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// The emitting triangles of a scene in groups that lie together, at most kMostGroups.
///
/// From a place a group is chosen in proportion to what it would send there at most if nothing
/// stood between, by its flux, its distance and its height over the surface; a triangle of it by
/// flux; a point on that evenly.
///
/// Where lamps fill most of the view, paths meet them often enough, and a choice of points would
/// only add noise: `View::is_worth_looking` says so.
///
/// Threads  immutable after construction; may be shared.
class LampSampler {
 public:
  static constexpr std::size_t kMostGroups = 64;
  static constexpr double kMostView = 0.5;  ///< rough form factor of all lamps

  explicit LampSampler(const RayVisibility& rays);

  bool is_any() const { return !group_.empty(); }

  struct Point {
    std::uint32_t triangle;
    Vec3 position;
  };

  /// How likely groups are chosen from one place.
  class View {
   public:
    /// @param normal  of the surface at `position`, toward the side that looks
    View(const LampSampler& lamps, Vec3 position, Vec3 normal);

    /// Whether lamps can be seen, and do not fill most of the view.
    bool is_worth_looking() const { return sum_ > 0.0 && fill_ <= kMostView; }
    /// @param u, v  uniform in [0, 1)
    Point choose(double u, double v) const;
    /// Probability of a point of a triangle by solid angle, 1/sr; zero for what does not shine.
    /// @param way  from the place to the point, m
    double density(std::uint32_t triangle, Vec3 way) const;

   private:
    const LampSampler& lamps_;
    std::vector<double> weight_;  ///< [group]
    double sum_ = 0.0, fill_ = 0.0;
  };

 private:
  struct Group {
    std::uint32_t begin, end;  ///< places in `triangle_`
    Vec3 centre;
    double radius_m, area_m2, flux_lm;
  };
  static constexpr std::uint32_t kNone = ~0U;

  void divide(std::uint32_t begin, std::uint32_t end, std::size_t most);
  Group group_of(std::uint32_t begin, std::uint32_t end);

  const RayVisibility& rays_;
  std::vector<std::uint32_t> triangle_;  ///< emitting ones, group by group
  std::vector<double> flux_to_lm_;       ///< [place in `triangle_`], in its group, up to it
  std::vector<Group> group_;
  std::vector<std::uint32_t> place_of_;  ///< [triangle of the scene] in `triangle_`, or kNone
  std::vector<std::uint32_t> group_of_;  ///< [place in `triangle_`]
};

}  // namespace tenku
