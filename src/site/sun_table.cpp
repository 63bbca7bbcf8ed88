#include "site/sun_table.h"

#include <fmt/format.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/parallel.h"

namespace tenku {
namespace {

std::vector<std::string> input_columns(const SunTable& table) {
  std::vector<std::string> names{"time", "latitude", "longitude", "elevation_m"};
  if (table.has_air) names.insert(names.end(), {"pressure_hpa", "temperature_c"});
  if (table.has_delta_t) names.emplace_back("delta_t_s");
  if (table.has_dut1) names.emplace_back("dut1_s");
  return names;
}

SunRow read_row(const CsvInput& csv, const SunTable& table, std::size_t i) {
  SunRow row;
  row.time = parse_time(csv.text(i, "time"), "UTC");
  row.site = {Angle::degrees(csv.number(i, "latitude")), Angle::degrees(csv.number(i, "longitude")),
              csv.number(i, "elevation_m")};
  check_location(row.site);
  if (table.has_air) {
    row.options.air = Air{csv.number(i, "pressure_hpa"), csv.number(i, "temperature_c")};
  }
  if (table.has_delta_t) row.options.rotation.delta_t_s = csv.number(i, "delta_t_s");
  if (table.has_dut1) row.options.rotation.dut1_s = csv.number(i, "dut1_s");
  for (const std::string& column : input_columns(table)) {
    row.echo += (row.echo.empty() ? "" : ",") + csv.text(i, column);
  }
  return row;
}

std::string csv_row(const SunRow& row) {
  const Sun sun = sun_at(row.site, row.time.instant, row.options);
  return fmt::format("{},{},{},{},{},{},{},{}\n", row.echo, sun.azimuth.in_degrees(),
                     sun.altitude.in_degrees(), sun.apparent_altitude.in_degrees(),
                     sun.right_ascension.in_degrees(), sun.declination.in_degrees(),
                     sun.distance_au, sun.equation_of_time_min);
}

}  // namespace

SunTable parse_sun_table(std::string_view text, const std::string& name) {
  const CsvInput csv(text, name);
  for (const char* column : {"time", "latitude", "longitude", "elevation_m"}) csv.require(column);
  SunTable table;
  table.has_air = csv.has("pressure_hpa") || csv.has("temperature_c");
  if (table.has_air) {
    csv.require("pressure_hpa");
    csv.require("temperature_c");
  }
  table.has_delta_t = csv.has("delta_t_s");
  table.has_dut1 = csv.has("dut1_s");
  table.rows.reserve(csv.size());
  for (std::size_t i = 0; i < csv.size(); ++i) {
    try {
      table.rows.push_back(read_row(csv, table, i));
    } catch (const InputError& error) {
      const std::string message = error.what(), where = csv.where(i);
      throw InputError(message.starts_with(where) ? message : where + ": " + message);
    }
  }
  return table;
}

SunTable read_sun_table(const std::filesystem::path& path) {
  return parse_sun_table(read_whole_file(path), path == "-" ? "standard input" : path.string());
}

std::string sun_table_csv(const SunTable& table) {
  std::string text = fmt::format("{}", fmt::join(input_columns(table), ","));
  text +=
      ",azimuth_deg,altitude_deg,apparent_altitude_deg,right_ascension_deg,declination_deg,"
      "distance_au,equation_of_time_min\n";
  std::vector<std::string> lines(table.rows.size());
  parallel_for(lines.size(), 64, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) lines[i] = csv_row(table.rows[i]);
  });
  for (const std::string& line : lines) text += line;
  return text;
}

}  // namespace tenku
