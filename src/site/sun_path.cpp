#include "site/sun_path.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace tenku {
namespace {

constexpr double kHour_s = 3600.0;
constexpr double kHalfDay_s = 12.0 * kHour_s;
constexpr double kScan_s = 1800.0;

/// Altitude over time, about one noon.
class DayCurve {
 public:
  DayCurve(const Location& site, Instant noon, const SunOptions& options, Angle horizon)
      : site_(site), noon_(noon), options_(options), horizon_(horizon) {}

  /// Degrees above the horizon asked for, so many seconds after noon.
  double height(double seconds) const {
    return (sun_at(site_, later_by(noon_, seconds), options_).altitude - horizon_).in_degrees();
  }

  /// Where the height changes sign between two times, by bisection and the secant (Illinois).
  double crossing(double from, double to) const {
    double a = from, b = to, fa = height(a), fb = height(b);
    for (int i = 0; i < 60 && std::abs(b - a) > 1e-3; ++i) {
      const double c = b - fb * (b - a) / (fb - fa), fc = height(c);
      if (fc == 0.0) return c;
      if ((fc > 0.0) == (fb > 0.0)) {
        fa *= 0.5;
      } else {
        a = b;
        fa = fb;
      }
      b = c;
      fb = fc;
      if (std::abs(fc) < 1e-9) return c;
    }
    return b;
  }

  /// The crossing nearest to noon on one side of it; `sign` -1 for rise, 1 for set.
  std::optional<double> nearest_crossing(double sign) const {
    double near = 0.0, height_near = height(0.0);
    for (double far = kScan_s; far <= kHalfDay_s; far += kScan_s) {
      const double height_far = height(sign * far);
      if (height_near > 0.0 && height_far <= 0.0) return crossing(sign * near, sign * far);
      near = far;
      height_near = height_far;
    }
    return std::nullopt;
  }

 private:
  const Location& site_;
  Instant noon_;
  const SunOptions& options_;
  Angle horizon_;
};

Instant noon_near(const Location& site, Instant around, const SunOptions& options) {
  constexpr double kDegreesAnHour = 15.0;
  Instant t = around;
  for (int i = 0; i < 4; ++i) {
    const Angle hour_angle = sun_at(site, t, options).hour_angle;
    t = later_by(t, -hour_angle.in_degrees() / kDegreesAnHour * kHour_s);
  }
  return t;
}

void append_if_up(SunPathLine& line, const Location& site, Instant instant) {
  const Sun sun = sun_at(site, instant);
  if (sun.apparent_altitude < Angle()) return;
  line.points.push_back({instant, sun.azimuth, sun.apparent_altitude});
}

Instant local_hour(int year, int month, int day, double hour, int offset_minutes) {
  const Instant midnight = instant_from_utc({year, month, day, 0, 0, 0.0});
  return later_by(midnight, hour * kHour_s - offset_minutes * 60.0);
}

SunPathLine day_arc(const Location& site, int year, int month, int offset_minutes) {
  constexpr double kStep_s = 600.0;
  SunPathLine arc{month, {}};
  const SunDay day = sun_day(site, local_hour(year, month, 21, 12.0, offset_minutes), {},
                             Angle::degrees(-34.0 / 60.0));
  if (day.kind == DayKind::PolarNight) return arc;
  const double from = day.rise ? seconds_between(day.noon, *day.rise) : -kHalfDay_s;
  const double to = day.set ? seconds_between(day.noon, *day.set) : kHalfDay_s;
  const int steps = std::max(2, static_cast<int>(std::ceil((to - from) / kStep_s)));
  for (int i = 0; i <= steps; ++i) {
    append_if_up(arc, site, later_by(day.noon, from + (to - from) * i / steps));
  }
  return arc;
}

SunPathLine hour_line(const Location& site, int year, int hour, int offset_minutes) {
  constexpr std::array kDays{1, 6, 11, 16, 21, 26};
  SunPathLine line{hour, {}};
  for (int month = 1; month <= 12; ++month) {
    for (const int day : kDays) {
      append_if_up(line, site, local_hour(year, month, day, hour, offset_minutes));
    }
  }
  return line;
}

}  // namespace

std::string_view name_of(DayKind kind) {
  switch (kind) {
    case DayKind::Normal:
      return "normal";
    case DayKind::PolarDay:
      return "polar_day";
    case DayKind::PolarNight:
      return "polar_night";
  }
  return "";
}

SunDay sun_day(const Location& site, Instant around, const SunOptions& options, Angle horizon) {
  SunDay day;
  day.noon = noon_near(site, around, options);
  day.noon_altitude = sun_at(site, day.noon, options).altitude;
  const DayCurve curve(site, day.noon, options, horizon);
  const auto place = [&](double seconds, std::optional<Instant>& t, std::optional<Angle>& azimuth) {
    t = later_by(day.noon, seconds);
    azimuth = sun_at(site, *t, options).azimuth;
  };
  if (!(curve.height(0.0) > 0.0)) {
    day.kind = DayKind::PolarNight;
    return day;
  }
  if (const auto rise = curve.nearest_crossing(-1.0)) place(*rise, day.rise, day.rise_azimuth);
  if (const auto set = curve.nearest_crossing(1.0)) place(*set, day.set, day.set_azimuth);
  if (!day.rise && !day.set) day.kind = DayKind::PolarDay;
  return day;
}

double true_solar_hours(const Sun& sun) {
  const double hours = 12.0 + sun.hour_angle.in_degrees() / 15.0;
  return hours >= 24.0 ? hours - 24.0 : hours;
}

std::string clock_text(double hours) {
  const long seconds = std::lround(hours * kHour_s) % 86400;
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

SunPath sun_path(const Location& site, int year, int standard_offset_minutes) {
  check_location(site);
  SunPath path;
  for (int month = 1; month <= 12; ++month) {
    path.day_arcs.push_back(day_arc(site, year, month, standard_offset_minutes));
  }
  for (int hour = 0; hour < 24; ++hour) {
    SunPathLine line = hour_line(site, year, hour, standard_offset_minutes);
    if (!line.points.empty()) path.hour_lines.push_back(std::move(line));
  }
  return path;
}

}  // namespace tenku
