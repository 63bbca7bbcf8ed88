#include <array>
#include <cmath>

#include "form_factors/form_factor_methods.h"
#include "form_factors/item_buffer.h"
#include "form_factors/point_view.h"
#include "form_factors/scan_lines.h"

namespace tenku {
namespace {

/// A face of the cube: the plane w = 1, seen along w, with u from -1 to 1 and v from `low` to 1.
struct CubeFace {
  Vec3 u, v, w;
  double low;
};

/// The top, and four sides of which the upper halves are used.
constexpr std::array<CubeFace, 5> kFaces{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, -1.0},
                                          {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, 0.0},
                                          {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.0},
                                          {{0, -1, 0}, {0, 0, 1}, {-1, 0, 0}, 0.0},
                                          {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, 0.0}}};

/// The part inside the pyramid over the face, or nothing. Corners in the coordinates of the face.
ConvexPolygon inside(const CubeFace& face, const std::array<Vec3, 3>& corner) {
  ConvexPolygon polygon;
  unsigned outside_all = ~0U, outside_any = 0;
  for (const Vec3& c : corner) {
    const Vec3 p{dot(c, face.u), dot(c, face.v), dot(c, face.w)};
    const unsigned outside = (p.x > p.z ? 1U : 0U) | (p.x < -p.z ? 2U : 0U) |
                             (p.y > p.z ? 4U : 0U) | (p.y < face.low * p.z ? 8U : 0U) |
                             (p.z <= 0.0 ? 16U : 0U);
    outside_all &= outside, outside_any |= outside;
    polygon.add(p);
  }
  if (outside_all != 0) return {};
  if (outside_any == 0) return polygon;
  polygon = cut(polygon, [](Vec3 p) { return p.z; });
  polygon = cut(polygon, [](Vec3 p) { return p.z - p.x; });
  polygon = cut(polygon, [](Vec3 p) { return p.z + p.x; });
  polygon = cut(polygon, [](Vec3 p) { return p.z - p.y; });
  return cut(polygon, [&](Vec3 p) { return p.y - face.low * p.z; });
}

/// Five pictures on the faces of half a cube, the pixels of which have form factors of their own.
///
/// Source  M. F. Cohen and D. P. Greenberg, "The hemi-cube: a radiosity solution for complex
///         environments", SIGGRAPH 1985.
class Hemicube : public FormFactorMethod {
 public:
  Hemicube(const ElementMesh& mesh, const FormFactorOptions& options)
      : mesh_(mesh),
        seed_(options.seed),
        side_(options.resolution + options.resolution % 2),
        step_(2.0 / side_),
        top_(delta_form_factors(kFaces[0])),
        wall_(delta_form_factors(kFaces[1])) {}

  std::string_view name() const override { return "hemicube"; }

  FormFactorRow from_point(Vec3 position, Vec3 normal) const override {
    const PointView view(mesh_, position, PointAxes(normal, key_of(position, normal, seed_)));
    std::vector<double> covered(view.seen.size());
    for (const CubeFace& face : kFaces) {
      const ItemBuffer buffer = draw(view, face);
      const std::vector<double>& delta = face.low < 0.0 ? top_ : wall_;
      for (std::size_t k = 0; k < delta.size(); ++k) {
        if (buffer.item()[k] != ItemBuffer::kNothing) covered[buffer.item()[k]] += delta[k];
      }
    }
    return row_of(view, covered, 1.0);
  }

 private:
  int rows(const CubeFace& face) const { return face.low < 0.0 ? side_ : side_ / 2; }
  double u_at(std::size_t column) const {
    return -1.0 + (static_cast<double>(column) + 0.5) * step_;
  }
  double v_at(const CubeFace& face, int row) const { return face.low + (row + 0.5) * step_; }

  /// Of the pixels of a face, [row][column]: the cosine at the point over pi times the solid angle
  /// of the pixel; the height over the horizon is 1 on the top and v on a side.
  std::vector<double> delta_form_factors(const CubeFace& face) const {
    std::vector<double> delta;
    for (int row = 0; row < rows(face); ++row) {
      for (std::size_t column = 0; column < static_cast<std::size_t>(side_); ++column) {
        const double u = u_at(column), v = v_at(face, row), square = 1.0 + u * u + v * v;
        delta.push_back((face.low < 0.0 ? 1.0 : v) * step_ * step_ / (kPi * square * square));
      }
    }
    return delta;
  }

  ItemBuffer draw(const PointView& view, const CubeFace& face) const {
    ItemBuffer buffer(rows(face), side_);
    ScanLines scan({v_at(face, 0), step_, rows(face)});
    std::vector<PlanePoint> outline;
    for (std::uint32_t s = 0; s < view.seen.size(); ++s) {
      const auto& [a, b, c] = mesh_.elements[view.seen[s].side / 2];
      outline.clear();
      for (const Vec3& p : inside(face, {view.vertex[a], view.vertex[b], view.vertex[c]})) {
        if (p.z > 0.0) outline.push_back({p.x / p.z, p.y / p.z});
      }
      const Vec3 nearness = view.seen[s].nearness;
      const double of_u = dot(nearness, face.u), of_v = dot(nearness, face.v);
      scan.spans(outline, [&](int row, double x0, double x1) {
        const double of_row = of_v * v_at(face, row) + dot(nearness, face.w);
        buffer.fill(row, (x0 + 1.0) / step_, (x1 + 1.0) / step_, s,
                    [&](std::size_t column) { return of_u * u_at(column) + of_row; });
      });
    }
    return buffer;
  }

  const ElementMesh& mesh_;
  std::uint64_t seed_;
  int side_;  ///< pixels along the edge of the cube
  double step_;
  std::vector<double> top_, wall_;
};

}  // namespace

std::unique_ptr<FormFactorMethod> make_hemicube(const ElementMesh& mesh,
                                                const FormFactorOptions& options) {
  return std::make_unique<Hemicube>(mesh, options);
}

}  // namespace tenku
