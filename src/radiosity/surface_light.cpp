#include "radiosity/surface_light.h"

#include <algorithm>
#include <set>

namespace tenku {
namespace {

constexpr double kMostReflectance = 0.99;  // of a mirror counted as diffuse beside its diffuse part

Rgb diffuse_of(const Material& m) {
  if (!(m.mirror > 0.0)) return m.reflectance;
  const auto both = [&](double diffuse) { return std::min(diffuse + m.mirror, kMostReflectance); };
  return {both(m.reflectance.r), both(m.reflectance.g), both(m.reflectance.b)};
}

Finding mirrors_found(std::size_t count, const std::string& name) {
  Finding finding;
  finding.code = "mirror_as_diffuse";
  finding.severity = Severity::Note;
  finding.object = name;
  finding.what =
      "radiosity knows diffuse surfaces only: the mirror reflects as much, but diffusely";
  finding.repair = "tenku reflections, or tenku render, follow mirrors";
  finding.count = count;
  return finding;
}

}  // namespace

SurfaceLight surface_light(const ElementMesh& mesh, const std::vector<Material>& materials,
                           std::vector<Finding>& findings) {
  SurfaceLight light;
  std::set<std::uint32_t> mirrors;
  for (std::size_t e = 0; e < mesh.size(); ++e) {
    const Material& material = materials[mesh.material[e]];
    if (material.mirror > 0.0) mirrors.insert(mesh.material[e]);
    const Rgb rho = diffuse_of(material);
    light.area_m2.push_back(mesh.area_m2(e));
    light.reflectance.push_back(rho);
    light.emission_lm_m2.push_back(material.emission_lm_m2);
    light.any_emits |= light.emits(e);
    light.most_reflectance = std::max({light.most_reflectance, rho.r, rho.g, rho.b});
  }
  if (!mirrors.empty()) {
    findings.push_back(mirrors_found(mirrors.size(), materials[*mirrors.begin()].name));
  }
  return light;
}

}  // namespace tenku
