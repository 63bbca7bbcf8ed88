/// Tables of places and times, and of the suns that belong to them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "site/sun_position.h"

namespace tenku {

/// One place and time.
struct SunRow {
  CivilTime time;
  std::string echo;  ///< the columns of the input, as the user wrote them
  Location site;
  SunOptions options;
};

/// Rows with the optional columns that they came with.
struct SunTable {
  bool has_air = false, has_delta_t = false, has_dut1 = false;
  std::vector<SunRow> rows;
};

/// Reads `time,latitude,longitude,elevation_m[,pressure_hpa,temperature_c][,delta_t_s][,dut1_s]`,
/// in any order of columns; times are UTC unless they carry an offset.
/// @param name  the file's name, for messages
/// @throws InputError naming file, line and value
SunTable parse_sun_table(std::string_view text, const std::string& name);

/// The same from a file; `-` is standard input.
SunTable read_sun_table(const std::filesystem::path& path);

/// The columns of the input and, for each row, azimuth_deg, altitude_deg, apparent_altitude_deg,
/// right_ascension_deg, declination_deg, distance_au, equation_of_time_min. Numbers read back as
/// the same doubles.
std::string sun_table_csv(const SunTable& table);

}  // namespace tenku
