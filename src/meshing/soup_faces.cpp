#include "meshing/soup_faces.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tenku {
namespace {

using Corners = std::array<std::uint32_t, 3>;

Vec3 middle_of(const Corners& corner, std::span<const Vec3> vertices) {
  return (1.0 / 3.0) * (vertices[corner[0]] + vertices[corner[1]] + vertices[corner[2]]);
}

/// The triangles that have area.
std::vector<Face> with_area(const TriangleSoup& soup, std::span<const Material> materials,
                            std::span<const std::uint32_t> weld, double weld_m,
                            std::vector<SurfaceFlaw>& flaws) {
  std::vector<Face> faces;
  faces.reserve(soup.size());
  for (std::uint32_t t = 0; t < soup.size(); ++t) {
    if (materials[soup.material[t]].is_glass()) continue;
    Face face{{}, t, soup.material[t], soup.object[t], {}};
    for (unsigned k = 0; k < 3; ++k) face.corner[k] = weld[soup.triangles[t][k]];
    const Vec3 a = soup.vertices[face.corner[0]], b = soup.vertices[face.corner[1]],
               c = soup.vertices[face.corner[2]];
    face.doubled_area = cross(b - a, c - a);
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    if (length(face.doubled_area) > weld_m * longest) {
      faces.push_back(face);
    } else {
      flaws.push_back({SurfaceFlaw::Kind::NoArea, face.object, a});
    }
  }
  return faces;
}

/// Leaves out the later of those with the same corners.
void drop_coincident(std::vector<Face>& faces, std::span<const Vec3> vertices,
                     std::vector<SurfaceFlaw>& flaws) {
  std::vector<std::pair<Corners, std::uint32_t>> keys(faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    keys[f] = {faces[f].corner, f};
    std::sort(keys[f].first.begin(), keys[f].first.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint8_t> is_dropped(faces.size());
  for (std::size_t k = 1, first = 0; k < keys.size(); ++k) {
    if (keys[k].first != keys[first].first) first = k;
    if (first == k) continue;
    const Face &face = faces[keys[k].second], &kept_one = faces[keys[first].second];
    is_dropped[keys[k].second] = 1;
    const auto kind = face.material == kept_one.material ? SurfaceFlaw::Kind::Duplicate
                                                         : SurfaceFlaw::Kind::Coincident;
    flaws.push_back({kind, face.object, middle_of(face.corner, vertices), 0.0, kept_one.object});
  }
  std::size_t kept = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (is_dropped[f] == 0) faces[kept++] = faces[f];
  }
  faces.resize(kept);
}

}  // namespace

std::vector<Face> faces_of(const TriangleSoup& soup, std::span<const Material> materials,
                           std::span<const std::uint32_t> weld, double weld_m,
                           std::vector<SurfaceFlaw>& flaws) {
  std::vector<Face> faces = with_area(soup, materials, weld, weld_m, flaws);
  drop_coincident(faces, soup.vertices, flaws);
  return faces;
}

}  // namespace tenku
