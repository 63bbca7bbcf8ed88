#include <cmath>
#include <utility>

#include "form_factors/form_factor_methods.h"
#include "meshing/mesh_soup.h"
#include "visibility/ray_visibility.h"

namespace tenku {
namespace {

constexpr int kAlongEdge = 4;  // its square: equal parts of an element

class DimmedByPanes : public FormFactorMethod {
 public:
  DimmedByPanes(std::unique_ptr<FormFactorMethod> method, const ElementMesh& mesh)
      : method_(std::move(method)),
        mesh_(mesh),
        soup_(soup_of(mesh)),
        rays_(soup_.soup, soup_.materials) {}

  std::string_view name() const override { return method_->name(); }
  double lift_m() const override { return method_->lift_m(); }
  bool sees_panes() const override { return true; }

  FormFactorRow from_point(Vec3 position, Vec3 normal) const override {
    FormFactorRow row = method_->from_point(position, normal);
    for (FormFactor& f : row) {
      f.value *= static_cast<float>(transmission(position, normal, f.side / 2));
    }
    return row;
  }

 private:
  /// Toward the middles of equal parts of an element, each by its form factor.
  double transmission(Vec3 position, Vec3 normal, std::uint32_t element) const {
    const auto& [i, j, k] = mesh_.elements[element];
    const Vec3 a = mesh_.vertices[i], ab = (1.0 / kAlongEdge) * (mesh_.vertices[j] - a),
               ac = (1.0 / kAlongEdge) * (mesh_.vertices[k] - a), across = cross(ab, ac);
    double all = 0.0, passed = 0.0;
    const auto add = [&](double u, double v) {
      const Vec3 way = a + u * ab + v * ac - position;
      const double away = length(way), height = dot(way, normal);
      if (!(height > 0.0)) return;
      const double weight = height * std::abs(dot(way, across)) / std::pow(away, 4);
      all += weight;
      passed += weight * rays_.glass_transmission(position, (1.0 / away) * way, away);
    };
    for (int u = 0; u < kAlongEdge; ++u) {
      for (int v = 0; u + v < kAlongEdge; ++v) {
        add(u + 1.0 / 3.0, v + 1.0 / 3.0);
        if (u + v + 1 < kAlongEdge) add(u + 2.0 / 3.0, v + 2.0 / 3.0);
      }
    }
    return all > 0.0 ? passed / all : 1.0;
  }

  std::unique_ptr<FormFactorMethod> method_;
  const ElementMesh& mesh_;
  MeshSoup soup_;
  RayVisibility rays_;
};

}  // namespace

std::unique_ptr<FormFactorMethod> dimmed_by_panes(std::unique_ptr<FormFactorMethod> method,
                                                  const ElementMesh& mesh) {
  return std::make_unique<DimmedByPanes>(std::move(method), mesh);
}

}  // namespace tenku
