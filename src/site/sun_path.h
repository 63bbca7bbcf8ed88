/// The sun through a day and through a year.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "site/sun_position.h"

namespace tenku {

enum class DayKind { Normal, PolarDay, PolarNight };

/// `normal`, `polar_day`, `polar_night`.
std::string_view name_of(DayKind kind);

/// Altitude of the sun's centre at which its upper edge touches a sea-level horizon: 34' of
/// refraction and 16' of radius, by convention. Reda and Andreas 2008, appendix A.2.
inline constexpr Angle kRiseAltitude = Angle::degrees(-0.8333);

/// Rise, noon and set of one solar day.
struct SunDay {
  DayKind kind = DayKind::Normal;
  Instant noon;                      ///< the sun crosses the meridian: true solar time 12 h
  Angle noon_altitude;               ///< without refraction
  std::optional<Instant> rise, set;  ///< in the 12 hours before and after noon
  std::optional<Angle> rise_azimuth, set_azimuth;
};

/// The solar day whose noon is nearest to `around`.
///
/// Rise and set are where the unrefracted topocentric altitude passes `horizon`.
/// Error    0.01 s of time against the altitude itself; the convention's refraction is good to
///          some seconds at middle latitudes and to minutes in the polar regions.
/// Cost     some 60 positions.
SunDay sun_day(const Location& site, Instant around, const SunOptions& options = {},
               Angle horizon = kRiseAltitude);

/// True (apparent) solar time in hours, 0 to 24.
double true_solar_hours(const Sun& sun);

/// `11:42:07` from hours.
std::string clock_text(double hours);

/// One point of a sun-path diagram.
struct SunPathPoint {
  Instant instant;
  Angle azimuth, altitude;  ///< altitude with refraction
};

/// A line of a sun-path diagram; parts below the horizon are left out.
struct SunPathLine {
  int number = 0;  ///< month 1 to 12 of a day's arc, or hour 0 to 23 of an hour's line
  std::vector<SunPathPoint> points;
};

/// Data of a sun-path diagram, to be drawn.
struct SunPath {
  std::vector<SunPathLine> day_arcs;    ///< the 21st of each month, from rise to set
  std::vector<SunPathLine> hour_lines;  ///< mean time of the clock's standard offset, over the year
};

/// @param standard_offset_minutes  of the clock whose hours are drawn
SunPath sun_path(const Location& site, int year, int standard_offset_minutes);

}  // namespace tenku
