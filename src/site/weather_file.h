/// Hourly weather of a place: EPW as EnergyPlus writes it, WEA as Radiance reads it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.h"
#include "site/civil_time.h"
#include "site/location.h"

namespace tenku {

/// One hour (or part of one) of a weather file. Values that the file marks as missing are absent.
struct WeatherHour {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;  ///< as in the file: hour 1 to 24
  std::optional<Irradiance> direct_normal, diffuse_horizontal;
  std::optional<double> dew_point_c, dry_bulb_c, pressure_hpa;
  std::size_t line = 0;  ///< of the file
};

/// A weather file, read whole.
///
/// Source   "Auxiliary Programs", EnergyPlus documentation, chapter on EPW: fields 1-16 and their
///          marks of missing values; gendaymtx(1) of Radiance for WEA.
struct WeatherFile {
  std::string name;  ///< of the file
  std::string city;
  Location location;
  int offset_minutes = 0;  ///< of local standard time, east positive
  int records_per_hour = 1;
  std::vector<WeatherHour> hours;

  /// The record that holds the local standard time of an instant, whatever the file's year: hour h
  /// covers h-1 to h. 29 February of a file without one is taken from 28 February.
  /// @throws InputError if the file has no such record
  const WeatherHour& at(Instant instant) const;
};

/// @param text  of an EPW file, or of a WEA file, which begins with `place`
/// @param name  of the file, for messages
/// @throws InputError naming the line, if the file is cut off, a date or number is impossible, or
///         hours are missing
WeatherFile parse_weather(std::string_view text, const std::string& name);
WeatherFile read_weather(const std::filesystem::path& path);

}  // namespace tenku
