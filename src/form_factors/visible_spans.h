/// What is nearest along a scan line.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "form_factors/point_view.h"

namespace tenku {

/// A piece of a line on the disc that an element covers, whatever stands before it.
struct DiscSpan {
  double x0, x1;
  std::uint32_t seen;  ///< index into `PointView::seen`
};

/// Cuts overlapping spans into visible ones.
///
/// Along a line the true distance to the plane of an element is known in closed form, so that
/// spans are ordered by it, and two that change order are cut where they do: the paper's plane
/// through three projected corners, eq. 5, only approximates it.
///
/// Cost  that of sorting, as long as few of the spans at hand are not hidden by the nearest one.
class VisibleSpans {
 public:
  /// @param view  kept by reference
  explicit VisibleSpans(const PointView& view) : view_(view), length_(view.seen.size()) {}

  /// Adds the visible lengths on the line at `y`. Sorts `spans`.
  void add_line(double y, std::span<DiscSpan> spans);

  /// Visible length of each seen side, over all lines.
  const std::vector<double>& length() const { return length_; }

 private:
  /// A span that may be visible further on.
  struct Open {
    double x1;
    Vec3 nearness, end;  ///< `end`: direction at x1
    std::uint32_t seen;
  };

  Vec3 direction(double x) const;
  static bool hides(Vec3 one, Vec3 other, const std::array<Vec3, 3>& places);
  void open(const DiscSpan& span);
  void advance(double x);
  void resolve(double from, double to, int depth);
  const Open& nearest(Vec3 direction) const;
  double order_changes(Vec3 difference, double from, double to) const;

  const PointView& view_;
  std::vector<double> length_;
  std::vector<Open> open_;
  double x_ = 0.0, y_ = 0.0;
};

}  // namespace tenku
