/// The page of `tenku reflections`.
#pragma once

#include <string>
#include <vector>

#include "study/reflected_sun.h"
#include "study/sun_views.h"

namespace tenku {

/// What the page is made from.
struct ReflectionReport {
  std::string title;
  std::string when;  ///< `2026-06-21, every 5 minutes`
  double plan_cell_m = 1.0;
  const std::vector<SunObserver>* observers = nullptr;
  const std::vector<SunView>* views = nullptr;
  std::vector<Finding> findings;
};

/// @param sun  with overlaps added
std::string reflection_report(const ReflectionReport& request, const ReflectedSun& sun,
                              const LitScene& lit);

}  // namespace tenku
