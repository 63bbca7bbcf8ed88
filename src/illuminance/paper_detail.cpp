#include "illuminance/paper_detail.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace tenku {

SharedElements::Wanted paper_detail(const SharedElements& elements, const SeenPolygons& polygons,
                                    double mu) {
  if (!(mu > 0.0) || !std::isfinite(mu)) {
    throw InputError("mu " + std::to_string(mu) + " is not a number above 0");
  }
  SharedElements::Wanted wanted;
  wanted.group = polygons.of_sensor;
  wanted.elements.resize(polygons.normal.size());
  const double open = elements.unobstructed_lux(kZenith);
  constexpr std::size_t kGrain = 64;
  parallel_for(polygons.normal.size(), kGrain, [&](IndexRange range) {
    std::vector<std::size_t> order(elements.count());
    for (std::size_t p = range.begin; p < range.end; ++p) {
      const std::vector<double> lux = elements.unobstructed_parts(polygons.normal[p]);
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return lux[a] > lux[b]; });
      std::vector<bool>& needs = wanted.elements[p];
      needs.assign(order.size(), false);
      double rest = std::accumulate(lux.begin(), lux.end(), 0.0);
      for (const std::size_t e : order) {
        if (rest / open * polygons.pixels[p] < mu) break;
        needs[e] = true;
        rest -= lux[e];
      }
    }
  });
  return wanted;
}

}  // namespace tenku
