#include "reports/sun_path_diagram.h"

#include <cmath>

#include "reports/html.h"

namespace tenku {
namespace {

constexpr double kRadius = 250.0, kCentreX = 310.0, kCentreY = 310.0;  // user units
constexpr double kWidth = 700.0, kHeight = 620.0;
constexpr double kSun = 9.0;      // radius of its disc, user units
constexpr double kAtRim = 0.9;    // of the radius, beyond which a label reaches out of the horizon
constexpr double kLabel = 0.035;  // half the height of a label, of the radius

std::string at(double x, double y) {
  return coordinate(kCentreX + kRadius * x) + " " + coordinate(kCentreY - kRadius * y);
}

DiagramPoint mixed(DiagramPoint a, DiagramPoint b, double t) {
  // Azimuths the short way round.
  const double turn = std::remainder((b.azimuth - a.azimuth).in_radians(), 2.0 * kPi);
  return {a.azimuth + Angle::radians(t * turn), a.altitude + t * (b.altitude - a.altitude)};
}

DiagramPoint at_horizon(DiagramPoint a, DiagramPoint b) {
  return mixed(a, b, a.altitude.in_radians() / (a.altitude - b.altitude).in_radians());
}

bool is_up(DiagramPoint p) { return p.altitude >= Angle(); }

// The parts of a line above the horizon, each cut exactly at it.
std::vector<std::vector<DiagramPoint>> visible_parts(const std::vector<DiagramPoint>& points) {
  std::vector<std::vector<DiagramPoint>> parts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool up = is_up(points[i]), was_up = i > 0 && is_up(points[i - 1]);
    if (up && !was_up) {
      parts.emplace_back();
      if (i > 0) parts.back().push_back(at_horizon(points[i - 1], points[i]));
    }
    if (up) parts.back().push_back(points[i]);
    if (!up && was_up) parts.back().push_back(at_horizon(points[i - 1], points[i]));
  }
  return parts;
}

std::string polyline(const std::vector<DiagramPoint>& points, SunPathProjection projection,
                     const char* style) {
  std::string path;
  for (const DiagramPoint p : points) {
    const SunPathPlace place = sun_path_place(p, projection);
    path += path.empty() ? 'M' : 'L';
    path += at(place.x, place.y);
  }
  return "<path class=\"" + std::string(style) + "\" d=\"" + path + "\"/>\n";
}

std::string text_at(double x, double y, const std::string& text, const char* style,
                    const char* anchor) {
  return "<text class=\"" + std::string(style) + "\" text-anchor=\"" + anchor + "\" x=\"" +
         coordinate(kCentreX + kRadius * x) + "\" y=\"" + coordinate(kCentreY - kRadius * y + 4.5) +
         "\">" + escaped(text) + "</text>\n";
}

std::string rings(SunPathProjection projection) {
  std::string svg;
  for (const int altitude : {0, 15, 30, 45, 60, 75}) {
    const double r = sun_path_place({{}, Angle::degrees(altitude)}, projection).y;
    svg += std::string("<circle class=\"") + (altitude == 0 ? "horizon" : "ring") + "\" cx=\"" +
           coordinate(kCentreX) + "\" cy=\"" + coordinate(kCentreY) + "\" r=\"" +
           coordinate(kRadius * r) + "\"/>\n";
    if (altitude > 0) svg += text_at(0.0, r, std::to_string(altitude) + "°", "alt", "middle");
  }
  return svg;
}

const char* anchor_for(double x) { return x > 0.05 ? "start" : x < -0.05 ? "end" : "middle"; }

bool is_near(double angle, const std::vector<double>& others, double within) {
  for (const double other : others) {
    if (std::abs(std::remainder(angle - other, 2.0 * kPi)) < within) return true;
  }
  return false;
}

// Spokes every 30 degrees; degrees outside the horizon where no day's label stands; E further out.
std::string spokes(const std::vector<double>& taken) {
  std::string svg;
  for (int azimuth = 0; azimuth < 360; azimuth += 30) {
    const double a = azimuth * kPi / 180.0, x = std::sin(a), y = std::cos(a);
    svg += "<path class=\"ring\" d=\"M" + at(0.0, 0.0) + "L" + at(x, y) + "\"/>\n";
    const bool free = !is_near(a, taken, 0.15);
    if (azimuth % 90 == 0) {
      const double r = free ? 1.09 : 1.3;
      const char letter = "NESW"[azimuth / 90];
      svg += text_at(r * x, r * y, std::string(1, letter), "cardinal", "middle");
    } else if (free) {
      svg += text_at(1.045 * x, 1.045 * y, std::to_string(azimuth) + "°", "alt", anchor_for(x));
    }
  }
  return svg;
}

std::string day_lines(const SunPathDiagram& diagram, std::vector<double>& taken) {
  std::string svg;
  for (const DiagramLine& day : diagram.days) {
    const auto parts = visible_parts(day.points);
    for (const auto& part : parts) svg += polyline(part, diagram.projection, "day");
    if (parts.empty() || day.label.empty()) continue;
    const SunPathPlace p = sun_path_place(parts.front().front(), diagram.projection);
    const double angle = std::atan2(p.x, p.y);
    if (is_near(angle, taken, 0.045)) continue;
    const bool rises = std::hypot(p.x, p.y) > kAtRim;
    if (rises) taken.push_back(angle);
    svg += text_at(1.025 * p.x, 1.025 * p.y, day.label, rises ? "daylabel" : "daylabel halo",
                   anchor_for(p.x));
  }
  return svg;
}

// Beside the end of an hour's line, where the disc of the sun does not cover it.
SunPathPlace hour_label_place(SunPathPlace end, const SunPathDiagram& diagram) {
  const double free = kSun / kRadius + 1.5 * kLabel;
  for (const double up : {kLabel, 3.0 * kLabel, -2.0 * kLabel, -4.0 * kLabel}) {
    const SunPathPlace place{end.x, end.y + up};
    if (!diagram.instant) return place;
    const SunPathPlace sun = sun_path_place(*diagram.instant, diagram.projection);
    if (std::hypot(place.x - sun.x, place.y - sun.y) > free) return place;
  }
  return end;
}

std::string hour_lines(const SunPathDiagram& diagram) {
  std::string svg, labels;
  for (const DiagramLine& hour : diagram.hours) {
    const auto parts = visible_parts(hour.points);
    const DiagramPoint* highest = nullptr;
    for (const auto& part : parts) {
      svg += polyline(part, diagram.projection, "hour");
      for (const DiagramPoint& p : part) {
        if (highest == nullptr || p.altitude > highest->altitude) highest = &p;
      }
    }
    if (highest == nullptr || hour.label.empty()) continue;
    const SunPathPlace p = hour_label_place(sun_path_place(*highest, diagram.projection), diagram);
    labels += text_at(p.x, p.y, hour.label, "hourlabel halo", "middle");
  }
  return svg + labels;
}

std::string instant_mark(const SunPathDiagram& diagram) {
  if (!diagram.instant || !is_up(*diagram.instant)) return {};
  const SunPathPlace p = sun_path_place(*diagram.instant, diagram.projection);
  const auto sun_at = [](double x, double y) {
    return "<circle class=\"sun\" cx=\"" + coordinate(kCentreX + kRadius * x) + "\" cy=\"" +
           coordinate(kCentreY - kRadius * y) + "\" r=\"" + coordinate(kSun) + "\"/>\n";
  };
  // Its name stands in the corner, where no line passes.
  return "<path class=\"beam\" d=\"M" + at(0.0, 0.0) + "L" + at(p.x, p.y) + "\"/>\n" +
         sun_at(p.x, p.y) + sun_at(-1.15, 1.12) +
         text_at(-1.09, 1.12, diagram.instant_label, "sunlabel", "start");
}

constexpr const char* kStyle =
    "<style>"
    ".sunpath text{font-family:system-ui,-apple-system,'Segoe UI','Noto "
    "Sans',sans-serif;fill:#20242a}"
    ".sunpath .ring{fill:none;stroke:#d3d7db;stroke-width:1}"
    ".sunpath .horizon{fill:#fbfbf9;stroke:#4a4f55;stroke-width:1.5}"
    ".sunpath .day{fill:none;stroke:#b4450b;stroke-width:1.6}"
    ".sunpath .hour{fill:none;stroke:#33658a;stroke-width:1;stroke-dasharray:4 3}"
    ".sunpath .beam{fill:none;stroke:#20242a;stroke-width:1.2}"
    ".sunpath .sun{fill:#ffc93c;stroke:#20242a;stroke-width:1.6}"
    ".sunpath .alt{font-size:11px;fill:#646b72}"
    ".sunpath .cardinal{font-size:17px;font-weight:700}"
    ".sunpath .daylabel{font-size:12px;fill:#8f3607}"
    ".sunpath .hourlabel{font-size:12px;fill:#24506f}"
    ".sunpath .sunlabel{font-size:13.5px;font-weight:700}"
    ".sunpath .halo{paint-order:stroke;stroke:#fbfbf9;stroke-width:4px;stroke-linejoin:round}"
    "</style>\n";

}  // namespace

SunPathPlace sun_path_place(DiagramPoint point, SunPathProjection projection) {
  const double zenith_angle = 0.5 * kPi - point.altitude.in_radians();
  const double r = projection == SunPathProjection::Stereographic ? std::tan(0.5 * zenith_angle)
                                                                  : zenith_angle / (0.5 * kPi);
  return {r * std::sin(point.azimuth.in_radians()), r * std::cos(point.azimuth.in_radians())};
}

std::string sun_path_svg(const SunPathDiagram& diagram) {
  std::vector<double> taken;
  const std::string days = day_lines(diagram, taken);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"sunpath\" viewBox=\"0 0 " +
                    coordinate(kWidth) + " " + coordinate(kHeight) +
                    "\" role=\"img\" aria-label=\"" + escaped(diagram.title) + "\">\n<title>" +
                    escaped(diagram.title) + "</title>\n";
  svg += kStyle;
  svg += rings(diagram.projection) + spokes(taken) + hour_lines(diagram) + days;
  const bool keeps_angles = diagram.projection == SunPathProjection::Stereographic;
  svg += text_at(1.54, -1.2, keeps_angles ? "stereographic projection" : "equidistant projection",
                 "alt", "end");
  return svg + instant_mark(diagram) + "</svg>\n";
}

}  // namespace tenku
