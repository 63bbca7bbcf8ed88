/// The ways of the sun over a place through the year, on a plan of the sky.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/units.h"

namespace tenku {

/// A position of the sun.
struct DiagramPoint {
  Angle azimuth, altitude;
};

/// A way of the sun: through one day, or at one hour through the year. Parts below the horizon are
/// not drawn.
struct DiagramLine {
  std::string label;  ///< `21 Jun`, `9`; empty for none
  std::vector<DiagramPoint> points;
};

enum class SunPathProjection {
  Stereographic,  ///< radius tan(z / 2) of the zenith angle z: angles are kept
  Equidistant     ///< radius z / 90 degrees
};

/// What the diagram shows.
struct SunPathDiagram {
  std::string title;               ///< for screen readers too
  std::vector<DiagramLine> days;   ///< usually the 21st of each month
  std::vector<DiagramLine> hours;  ///< one line an hour
  std::optional<DiagramPoint> instant;
  std::string instant_label;
  SunPathProjection projection = SunPathProjection::Stereographic;
};

/// The diagram as an SVG picture: a plan of the sky, zenith in the middle, north up, east to the
/// right. Fonts are the reader's; nothing is loaded.
std::string sun_path_svg(const SunPathDiagram& diagram);

/// Where a position lies on the plan, for a horizon of radius 1: x east, y north.
struct SunPathPlace {
  double x = 0.0, y = 0.0;
};
SunPathPlace sun_path_place(DiagramPoint point, SunPathProjection projection);

}  // namespace tenku
