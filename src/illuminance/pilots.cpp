#include "illuminance/pilots.h"

#include <algorithm>
#include <cmath>

namespace tenku {

double Pilots::interval_per_scale(const std::vector<double>& value,
                                  const std::vector<double>& scale) const {
  std::vector<double> ratio;
  for (std::size_t k = 0; k < value.size(); ++k) {
    ratio.push_back(std::abs(value[k] - lux[k]) / scale[k]);
  }
  if (ratio.empty()) return 0.0;
  std::sort(ratio.begin(), ratio.end());
  const double rank = std::ceil(kConfidence * static_cast<double>(ratio.size() + 1));
  return ratio[std::min(ratio.size(), static_cast<std::size_t>(rank)) - 1];
}

}  // namespace tenku
