#include "illuminance/pilots.h"

#include <algorithm>
#include <cmath>

namespace tenku {

double conformal_quantile(const std::vector<double>& sorted) {
  const double rank = std::ceil(Pilots::kConfidence * static_cast<double>(sorted.size() + 1));
  return sorted[std::min(sorted.size(), static_cast<std::size_t>(rank)) - 1];
}

double Pilots::interval_per_scale(const std::vector<double>& value,
                                  const std::vector<double>& scale) const {
  std::vector<double> ratio;
  for (std::size_t k = 0; k < value.size(); ++k) {
    ratio.push_back(std::abs(value[k] - lux[k]) / scale[k]);
  }
  if (ratio.empty()) return 0.0;
  std::sort(ratio.begin(), ratio.end());
  return conformal_quantile(ratio);
}

}  // namespace tenku
