#include "form_factors/hemisphere_look.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "form_factors/point_view.h"

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

}  // namespace

MeshRays::MeshRays(const ElementMesh& all)
    : mesh(all), soup(soup_of(all)), rays(soup.soup, soup.materials) {
  for (std::size_t e = 0; e < mesh.size(); ++e) normal.push_back(mesh.doubled_area(e));
}

MetSide MeshRays::met(Vec3 position, Vec3 direction, std::uint32_t element) const {
  const bool is_back = dot(direction, normal[element]) > 0.0;
  const double passed =
      rays.has_glass()
          ? rays.glass_transmission(position, direction, away(position, direction, element))
          : 1.0;
  return {2 * element + (is_back ? 1U : 0U), passed, direction};
}

std::optional<MetSide> MeshRays::first_met(Vec3 position, Vec3 direction) const {
  std::uint32_t element = RayVisibility::kNoTriangle;
  rays.first_triangles(position, std::span(&direction, 1), std::span(&element, 1));
  if (element == RayVisibility::kNoTriangle) return std::nullopt;
  return met(position, direction, element);
}

HemisphereLook::HemisphereLook(const MeshRays& mesh, int resolution, std::uint64_t seed)
    : mesh_(mesh), seed_(seed) {
  for (std::uint32_t k = 0; k < kPatterns; ++k) {
    pattern_[k] = stratified_directions(grid_cells(resolution), SampleRandom(seed_, k, 0));
  }
}

std::vector<Vec3> HemisphereLook::directions_at(Vec3 position, Vec3 normal) const {
  const std::uint64_t key = key_of(position, normal, seed_);
  const auto& pattern = pattern_[SampleRandom(key, 1, 0).bits() % kPatterns];
  const auto [x, y, z] = PointAxes(normal, key);
  std::vector<Vec3> direction(pattern.size());
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    direction[k] = pattern[k].x * x + pattern[k].y * y + pattern[k].z * z;
  }
  return direction;
}

std::vector<MetSide> HemisphereLook::from_point(Vec3 position, Vec3 normal) const {
  const std::vector<Vec3> direction = directions_at(position, normal);
  std::vector<std::uint32_t> element(direction.size());
  mesh_.rays.first_triangles(position, direction, element);
  std::vector<MetSide> met;
  met.reserve(direction.size());
  for (std::size_t k = 0; k < direction.size(); ++k) {
    if (element[k] == RayVisibility::kNoTriangle) continue;
    met.push_back(mesh_.met(position, direction[k], element[k]));
    met.back().share /= static_cast<double>(direction.size());
  }
  return met;
}

FormFactorRow row_of(const std::vector<MetSide>& met) {
  struct Run {
    std::uint32_t side;
    double share;
  };
  std::vector<Run> runs;
  for (const MetSide& one : met) {
    if (runs.empty() || runs.back().side != one.side) runs.push_back({one.side, 0.0});
    runs.back().share += one.share;
  }
  std::sort(runs.begin(), runs.end(), [](Run a, Run b) { return a.side < b.side; });
  FormFactorRow row;
  for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
    double share = 0.0;
    for (; end < runs.size() && runs[end].side == runs[begin].side; ++end) share += runs[end].share;
    row.push_back({runs[begin].side, static_cast<float>(share)});
  }
  return row;
}

}  // namespace tenku
