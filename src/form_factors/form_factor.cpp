#include "form_factors/form_factor.h"

#include <array>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/named.h"
#include "form_factors/form_factor_methods.h"

namespace tenku {
namespace {

constexpr std::array<std::pair<std::string_view, FormFactorMaker*>, 5> kMethods{
    {{"hemisphere-scanline", &make_hemisphere_scanline},
     {"hemisphere-zbuffer", &make_hemisphere_zbuffer},
     {"hemisphere-rays", &make_hemisphere_rays},
     {"hemicube", &make_hemicube},
     {"analytic", &make_analytic_form_factors}}};

constexpr int kMaximumResolution = 8192;

FormFactorMaker* maker_named(std::string_view name) {
  return named(name, kMethods, "form-factor method");
}

}  // namespace

std::vector<std::string_view> form_factor_method_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, maker] : kMethods) names.push_back(name);
  return names;
}

void check_form_factor_method(std::string_view name, const FormFactorOptions& options) {
  maker_named(name);
  if (options.resolution < 2 || options.resolution > kMaximumResolution) {
    throw InputError("the resolution of form factors is from 2 to " +
                     std::to_string(kMaximumResolution) + ", not " +
                     std::to_string(options.resolution));
  }
  if (!(options.polyline_deg == 0.0 ||
        (options.polyline_deg >= 0.01 && options.polyline_deg <= 45.0))) {
    throw InputError(
        "edges on the disc are straight over 0.01 to 45 degrees, or arcs with 0; not " +
        std::to_string(options.polyline_deg));
  }
}

std::unique_ptr<FormFactorMethod> form_factor_method(std::string_view name, const ElementMesh& mesh,
                                                     const FormFactorOptions& options) {
  check_form_factor_method(name, options);
  auto method = maker_named(name)(mesh, options);
  if (mesh.panes.empty() || method->sees_panes()) return method;
  return dimmed_by_panes(std::move(method), mesh);
}

}  // namespace tenku
