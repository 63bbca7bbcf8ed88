/// Weather as Radiance's gendaymtx reads it: WEA. Private to this module.
#pragma once

#include <string>
#include <string_view>

#include "site/weather_file.h"

namespace tenku {

/// Whether a text begins as a WEA file does, with `place`.
bool is_wea(std::string_view text);

/// Six lines of header and `month day hour direct diffuse` a line, in W/m2. The hour is the middle
/// of what the record covers, so that 9.5 is hour 10 of an EPW file. Longitude and time zone count
/// west positive, the zone in degrees. Parts of a year are complete files.
///
/// Source   gendaymtx(1) and epw2wea(1), Radiance 5.
/// @throws InputError naming the line, if the header or a record is not whole, a date or number is
///         impossible, or the units are not those of irradiance (1)
WeatherFile parse_wea(std::string_view text, const std::string& name);

}  // namespace tenku
