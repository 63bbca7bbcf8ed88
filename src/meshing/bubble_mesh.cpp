#include "meshing/bubble_mesh.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"

namespace tenku {

std::string_view name_of(BubbleFlaw::Kind kind) {
  switch (kind) {
    case BubbleFlaw::Kind::NotFinite:
      return "NotFinite";
    case BubbleFlaw::Kind::NoArea:
      return "NoArea";
    case BubbleFlaw::Kind::RingsCross:
      return "RingsCross";
    case BubbleFlaw::Kind::BadSize:
      return "BadSize";
    case BubbleFlaw::Kind::TooMany:
      return "TooMany";
    case BubbleFlaw::Kind::Constraints:
      return "Constraints";
  }
  return "";
}

BubbleMesh bubble_mesh(std::span<const FlatPolygon> polygons, const SizeAt& size_at,
                       std::span<const std::vector<ConstraintSegment>> constraints,
                       const BubbleOptions& options) {
  if (!constraints.empty() && constraints.size() != polygons.size()) {
    throw InputError("constraints should be given for each polygon, or for none");
  }
  BubbleMesh made;
  made.meshes.resize(polygons.size());
  made.quality.resize(polygons.size());
  parallel_for(polygons.size(), 1, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!options.kept.empty() && !options.kept[i].elements.empty()) {
        made.meshes[i] = options.kept[i];
        continue;
      }
      double least = std::numeric_limits<double>::infinity();
      for (const auto& ring : polygons[i].rings) {
        for (const Vec3 p : ring) least = std::min(least, size_at(i, polygons[i].flat(p)));
      }
      made.meshes[i] = delaunay_mesh(polygons[i], least);
    }
  });
  return made;
}

}  // namespace tenku
