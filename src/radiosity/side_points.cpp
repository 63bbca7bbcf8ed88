#include "radiosity/side_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace tenku {
namespace {

constexpr double kNormalSteps = 1000.0;  // normals that differ by less are one way to face

struct Corner {
  std::uint32_t vertex;
  std::array<std::int32_t, 3> facing;
  std::uint32_t side, place;

  auto key() const { return std::tie(vertex, facing); }
};

std::array<std::int32_t, 3> rounded(Vec3 n) {
  const auto step = [](double x) {
    return static_cast<std::int32_t>(std::lround(kNormalSteps * x));
  };
  return {step(n.x), step(n.y), step(n.z)};
}

std::vector<Corner> sorted_corners(const ElementMesh& mesh) {
  std::vector<Corner> corners;
  corners.reserve(3 * mesh.sides());
  for (std::uint32_t side = 0; side < mesh.sides(); ++side) {
    const auto facing = rounded(mesh.normal(side));
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners.push_back({mesh.elements[side / 2][k], facing, side, k});
    }
  }
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return std::tuple(a.key(), a.side) < std::tuple(b.key(), b.side);
  });
  return corners;
}

/// Sets that grow together.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

void number_planes(SidePoints& points) {
  Sets sets(points.size());
  for (const auto& [a, b, c] : points.corner) {
    sets.join(a, b);
    sets.join(b, c);
  }
  std::vector<std::uint32_t> number(points.size(), ~0U);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::uint32_t& of_set = number[sets.of(i)];
    if (of_set == ~0U) of_set = points.planes++;
    points.plane.push_back(of_set);
  }
}

}  // namespace

SidePoints side_points(const ElementMesh& mesh) {
  SidePoints points;
  points.corner.resize(mesh.sides());
  const std::vector<Corner> corners = sorted_corners(mesh);
  for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    Vec3 middle;
    while (end < corners.size() && corners[end].key() == corners[begin].key()) {
      points.corner[corners[end].side][corners[end].place] =
          static_cast<std::uint32_t>(points.size());
      middle = middle + mesh.centre(corners[end].side / 2);
      ++end;
    }
    middle = (1.0 / static_cast<double>(end - begin)) * middle;
    const Vec3 vertex = mesh.vertices[corners[begin].vertex];
    points.sensors.position.push_back(vertex + SidePoints::kDrawnBack * (middle - vertex));
    points.sensors.normal.push_back(mesh.normal(corners[begin].side));
  }
  number_planes(points);
  return points;
}

}  // namespace tenku
