#include "visibility/engines.h"

namespace tenku {

Engines::Engines(const TriangleSoup& soup, const std::vector<Material>& materials,
                 GlPlatform platform)
    : rays_(soup, materials), platform_(platform) {}

const ShadowMaps& Engines::maps() const {
  std::call_once(once_, [&] {
    ShadowMapOptions options;
    options.platform = platform_;
    maps_ = std::make_unique<ShadowMaps>(rays_.soup(), rays_.materials(), options);
  });
  return *maps_;
}

}  // namespace tenku
