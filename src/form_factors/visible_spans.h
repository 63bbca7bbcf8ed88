/// What is nearest along a scan line.
#pragma once

#include <array>
#include <cstddef>
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

/// Numbers runs of seen sides that follow one another in one plane: sheets.
/// @return  [seen], rising from 0
std::vector<std::uint32_t> sheets_of(const PointView& view);

/// Cuts overlapping spans into visible ones.
///
/// Spans of one sheet that touch are taken as one strip, and strips are cut. Along a line the true
/// distance to the plane of a strip is known in closed form, so that strips are ordered by it, and
/// two that change order are cut where they do: the paper's plane through three projected corners,
/// eq. 5, only approximates it.
///
/// Cost  that of sorting, as long as few of the strips at hand are not hidden by the nearest one.
class VisibleSpans {
 public:
  /// @param view   kept by reference
  /// @param sheet  [seen], as `sheets_of`; kept by reference
  VisibleSpans(const PointView& view, std::span<const std::uint32_t> sheet)
      : view_(view), sheet_(sheet), length_(view.seen.size()) {}

  /// Adds the visible lengths on the line at `y`. Sorts `spans` within their sheets.
  /// @param spans  in rising order of `seen`
  void add_line(double y, std::span<DiscSpan> spans);

  /// Visible length of each seen side, over all lines.
  const std::vector<double>& length() const { return length_; }

 private:
  /// Spans side by side in one plane.
  struct Strip {
    double x0, x1;
    std::uint32_t seen;     ///< one of them
    std::size_t next, end;  ///< those not left behind yet, places in the spans of the line
  };
  /// A strip that may be visible further on.
  struct Open {
    double x1;
    Vec3 nearness, end;  ///< `end`: direction at x1
    std::size_t strip;
  };

  void add_strips(std::size_t begin, std::size_t end);
  Vec3 direction(double x) const;
  static bool hides(Vec3 one, Vec3 other, const std::array<Vec3, 3>& places);
  void open(std::size_t strip);
  void advance(double x);
  void resolve(double from, double to, int depth);
  void show(Strip& strip, double from, double to);
  const Open& nearest(Vec3 direction) const;
  double order_changes(Vec3 difference, double from, double to) const;

  const PointView& view_;
  std::span<const std::uint32_t> sheet_;
  std::vector<double> length_;
  std::span<DiscSpan> spans_;  ///< of the line at hand
  std::vector<Strip> strip_;
  std::vector<Open> open_;
  double x_ = 0.0, y_ = 0.0;
};

}  // namespace tenku
