#include "illuminance/wide_texels.h"

#include <fmt/format.h>

namespace tenku {

std::optional<Finding> wide_texels(std::span<const PlannedRegion> regions, const FileFrame& frame) {
  const PlannedRegion* worst = nullptr;
  const auto excess = [](const PlannedRegion& r) { return r.texel_m / r.wanted_texel_m; };
  std::size_t count = 0;
  for (const PlannedRegion& region : regions) {
    if (region.engine != Engine::ShadowMaps || !(excess(region) > 1.0)) continue;
    ++count;
    if (worst == nullptr || excess(region) > excess(*worst)) worst = &region;
  }
  if (worst == nullptr) return std::nullopt;
  const Vec3 at = frame.to_file(worst->middle);
  return Finding{
      "texels_wide",
      Severity::Warning,
      "",
      fmt::format("{} sensors about {:.2f} {:.2f} {:.2f}", worst->sensors, at.x, at.y, at.z),
      fmt::format("shadow maps have texels of {:.2g} m where the tolerance asks for {:.2g} m: what "
                  "is narrower and stands alone may be missed",
                  worst->texel_m, worst->wanted_texel_m),
      "light fewer sensors at a time, ask for --engine rays, or for a wider tolerance",
      count};
}

}  // namespace tenku
