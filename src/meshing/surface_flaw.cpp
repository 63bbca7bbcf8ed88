#include "meshing/surface_flaw.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

#include "scene/geometry_checks.h"

namespace tenku {
namespace {

std::string name_of_object(const Scene& scene, std::uint32_t object) {
  return object < scene.objects.size() ? scene.objects[object].id : std::string();
}

Finding finding_of(const SurfaceFlaw& flaw, const Scene& scene) {
  using Kind = SurfaceFlaw::Kind;
  Finding made;
  made.object = name_of_object(scene, flaw.object);
  made.where = place_in_file(scene, flaw.where);
  const std::string other = name_of_object(scene, flaw.other);
  const auto says = [&](const char* code, Severity severity, std::string what, const char* repair) {
    made.code = code;
    made.severity = severity;
    made.what = std::move(what);
    made.repair = repair;
  };
  switch (flaw.kind) {
    case Kind::NoArea:
      says("faces_without_area", Severity::Note,
           "triangles are narrower than the tolerance with which vertices are joined", "left out");
      break;
    case Kind::Duplicate:
      says("duplicate_surfaces", Severity::Note,
           fmt::format("surfaces lie in the place of others of the same material (first: [{}])",
                       other),
           "the later ones are left out; nothing is lost, as elements have two sides");
      break;
    case Kind::Coincident:
      says("coincident_surfaces", Severity::Warning,
           fmt::format("surfaces lie in the place of others of another material (first: [{}])",
                       other),
           "the later ones are left out, and their materials; leave one in the file, or move them "
           "apart by the thickness of the wall");
      break;
    case Kind::Overlap:
      says("overlapping_surfaces", Severity::Warning,
           fmt::format("surfaces lie on parts of others in the same plane (first: [{}]): which of "
                       "them light meets is left to rounding",
                       other),
           "both are kept; cut the one out of the other, or move it off by a millimetre");
      break;
    case Kind::Gap:
      says("gap_between_surfaces", Severity::Warning,
           fmt::format("edges stop {:.3g} mm before another surface (first: [{}]): light passes",
                       1000.0 * flaw.size_m, other),
           "taken as it is; let the surfaces meet if they should");
      break;
    case Kind::Sliver:
      says("sliver_surfaces", Severity::Note,
           fmt::format("surfaces are more than a hundred times as long as wide (first: {:.3g} mm)",
                       1000.0 * flaw.size_m),
           "their elements are long; values there are less exact, those elsewhere are not");
      break;
    case Kind::Coarse:
      says("elements_below_float", Severity::Warning,
           fmt::format("elements are as narrow as {:.3g} mm, a few steps of the 32-bit numbers in "
                       "which rays are traced this far from the origin: light may pass between "
                       "neighbours or miss",
                       1000.0 * flaw.size_m),
           "move the scene to the origin, or divide it less finely");
      break;
  }
  return made;
}

}  // namespace

std::vector<Finding> findings_of(const std::vector<SurfaceFlaw>& flaws, const Scene& scene) {
  std::map<SurfaceFlaw::Kind, Finding> of_kind;
  for (const SurfaceFlaw& flaw : flaws) {
    const auto at = of_kind.find(flaw.kind);
    if (at == of_kind.end()) {
      of_kind.emplace(flaw.kind, finding_of(flaw, scene));
    } else {
      ++at->second.count;
    }
  }
  std::vector<Finding> findings;
  for (const auto& [kind, finding] : of_kind) findings.push_back(finding);
  return findings;
}

}  // namespace tenku
