/// Error against time of many settings, as a chart and as a page.
#pragma once

#include <string>
#include <vector>

#include "core/vec3.h"
#include "view/image.h"

namespace tenku {

/// One setting on the chart.
struct SpeedMark {
  std::string line;   ///< marks of one line are joined
  std::string label;  ///< what a reader sees who points at it
  double time_s = 0.0, spread_s = 0.0, error_pct = 0.0;
  bool is_on_front = false, is_knee = false, is_under_floor = false;
};

struct SpeedChart {
  std::string title;
  std::vector<SpeedMark> marks;
  double floor_pct = 0.0;  ///< error of the reference itself; 0: not drawn
};

/// Both axes logarithmic; the front as a bold line, its knee ringed, the floor shaded.
std::string speed_chart_svg(const SpeedChart& chart);
/// The charts one below the other, for pages that show no SVG.
Image8 speed_chart_picture(const std::vector<SpeedChart>& charts);

/// Where values are wrong, seen from above.
struct ErrorPlan {
  std::string caption;
  std::vector<Vec3> place;        ///< [sensor], x east, y north, metres
  std::vector<double> error_pct;  ///< [sensor], signed
  std::size_t worst = 0;
};

std::string error_plan_svg(const ErrorPlan& plan);

struct SpeedTable {
  std::string title, introduction;
  std::vector<std::string> header;
  std::size_t left_aligned = 1;
  std::vector<std::vector<std::string>> rows;
};

struct SpeedPage {
  std::string title, where, lead;
  std::vector<SpeedChart> charts;
  std::vector<SpeedTable> tables;
  std::vector<ErrorPlan> plans;
  std::string fragment;              ///< of a study, as text
  std::vector<std::string> remarks;  ///< paragraphs
};

/// One page of HTML 5, nothing loaded from elsewhere. Charts tell what a mark is where the pointer
/// rests on it, and grow under the wheel.
std::string speed_page(const SpeedPage& page);

}  // namespace tenku
