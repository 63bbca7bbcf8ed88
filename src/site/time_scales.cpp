#include "site/time_scales.h"

#include <erfa.h>

#include <array>
#include <cmath>
#include <span>
#include <string>

#include "core/error.h"

namespace tenku {
namespace {

constexpr double kDay_s = 86400.0;
constexpr double kTtMinusTai_s = 32.184;
constexpr double kUtcBegins = 2436934.5;  // 1960-01-01, JD
constexpr double kTableBegins = 1950.0;

// TT - UT1 on 1 January, from 1950. Sources in the header.
constexpr std::array kTable_s{
    29.15, 29.57, 29.97, 30.36, 30.72, 31.07, 31.35, 31.68, 32.17, 32.67,  // 1950
    33.15, 33.58, 33.99, 34.47, 35.03, 35.74, 36.55, 37.43, 38.29, 39.20,  // 1960
    40.18, 41.17, 42.23, 43.38, 44.48, 45.48, 46.46, 47.52, 48.53, 49.59,  // 1970
    50.54, 51.38, 52.17, 52.96, 53.79, 54.34, 54.87, 55.32, 55.82, 56.30,  // 1980
    56.86, 57.57, 58.31, 59.12, 59.98, 60.79, 61.63, 62.30, 62.97, 63.47,  // 1990
    63.83, 64.09, 64.30, 64.47, 64.57, 64.69, 64.85, 65.15, 65.46, 65.78,  // 2000
    66.07, 66.32, 66.60, 66.91, 67.28, 67.64, 68.10, 68.59, 68.97, 69.22,  // 2010
    69.36, 69.36, 69.29, 69.20, 69.18, 69.14, 69.11};                      // 2020
constexpr double kTableEnds = kTableBegins + kTable_s.size() - 1;

double polynomial(std::span<const double> coefficients, double t) {
  double value = 0.0;
  for (std::size_t i = coefficients.size(); i-- > 0;) value = value * t + coefficients[i];
  return value;
}

// Espenak and Meeus, 1600 to 1961, in their segments.
double historical_delta_t(double y) {
  using Terms = std::array<double, 8>;
  if (y < 1700.0) return polynomial(Terms{120.0, -0.9808, -0.01532, 1.0 / 7129.0}, y - 1600.0);
  if (y < 1800.0) {
    return polynomial(Terms{8.83, 0.1603, -0.0059285, 0.00013336, -1.0 / 1174000.0}, y - 1700.0);
  }
  if (y < 1860.0) {
    return polynomial(Terms{13.72, -0.332447, 0.0068612, 0.0041116, -0.00037436, 0.0000121272,
                            -0.0000001699, 0.000000000875},
                      y - 1800.0);
  }
  if (y < 1900.0) {
    return polynomial(Terms{7.62, 0.5737, -0.251754, 0.01680668, -0.0004473624, 1.0 / 233174.0},
                      y - 1860.0);
  }
  if (y < 1920.0) {
    return polynomial(Terms{-2.79, 1.494119, -0.0598939, 0.0061966, -0.000197}, y - 1900.0);
  }
  if (y < 1941.0) return polynomial(Terms{21.20, 0.84493, -0.076100, 0.0020936}, y - 1920.0);
  return polynomial(Terms{29.07, 0.407, -1.0 / 233.0, 1.0 / 2547.0}, y - 1950.0);
}

double decimal_year(double julian_date) { return 2000.0 + (julian_date - 2451544.5) / 365.25; }

double tabulated_delta_t(double year) {
  const double position = year - kTableBegins;
  const auto i = std::min(static_cast<std::size_t>(position), kTable_s.size() - 2);
  const double t = position - static_cast<double>(i);
  return (1.0 - t) * kTable_s[i] + t * kTable_s[i + 1];
}

/// TAI - UTC at an instant, seconds, as far as ERFA knows.
double leap_seconds(Instant instant) {
  int year = 0, month = 0, day = 0;
  double fraction = 0.0, seconds = 0.0;
  eraJd2cal(instant.day, 0.0, &year, &month, &day, &fraction);
  const int status = eraDat(year, month, day, std::min(instant.fraction, 1.0), &seconds);
  expects(status >= 0, "leap seconds are known for a date after 1960");
  return seconds;
}

JulianDate plus_seconds(JulianDate date, double seconds) {
  return {date.day, date.fraction + seconds / kDay_s};
}

double checked(std::optional<double> value, double limit, const char* name) {
  if (!(std::abs(*value) <= limit)) {
    throw InputError(std::string(name) + " " + std::to_string(*value) + " s is not within " +
                     std::to_string(static_cast<int>(limit)) + " s of zero");
  }
  return *value;
}

/// UT1 - UTC by the built-in values, given TT - UTC.
double built_in_dut1(double julian_date, double tt_minus_utc) {
  if (decimal_year(julian_date) > kTableEnds) return 0.0;
  return tt_minus_utc - delta_t_seconds(julian_date);
}

}  // namespace

double delta_t_seconds(double julian_date) {
  const double year = decimal_year(julian_date);
  if (year > kTableEnds) return leap_seconds({julian_date, 0.0}) + kTtMinusTai_s;
  return year < kTableBegins ? historical_delta_t(year) : tabulated_delta_t(year);
}

TimeScales time_scales(Instant instant, const EarthRotation& rotation) {
  const double date = instant.day + instant.fraction;
  const bool is_utc = instant.day >= kUtcBegins;
  TimeScales scales;
  double delta_t = delta_t_seconds(date), dut1 = 0.0;
  const JulianDate clock{instant.day, instant.fraction};
  if (rotation.delta_t_s) delta_t = checked(rotation.delta_t_s, 20000.0, "delta_t_s");
  if (rotation.dut1_s) dut1 = checked(rotation.dut1_s, 10.0, "dut1_s");
  if (!is_utc) {
    scales.ut1 = plus_seconds(clock, dut1);
    scales.tt = plus_seconds(scales.ut1, delta_t);
    return scales;
  }
  // By way of TAI, for a day with a leap second is longer than its fraction tells.
  JulianDate tai;
  eraUtctai(instant.day, instant.fraction, &tai.day, &tai.fraction);
  const double tai_minus_utc = leap_seconds(instant);
  scales.tt = plus_seconds(tai, kTtMinusTai_s);
  if (!rotation.dut1_s) dut1 = built_in_dut1(date, tai_minus_utc + kTtMinusTai_s);
  scales.ut1 = plus_seconds(tai, dut1 - tai_minus_utc);
  if (rotation.delta_t_s) scales.tt = plus_seconds(scales.ut1, delta_t);
  return scales;
}

}  // namespace tenku
