#include "beams/sun_overlaps.h"

#include <algorithm>
#include <iterator>

#include "beams/first_met.h"
#include "core/parallel.h"

namespace tenku {
namespace {

struct Box {
  double west = 1e300, east = -1e300, south = 1e300, north = -1e300;

  explicit Box(const SunOutline& outline) {
    for (const AcrossPoint& p : outline) {
      west = std::min(west, p.x), east = std::max(east, p.x);
      south = std::min(south, p.y), north = std::max(north, p.y);
    }
  }
  bool meets(const Box& o) const {
    return west < o.east && o.west < east && south < o.north && o.south < north;
  }
};

/// A part of the plane and the polygons on it.
struct Cell {
  SunOutline outline;
  Box box;
  std::vector<const ThrownPolygon*> sources;
};

/// Polygons on one side of one triangle.
class Overlay {
 public:
  explicit Overlay(Vec3 lit_normal) : frame_(lit_normal) {}

  void add(const ThrownPolygon& polygon) {
    depth_ = dot(frame_.along, polygon.corners[0]);
    std::vector<SunOutline> rest{outline_of(frame_, polygon.corners)};
    // Also over what is left of cells that earlier pieces were laid on.
    for (std::size_t c = 0; c < cells_.size() && !rest.empty(); ++c) {
      std::vector<SunOutline> left;
      for (SunOutline& piece : rest) lay(polygon, c, std::move(piece), left);
      rest = std::move(left);
    }
    for (SunOutline& piece : rest) put(std::move(piece), {&polygon});
  }

  void append_to(std::uint32_t triangle, std::vector<SunPatch>& patches) const {
    for (const Cell& cell : cells_) {
      SunPatch patch;
      patch.triangle = triangle;
      patch.area_m2 = area_of(cell.outline);
      for (const ThrownPolygon* source : cell.sources) {
        patch.lux += source->lux;
        patch.blur_m = std::max(patch.blur_m, source->blur_m);
        patch.mirrors = std::max(patch.mirrors, source->mirrors);
        patch.panels.push_back(source->panel);
      }
      std::sort(patch.panels.begin(), patch.panels.end());
      patch.panels.erase(std::unique(patch.panels.begin(), patch.panels.end()), patch.panels.end());
      for (const AcrossPoint& p : cell.outline) patch.corners.push_back(frame_.point(p, depth_));
      patches.push_back(std::move(patch));
    }
  }

 private:
  void put(SunOutline&& outline, std::vector<const ThrownPolygon*> sources) {
    const Box box(outline);
    cells_.push_back({std::move(outline), box, std::move(sources)});
  }

  /// Lays a piece of a polygon over a cell: what both share gets both, what is left of the piece
  /// goes to `left`, what is left of the cell becomes cells of their own.
  void lay(const ThrownPolygon& polygon, std::size_t c, SunOutline&& piece,
           std::vector<SunOutline>& left) {
    if (!cells_[c].box.meets(Box(piece))) {
      left.push_back(std::move(piece));
      return;
    }
    CutOutline of_piece = cut_by(piece, cells_[c].outline);
    if (of_piece.inside.empty()) {
      left.push_back(std::move(piece));
      return;
    }
    std::move(of_piece.outside.begin(), of_piece.outside.end(), std::back_inserter(left));
    const std::vector<const ThrownPolygon*> sources = cells_[c].sources;
    CutOutline of_cell = cut_by(cells_[c].outline, of_piece.inside);
    for (SunOutline& outside : of_cell.outside) put(std::move(outside), sources);
    cells_[c].outline = std::move(of_piece.inside);
    cells_[c].box = Box(cells_[c].outline);
    cells_[c].sources.push_back(&polygon);
  }

  BeamFrame frame_;
  double depth_ = 0.0;
  std::vector<Cell> cells_;
};

Vec3 lit_normal(const ThrownPolygon& polygon) {
  Vec3 sum{};
  const auto& p = polygon.corners;
  for (std::size_t k = 2; k < p.size(); ++k) sum = sum + cross(p[k - 1] - p[0], p[k] - p[0]);
  return sum;
}

}  // namespace

std::vector<SunPatch> added_up(const TriangleSoup& soup,
                               const std::vector<ThrownPolygon>& polygons) {
  struct Laid {
    std::uint32_t triangle;
    bool is_front;
    const ThrownPolygon* polygon;
  };
  std::vector<Laid> all;
  all.reserve(polygons.size());
  for (const ThrownPolygon& polygon : polygons) {
    const Vec3 front = normal_of(soup, polygon.triangle);
    all.push_back({polygon.triangle, dot(front, lit_normal(polygon)) > 0.0, &polygon});
  }
  const auto key = [](const Laid& l) {
    return 2 * std::uint64_t{l.triangle} + (l.is_front ? 0 : 1);
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Laid& a, const Laid& b) { return key(a) < key(b); });
  std::vector<std::size_t> starts;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == 0 || key(all[k]) != key(all[k - 1])) starts.push_back(k);
  }
  std::vector<std::vector<SunPatch>> each(starts.size());
  parallel_for(starts.size(), 1, [&](IndexRange range) {
    for (std::size_t g = range.begin; g < range.end; ++g) {
      const Laid& first = all[starts[g]];
      const Vec3 front = normal_of(soup, first.triangle);
      Overlay overlay(first.is_front ? front : -front);
      const std::size_t last = g + 1 < starts.size() ? starts[g + 1] : all.size();
      for (std::size_t k = starts[g]; k < last; ++k) overlay.add(*all[k].polygon);
      overlay.append_to(first.triangle, each[g]);
    }
  });
  std::vector<SunPatch> patches;
  for (auto& some : each) std::move(some.begin(), some.end(), std::back_inserter(patches));
  return patches;
}

}  // namespace tenku
