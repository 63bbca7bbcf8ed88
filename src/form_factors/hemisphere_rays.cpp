#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "form_factors/form_factor_methods.h"
#include "form_factors/point_view.h"
#include "meshing/mesh_soup.h"
#include "visibility/ray_visibility.h"

namespace tenku {
namespace {

/// Source  P. Shirley and K. Chiu, "A low distortion map between disk and square", JGT 2(3), 1997:
///         it keeps areas in proportion and neighbours together.
Vec3 on_hemisphere(double u, double v) {
  const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
  const bool wide = std::abs(a) > std::abs(b);
  const double r = wide ? a : b;
  if (r == 0.0) return kZenith;
  const double turn = wide ? 0.25 * kPi * b / a : 0.5 * kPi - 0.25 * kPi * a / b;
  return {r * std::cos(turn), r * std::sin(turn), std::sqrt(std::max(0.0, 1.0 - r * r))};
}

/// One point at random in each cell of a square grid, in tiles of four by four cells: a packet of
/// rays that keep together.
std::vector<Vec3> stratified_directions(int cells, SampleRandom random) {
  constexpr int kTile = 4;
  std::vector<Vec3> direction;
  direction.reserve(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  const auto add_tile = [&](int row, int column) {
    for (int y = row; y < std::min(row + kTile, cells); ++y) {
      for (int x = column; x < std::min(column + kTile, cells); ++x) {
        const double u = x + random.uniform(), v = y + random.uniform();
        direction.push_back(on_hemisphere(u / cells, v / cells));
      }
    }
  };
  for (int row = 0; row < cells; row += kTile) {
    for (int column = 0; column < cells; column += kTile) add_tile(row, column);
  }
  return direction;
}

/// As many samples as a disc of `resolution` pixels across has pixels.
int grid_cells(int resolution) {
  return std::max(1, static_cast<int>(std::lround(std::sqrt(kPi / 4.0) * resolution)));
}

/// The disc sampled by rays. Each point takes one of a few patterns of samples and turns it about
/// the normal at random, so that the errors of neighbouring points are independent.
class HemisphereRays : public FormFactorMethod {
 public:
  HemisphereRays(const ElementMesh& mesh, const FormFactorOptions& options)
      : seed_(options.seed), mesh_(mesh), soup_(soup_of(mesh)), rays_(soup_.soup, soup_.materials) {
    for (std::uint32_t k = 0; k < kPatterns; ++k) {
      pattern_[k] =
          stratified_directions(grid_cells(options.resolution), SampleRandom(seed_, k, 0));
    }
    for (std::size_t e = 0; e < mesh.size(); ++e) normal_.push_back(mesh.doubled_area(e));
  }

  std::string_view name() const override { return "hemisphere-rays"; }
  double lift_m() const override { return rays_.lift_m(); }
  bool sees_panes() const override { return true; }

  FormFactorRow from_point(Vec3 position, Vec3 normal) const override {
    const std::vector<Vec3> direction = directions_at(position, normal);
    std::vector<std::uint32_t> element(direction.size());
    rays_.first_triangles(position, direction, element);
    std::vector<Run> runs;
    for (std::size_t k = 0; k < direction.size(); ++k) {
      if (element[k] == RayVisibility::kNoTriangle) continue;
      const bool back = dot(direction[k], normal_[element[k]]) > 0.0;
      const std::uint32_t side = 2 * element[k] + (back ? 1U : 0U);
      if (runs.empty() || runs.back().side != side) runs.push_back({side, 0.0});
      runs.back().rays +=
          rays_.has_glass() ? through_panes(position, direction[k], element[k]) : 1.0;
    }
    return row_of(std::move(runs), direction.size());
  }

 private:
  static constexpr std::uint32_t kPatterns = 8;

  std::vector<Vec3> directions_at(Vec3 position, Vec3 normal) const {
    const std::uint64_t key = key_of(position, normal, seed_);
    const auto& pattern = pattern_[SampleRandom(key, 1, 0).bits() % kPatterns];
    const auto [x, y, z] = PointAxes(normal, key);
    std::vector<Vec3> direction(pattern.size());
    for (std::size_t k = 0; k < pattern.size(); ++k) {
      direction[k] = pattern[k].x * x + pattern[k].y * y + pattern[k].z * z;
    }
    return direction;
  }

  /// What is left of a ray where it meets an element.
  double through_panes(Vec3 position, Vec3 direction, std::uint32_t element) const {
    const Vec3 at = mesh_.vertices[mesh_.elements[element][0]];
    const double away = dot(normal_[element], at - position) / dot(normal_[element], direction);
    return rays_.glass_transmission(position, direction, away);
  }

  /// Rays one after another that meet the same side: neighbours often do.
  struct Run {
    std::uint32_t side;
    double rays;  ///< their number, less what panes hold back
  };

  static FormFactorRow row_of(std::vector<Run> runs, std::size_t rays) {
    std::sort(runs.begin(), runs.end(), [](Run a, Run b) { return a.side < b.side; });
    FormFactorRow row;
    for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
      double met = 0.0;
      for (; end < runs.size() && runs[end].side == runs[begin].side; ++end) met += runs[end].rays;
      row.push_back({runs[begin].side, static_cast<float>(met / static_cast<double>(rays))});
    }
    return row;
  }

  std::uint64_t seed_;
  const ElementMesh& mesh_;
  MeshSoup soup_;
  RayVisibility rays_;
  std::vector<Vec3> normal_;  ///< of the front of each element, of any length
  std::array<std::vector<Vec3>, kPatterns> pattern_;
};

}  // namespace

std::unique_ptr<FormFactorMethod> make_hemisphere_rays(const ElementMesh& mesh,
                                                       const FormFactorOptions& options) {
  return std::make_unique<HemisphereRays>(mesh, options);
}

}  // namespace tenku
