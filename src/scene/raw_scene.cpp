#include "scene/raw_scene.h"

namespace tenku {

void FindingCounter::add(const Finding& finding) {
  const auto [at, is_new] = index_.try_emplace({finding.code, finding.object}, findings_.size());
  if (is_new) {
    findings_.push_back(finding);
  } else {
    findings_[at->second].count += finding.count;
  }
}

void end_surface(Surfaces& surfaces, const SurfaceFacts& facts) {
  surfaces.first_ring.push_back(static_cast<std::uint32_t>(surfaces.first_vertex.size() - 1));
  surfaces.type.push_back(facts.type);
  surfaces.lod.push_back(facts.lod);
  surfaces.object.push_back(facts.object);
  surfaces.material.push_back(facts.material);
  surfaces.shell.push_back(facts.shell);
}

std::uint32_t ObjectsByName::find_or_add(RawScene& raw, const std::string& id) {
  const auto next = static_cast<std::uint32_t>(raw.scene.objects.size());
  const auto [at, is_new] = index_.try_emplace(id, next);
  if (is_new) {
    raw.scene.objects.push_back({id, ""});
    raw.is_building.push_back(0);
  }
  return at->second;
}

}  // namespace tenku
