#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "form_factors/form_factor_methods.h"
#include "form_factors/lambert_polygon.h"
#include "form_factors/point_view.h"
#include "form_factors/visible_polygon.h"
#include "meshing/mesh_soup.h"
#include "visibility/ray_visibility.h"

namespace tenku {
namespace {

/// What is above the horizon of a point, sorted into the cells of a grid over the disc, so that
/// what may stand before something is found fast.
class SeenGrid {
 public:
  SeenGrid(const ElementMesh& mesh, const PointView& view)
      : view_(view),
        cells_(1 + std::min(31, static_cast<int>(std::sqrt(view.seen.size()) / 4.0))),
        cell_(static_cast<std::size_t>(cells_ * cells_)) {
    for (std::uint32_t s = 0; s < view.seen.size(); ++s) {
      polygon_.push_back(view.polygon(mesh, view.seen[s]));
      box_.push_back(box_of(polygon_.back()));
      for_cells(box_.back(), [&](std::vector<std::uint32_t>& cell) { cell.push_back(s); });
    }
  }

  const ConvexPolygon& polygon(std::uint32_t s) const { return polygon_[s]; }

  /// What may hide a part of a seen side.
  std::vector<std::uint32_t> before(std::uint32_t s) {
    std::vector<std::uint32_t> found;
    for_cells(box_[s], [&](const std::vector<std::uint32_t>& cell) {
      for (const std::uint32_t other : cell) {
        if (other != s && overlap(box_[s], box_[other]) &&
            may_hide(polygon_[other], view_.seen[other].nearness, polygon_[s],
                     view_.seen[s].nearness)) {
          found.push_back(other);
        }
      }
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  struct Box {
    double low_x = 0.0, low_y = 0.0, high_x = -1.0, high_y = -1.0;
  };

  /// About the cap that holds the corners: a point of the disc is no further from another than
  /// their directions are.
  static Box box_of(const ConvexPolygon& polygon) {
    if (polygon.empty()) return {};
    Vec3 sum{};
    for (const Vec3& p : polygon) sum = sum + normalized(p);
    const Vec3 centre = normalized(sum);
    double radius = 0.0;
    for (const Vec3& p : polygon) radius = std::max(radius, length(normalized(p) - centre));
    if (!(radius < 1.4)) return {-1.0, -1.0, 1.0, 1.0};  // no cap of less than a right angle
    return {centre.x - radius, centre.y - radius, centre.x + radius, centre.y + radius};
  }

  static bool overlap(const Box& a, const Box& b) {
    return a.low_x <= b.high_x && b.low_x <= a.high_x && a.low_y <= b.high_y && b.low_y <= a.high_y;
  }

  template <class Do>
  void for_cells(const Box& box, const Do& act) {
    const auto cell = [&](double at) {
      return static_cast<int>(std::clamp(0.5 * (at + 1.0), 0.0, 1.0) * (cells_ - 1));
    };
    if (box.low_x > box.high_x) return;
    for (int y = cell(box.low_y); y <= cell(box.high_y); ++y) {
      for (int x = cell(box.low_x); x <= cell(box.high_x); ++x) {
        act(cell_[static_cast<std::size_t>(y * cells_ + x)]);
      }
    }
  }

  const PointView& view_;
  int cells_;  ///< along the edge of the grid
  std::vector<std::vector<std::uint32_t>> cell_;
  std::vector<ConvexPolygon> polygon_;
  std::vector<Box> box_;
};

/// Lambert's formula for what is seen of each element. Where few others stand before it, they are
/// cut away exactly; in a crowd the whole is scaled by the part that rays find to be seen.
class AnalyticFormFactors : public FormFactorMethod {
 public:
  AnalyticFormFactors(const ElementMesh& mesh, const FormFactorOptions& options)
      : mesh_(mesh),
        seed_(options.seed),
        soup_(soup_of(mesh)),
        rays_(soup_.soup, soup_.materials) {}

  std::string_view name() const override { return "analytic"; }
  bool is_exact() const override { return true; }

  FormFactorRow from_point(Vec3 position, Vec3 normal) const override {
    const PointAxes axes(normal, key_of(position, normal, seed_));
    const PointView view(mesh_, position, axes);
    SeenGrid grid(mesh_, view);
    std::vector<double> value(view.seen.size());
    for (std::uint32_t s = 0; s < value.size(); ++s) {
      const std::vector<std::uint32_t> before = grid.before(s);
      if (before.size() <= kCrowd) {
        value[s] = exact(view, grid, s, before);
      } else {
        value[s] = lambert_form_factor(grid.polygon(s)) * seen_part(view, grid, s, position, axes);
      }
    }
    return row_of(view, value, 1.0);
  }

 private:
  static constexpr std::size_t kCrowd = 512;

  static double exact(const PointView& view, const SeenGrid& grid, std::uint32_t s,
                      const std::vector<std::uint32_t>& before) {
    if (before.empty()) return lambert_form_factor(grid.polygon(s));
    VisiblePolygon visible(grid.polygon(s), view.seen[s].nearness);
    for (const std::uint32_t other : before) {
      visible.hide_behind(grid.polygon(other));
      if (visible.pieces().empty()) return 0.0;
    }
    double sum = 0.0;
    for (const ConvexPolygon& piece : visible.pieces()) sum += lambert_form_factor(piece);
    return sum;
  }

  /// Part of the polygon that rays meet first, each weighted by what its surroundings count.
  double seen_part(const PointView& view, const SeenGrid& grid, std::uint32_t s, Vec3 position,
                   const PointAxes& axes) const {
    constexpr int kSide = 8;
    const ConvexPolygon& polygon = grid.polygon(s);
    std::vector<Vec3> direction;
    std::vector<double> weight;
    SampleRandom random(key_of(position, axes.z, seed_), 2, s);
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const Vec3 a = polygon[0], ab = polygon[k - 1] - a, bc = polygon[k] - polygon[k - 1];
      const double area = length(cross(ab, bc));
      for (int cell = 0; cell < kSide * kSide; ++cell) {
        const double u = std::sqrt((cell / kSide + random.uniform()) / kSide);
        const double v = (cell % kSide + random.uniform()) / kSide;
        const Vec3 p = a + u * (ab + v * bc);
        const double distance = length(p);
        direction.push_back((1.0 / distance) * (p.x * axes.x + p.y * axes.y + p.z * axes.z));
        weight.push_back(area * p.z / (distance * distance * distance * distance));
      }
    }
    std::vector<std::uint32_t> met(direction.size());
    rays_.first_triangles(position + rays_.lift_m() * axes.z, direction, met);
    double seen = 0.0, all = 0.0;
    for (std::size_t k = 0; k < met.size(); ++k) {
      all += weight[k];
      if (met[k] == view.seen[s].side / 2) seen += weight[k];
    }
    return all > 0.0 ? seen / all : 0.0;
  }

  const ElementMesh& mesh_;
  std::uint64_t seed_;
  MeshSoup soup_;
  RayVisibility rays_;
};

}  // namespace

std::unique_ptr<FormFactorMethod> make_analytic_form_factors(const ElementMesh& mesh,
                                                             const FormFactorOptions& options) {
  return std::make_unique<AnalyticFormFactors>(mesh, options);
}

}  // namespace tenku
