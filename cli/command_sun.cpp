#include <fmt/format.h>

#include "cli/command.h"
#include "cli/option_list.h"
#include "cli/sky_options.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "site/sun_path.h"
#include "site/sun_table.h"

namespace tenku {
namespace {

struct SunCommandOptions {
  SiteOptions site;
  std::string times, out;
  std::string algorithm = "precise";
  bool day = false;
  std::optional<double> delta_t_s, dut1_s;
};

std::string json_number(const std::optional<CivilTime>& time) {
  return time ? fmt::format("\"{}\"", iso_local(*time)) : "null";
}

SunAlgorithm algorithm_named(const std::string& name) {
  if (name == "precise") return SunAlgorithm::Precise;
  if (name == "nrel") return SunAlgorithm::Nrel;
  throw InputError(fmt::format("--algorithm '{}' is unknown; there are precise and nrel", name));
}

SunRow single_row(const SunCommandOptions& o) {
  const std::optional<Location> site = resolve_location(o.site, std::nullopt);
  const std::optional<CivilTime> time = resolve_time(o.site);
  if (!site) throw InputError("where? Give --lat and --lon, or a table with --times");
  if (!time) throw InputError("when? Give --time, or a table with --times");
  SunRow row{*time, "", *site, resolve_sun_options(o.site)};
  row.echo = fmt::format("{},{},{},{}", iso_local(*time), *o.site.latitude_deg,
                         *o.site.longitude_deg, site->elevation_m);
  row.options.rotation = {o.delta_t_s, o.dut1_s};
  row.options.algorithm = algorithm_named(o.algorithm);
  return row;
}

void say_sun(const CommonOptions& options, const Sun& sun) {
  say(options, fmt::format("azimuth {:.4f}, altitude {:.4f} ({:.4f} with refraction) degrees; "
                           "right ascension {:.4f}, declination {:.4f} degrees; {:.7f} au",
                           sun.azimuth.in_degrees(), sun.altitude.in_degrees(),
                           sun.apparent_altitude.in_degrees(), sun.right_ascension.in_degrees(),
                           sun.declination.in_degrees(), sun.distance_au));
}

std::string clock_time(const std::optional<CivilTime>& time) {
  return time ? iso_local(*time) : std::string("none");
}

std::string day_summary(const SunDay& day, const std::optional<CivilTime>& rise,
                        const std::optional<CivilTime>& set, const CivilTime& noon) {
  if (day.kind == DayKind::PolarDay) {
    return fmt::format("polar day: the sun does not set; noon {}, altitude {:.2f} degrees",
                       iso_local(noon), day.noon_altitude.in_degrees());
  }
  if (day.kind == DayKind::PolarNight) {
    return fmt::format("polar night: the sun does not rise; noon {}, altitude {:.2f} degrees",
                       iso_local(noon), day.noon_altitude.in_degrees());
  }
  return fmt::format("rise {}, noon {} (altitude {:.2f} degrees), set {}", clock_time(rise),
                     iso_local(noon), day.noon_altitude.in_degrees(), clock_time(set));
}

/// The day of a row: its words for people, and its keys for machines.
std::string report_day(const CommonOptions& options, const SunRow& row) {
  const SunDay day = sun_day(row.site, local_noon(row.time).instant, row.options);
  const auto on_clock = [&](const std::optional<Instant>& t) -> std::optional<CivilTime> {
    if (!t) return std::nullopt;
    return on_clock_of(row.time, *t);
  };
  const std::optional<CivilTime> rise = on_clock(day.rise), set = on_clock(day.set);
  const CivilTime noon = on_clock_of(row.time, day.noon);
  say(options, day_summary(day, rise, set, noon));
  return fmt::format(
      ",\"day\":\"{}\",\"rise\":{},\"noon\":\"{}\",\"set\":{},\"noon_altitude_deg\":{}"
      ",\"rise_azimuth_deg\":{},\"set_azimuth_deg\":{}",
      name_of(day.kind), json_number(rise), iso_local(noon), json_number(set),
      day.noon_altitude.in_degrees(),
      day.rise_azimuth ? fmt::format("{}", day.rise_azimuth->in_degrees()) : "null",
      day.set_azimuth ? fmt::format("{}", day.set_azimuth->in_degrees()) : "null");
}

std::string json_of(const Sun& sun, const SunRow& row) {
  return fmt::format(
      "\"time\":\"{}\",\"azimuth_deg\":{},\"altitude_deg\":{},\"apparent_altitude_deg\":{},"
      "\"right_ascension_deg\":{},\"declination_deg\":{},\"distance_au\":{},"
      "\"equation_of_time_min\":{},\"true_solar_time\":\"{}\",\"angular_radius_deg\":{}",
      iso_local(row.time), sun.azimuth.in_degrees(), sun.altitude.in_degrees(),
      sun.apparent_altitude.in_degrees(), sun.right_ascension.in_degrees(),
      sun.declination.in_degrees(), sun.distance_au, sun.equation_of_time_min,
      clock_text(true_solar_hours(sun)), sun.angular_radius.in_degrees());
}

int run_table(const SunCommandOptions& o, const CommandContext& context) {
  if (o.out.empty()) throw InputError("--times needs --out OUT.csv (or - for standard output)");
  if (o.day) throw InputError("--day is for a single --time, not for --times");
  SunTable table = read_sun_table(o.times);
  for (SunRow& row : table.rows) row.options.algorithm = algorithm_named(o.algorithm);
  write_whole_file(o.out, sun_table_csv(table));
  say(context.options, fmt::format("{} sun positions", table.rows.size()));
  if (context.options.json) fmt::print("{{\"rows\":{}}}\n", table.rows.size());
  return kDone;
}

int run_single(const SunCommandOptions& o, const CommandContext& context) {
  SunTable table;
  table.rows.push_back(single_row(o));
  const SunRow& row = table.rows.front();
  const Sun sun = sun_at(row.site, row.time.instant, row.options);
  say_sun(context.options, sun);
  say(context.options, fmt::format("true solar time {}, equation of time {:+.3f} min",
                                   clock_text(true_solar_hours(sun)), sun.equation_of_time_min));
  std::string json = json_of(sun, row);
  if (o.day) json += report_day(context.options, row);
  if (!o.out.empty()) write_whole_file(o.out, sun_table_csv(table));
  if (context.options.json) fmt::print("{{{}}}\n", json);
  return kDone;
}

}  // namespace

CommandBody make_sun_command(OptionList& app) {
  auto options = std::make_shared<SunCommandOptions>();
  add_site_options(app, options->site);
  app.add_option("--times", options->times,
                 "CSV table: time,latitude,longitude,elevation_m[,pressure_hpa,temperature_c]"
                 "[,delta_t_s,dut1_s]");
  app.add_option("--out", options->out, "CSV table to write; - for standard output");
  app.add_flag("--day", options->day, "also rise, set and solar noon of the day");
  app.add_option("--algorithm", options->algorithm,
                 "precise (default), or nrel: the NREL solar position algorithm, to compare with");
  app.add_option("--delta-t", options->delta_t_s, "TT - UT1, seconds (default: built in)");
  app.add_option("--dut1", options->dut1_s, "UT1 - UTC, seconds (default: built in)");
  return [options](const CommandContext& context) {
    if (!options->out.empty()) check_can_write(options->out);
    return options->times.empty() ? run_single(*options, context) : run_table(*options, context);
  };
}

}  // namespace tenku
