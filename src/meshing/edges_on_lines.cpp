#include "meshing/edges_on_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr double kBeside = 1e-6;  // of the length of a line: corners as near as that lie on it
constexpr std::size_t kGrain = 256;

bool is_on(const ConstraintSegment& line, PlanePoint p) {
  const double dx = line.b.x - line.a.x, dy = line.b.y - line.a.y, whole = dx * dx + dy * dy;
  const double across = (dx * (p.y - line.a.y) - dy * (p.x - line.a.x)) / whole,
               along = (dx * (p.x - line.a.x) + dy * (p.y - line.a.y)) / whole;
  return std::abs(across) < kBeside && along > -kBeside && along < 1.0 + kBeside;
}

}  // namespace

std::vector<std::uint8_t> edges_on_lines(const ElementMesh& mesh,
                                         std::span<const FlatPolygon> polygons,
                                         std::span<const std::uint32_t> polygon_of,
                                         std::span<const std::vector<ConstraintSegment>> lines) {
  if (lines.empty()) return {};
  std::vector<std::uint8_t> found(mesh.size());
  parallel_for(mesh.size(), kGrain, [&](IndexRange range) {
    for (std::size_t e = range.begin; e < range.end; ++e) {
      std::array<PlanePoint, 3> corner;
      for (unsigned k = 0; k < 3; ++k) {
        corner[k] = polygons[polygon_of[e]].flat(mesh.vertices[mesh.elements[e][k]]);
      }
      for (const ConstraintSegment& line : lines[polygon_of[e]]) {
        std::array<bool, 3> on{};
        for (unsigned k = 0; k < 3; ++k) on[k] = is_on(line, corner[k]);
        for (unsigned k = 0; k < 3; ++k) {
          if (on[k] && on[(k + 1) % 3]) found[e] |= static_cast<std::uint8_t>(1U << k);
        }
      }
    }
  });
  return found;
}

}  // namespace tenku
