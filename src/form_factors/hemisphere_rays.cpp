#include "form_factors/form_factor_methods.h"
#include "form_factors/hemisphere_look.h"

namespace tenku {
namespace {

class HemisphereRays : public FormFactorMethod {
 public:
  HemisphereRays(const ElementMesh& mesh, const FormFactorOptions& options)
      : mesh_(mesh), look_(mesh_, options.resolution, options.seed) {}

  std::string_view name() const override { return "hemisphere-rays"; }
  double lift_m() const override { return mesh_.rays.lift_m(); }
  bool sees_panes() const override { return true; }

  FormFactorRow from_point(Vec3 position, Vec3 normal) const override {
    return row_of(look_.from_point(position, normal));
  }

 private:
  MeshRays mesh_;
  HemisphereLook look_;
};

}  // namespace

std::unique_ptr<FormFactorMethod> make_hemisphere_rays(const ElementMesh& mesh,
                                                       const FormFactorOptions& options) {
  return std::make_unique<HemisphereRays>(mesh, options);
}

}  // namespace tenku
