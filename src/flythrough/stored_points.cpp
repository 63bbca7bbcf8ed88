#include "flythrough/stored_points.h"

namespace tenku {

Extent StoredPoints::extent() const {
  Extent box;
  for (const Vec3 p : position) box.add(p);
  return box;
}

StoredPoints StoredPoints::of(const std::vector<std::uint32_t>& chosen) const {
  StoredPoints some;
  for (const std::uint32_t i : chosen) {
    some.position.push_back(position[i]);
    some.normal.push_back(normal[i]);
    some.footprint_m.push_back(footprint_m[i]);
    some.object.push_back(object[i]);
    some.material.push_back(material[i]);
    some.is_edge.push_back(is_edge[i]);
    some.borders.push_back(borders[i]);
  }
  return some;
}

}  // namespace tenku
