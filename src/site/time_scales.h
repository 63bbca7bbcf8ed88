/// From the clock to the turning of the Earth and to the uniform time of the planets.
#pragma once

#include <optional>

#include "site/civil_time.h"

namespace tenku {

/// What the user knows of the Earth's rotation; the built-in values where absent.
struct EarthRotation {
  std::optional<double> delta_t_s;  ///< TT - UT1, seconds
  std::optional<double> dut1_s;     ///< UT1 - UTC, seconds
};

/// A two-part Julian date of some time scale.
struct JulianDate {
  double day = 0.0, fraction = 0.0;
};

/// An instant in the two scales that the position of the sun needs.
struct TimeScales {
  JulianDate tt;   ///< terrestrial time: the ephemeris
  JulianDate ut1;  ///< the Earth's rotation
};

/// @throws InputError if an override is not finite, |dut1_s| is over 10 or |delta_t_s| over 20000
TimeScales time_scales(Instant instant, const EarthRotation& rotation = {});

/// TT - UT1 in seconds at a Julian date.
///
/// Source   1 January, interpolated: 1950-1972 the historic table of the United States Naval
///          Observatory; 1973-2026 UT1 - UTC of the IERS (`finals2000A`, from 2021 as the
///          observatory's `deltat.data` has it) and the leap seconds. Before: the polynomials of
///          F. Espenak and J. Meeus, "Five Millennium Canon of Solar Eclipses",
///          NASA/TP-2006-214141, section 2.7; after: the last leap second known to ERFA is kept,
///          and UT1 taken as UTC.
/// Valid    years 1600 to 2400.
/// Error    0.005 s on 1 January; between, the seasons of the Earth's rotation add up to 0.09 s
///          (against the daily values of 1973-2020). In years ahead UT1 is within 0.9 s of UTC as
///          long as leap seconds are kept. A second is 0.004 degrees of the sun's hour angle.
double delta_t_seconds(double julian_date);

}  // namespace tenku
