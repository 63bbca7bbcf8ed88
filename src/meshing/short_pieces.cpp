#include "meshing/short_pieces.h"

#include <limits>
#include <numeric>

#include "meshing/bubble_edges.h"

namespace tenku {
namespace {

constexpr double kShort = 0.75;  // of the size

}  // namespace

ShortPieces::ShortPieces(const BubbleFace& face) : grid_(face.fixed) {
  std::vector<double> shortest(face.fixed, std::numeric_limits<double>::infinity());
  for (const auto& [a, b, is_outline] : face.pieces) {
    const double length = std::hypot(face.at[b].x - face.at[a].x, face.at[b].y - face.at[a].y);
    shortest[a] = std::min(shortest[a], length);
    shortest[b] = std::min(shortest[b], length);
  }
  std::vector<std::uint32_t> order(face.fixed);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto i, auto j) { return shortest[i] < shortest[j]; });
  for (const std::uint32_t i : order) {
    const double size = face.size_m[i];
    if (!(shortest[i] < kShort * size)) continue;
    // One that another end leaves little to say is left out.
    constexpr double kNearly = 1.1;
    if (limited(face.at[i], size) <= kNearly * shortest[i]) continue;
    grid_.insert(static_cast<std::uint32_t>(ends_.size()), face.at[i],
                 2.0 * (size - shortest[i]) / kRiseFromShort);
    ends_.push_back({face.at[i], shortest[i]});
  }
}

double ShortPieces::limited(PlanePoint p, double size_m) const {
  if (!is_size(size_m)) return size_m;
  double least = size_m;
  grid_.for_each_about(p, [&](std::uint32_t i) {
    const double far = std::hypot(p.x - ends_[i].at.x, p.y - ends_[i].at.y);
    least = std::min(least, ends_[i].size_m + kRiseFromShort * far);
  });
  return least;
}

}  // namespace tenku
