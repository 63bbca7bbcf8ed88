#include "visibility/visibility.h"

#include <vector>

#include "core/error.h"
#include "core/parallel.h"

namespace tenku {

void Visibility::transmission_from(Vec3 direction, std::span<const Vec3> point,
                                   std::span<const Vec3> normal, std::span<float> result) const {
  expects(point.size() == result.size() && (normal.empty() || normal.size() == point.size()),
          "a point has a normal and a result");
  constexpr std::size_t kGrain = 4096;
  parallel_for(point.size(), kGrain, [&](IndexRange range) {
    std::vector<Vec3> origin;
    std::vector<std::size_t> place;
    for (std::size_t k = range.begin; k < range.end; ++k) {
      result[k] = 0.0F;
      if (!normal.empty() && !(dot(normal[k], direction) > 0.0)) continue;
      origin.push_back(point[k]);
      place.push_back(k);
    }
    const std::vector<Vec3> directions(origin.size(), direction);
    std::vector<float> seen(origin.size());
    transmission(origin, directions, seen);
    for (std::size_t k = 0; k < place.size(); ++k) result[place[k]] = seen[k];
  });
}

}  // namespace tenku
