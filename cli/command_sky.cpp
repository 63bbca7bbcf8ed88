#include <fmt/format.h>

#include <filesystem>
#include <iterator>

#include "cli/command.h"
#include "cli/finding_json.h"
#include "cli/option_list.h"
#include "cli/partition_options.h"
#include "cli/sky_options.h"
#include "core/atomic_file.h"
#include "core/csv.h"
#include "core/error.h"
#include "study/sky_output.h"

namespace tenku {
namespace {

struct SkyCommandOptions {
  SiteOptions site;
  SkyOptions sky;
  PartitionOptions partition;
  std::string directions, out;
};

struct DirectionRow {
  std::string azimuth, altitude;  // as written
  Vec3 direction;
};

DirectionRow read_direction(const CsvInput& csv, std::size_t i) {
  const double azimuth = csv.number(i, "azimuth_deg"), altitude = csv.number(i, "altitude_deg");
  if (!(altitude >= -90.0 && altitude <= 90.0)) {
    throw InputError(
        fmt::format("{}: altitude {} degrees is not in -90..90", csv.where(i), altitude));
  }
  return {csv.text(i, "azimuth_deg"), csv.text(i, "altitude_deg"),
          direction_from(Angle::degrees(azimuth), Angle::degrees(altitude))};
}

std::vector<DirectionRow> read_directions(const std::string& path) {
  const CsvInput csv(read_whole_file(path), path == "-" ? "standard input" : path);
  csv.require("azimuth_deg");
  csv.require("altitude_deg");
  std::vector<DirectionRow> rows;
  for (std::size_t i = 0; i < csv.size(); ++i) rows.push_back(read_direction(csv, i));
  return rows;
}

std::string luminance_csv(const Sky& sky, const std::vector<DirectionRow>& rows) {
  std::string text = "azimuth_deg,altitude_deg,luminance_cd_m2\n";
  for (const DirectionRow& row : rows) {
    fmt::format_to(std::back_inserter(text), "{},{},{}\n", row.azimuth, row.altitude,
                   sky.luminance(row.direction).value());
  }
  return text;
}

std::string element_csv(const SkyPartition& partition) {
  std::string text =
      "azimuth_deg,altitude_deg,luminance_cd_m2,solid_angle_sr,azimuth_from_deg,azimuth_to_deg,"
      "altitude_from_deg,altitude_to_deg\n";
  const auto degrees = [](double radians) { return Angle::radians(radians).in_degrees(); };
  for (const SkyElement& e : partition.elements) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n",
                   azimuth_of(e.direction).in_degrees(), altitude_of(e.direction).in_degrees(),
                   e.luminance.value(), e.solid_angle, degrees(e.cell.azimuth_from),
                   degrees(e.cell.azimuth_to), degrees(std::asin(e.cell.sine_from)),
                   degrees(std::asin(std::min(1.0, e.cell.sine_to))));
  }
  return text;
}

nlohmann::ordered_json json_of(const Sky& sky, const SkyPartition& partition) {
  nlohmann::ordered_json summary{{"zenith_luminance_cd_m2", sky.luminance(kZenith).value()},
                                 {"horizontal_diffuse_lux", sky.horizontal_diffuse_lux},
                                 {"elements", partition.elements.size()},
                                 {"diagnostics", json_of(sky.diagnostics)},
                                 {"sun_normal_lux", sky.sun.normal_illuminance.value()},
                                 {"sun_azimuth_deg", azimuth_of(sky.sun.direction).in_degrees()},
                                 {"sun_altitude_deg", altitude_of(sky.sun.direction).in_degrees()},
                                 {"standard_error", partition.standard_error},
                                 {"description", sky.description}};
  return summary;
}

bool is_table(const std::filesystem::path& out) { return out == "-" || out.extension() == ".csv"; }

void write_output(const SkyCommandOptions& o, const Sky& sky, const SkyPartition& partition) {
  if (!o.directions.empty()) {
    return write_whole_file(o.out, luminance_csv(sky, read_directions(o.directions)));
  }
  if (is_table(o.out)) return write_whole_file(o.out, element_csv(partition));
  write_sky(o.out, sky, partition);
}

void check_output(const SkyCommandOptions& o, const CommonOptions& options) {
  if (o.out.empty() && !options.json) {
    throw InputError("nothing to do: give --out OUT, or --json");
  }
  if (o.out.empty() && !o.directions.empty()) throw InputError("--directions needs --out OUT.csv");
  if (o.out.empty()) return;
  if (!is_table(o.out) && (!o.directions.empty() || !is_sky_output(o.out))) {
    throw InputError(fmt::format("--out '{}': the ending is not {}", o.out,
                                 o.directions.empty() ? ".csv, .vtp, .hdr, .exr or .png" : ".csv"));
  }
  check_can_write(o.out);
}

int run_sky(const SkyCommandOptions& o, const CommandContext& context) {
  check_output(o, context.options);
  const Sky sky = resolve_sky(o.site, o.sky);
  const PartitionRequest request = resolve_partition(o.partition);
  const SkyPartition partition = sky.model ? partition_sky(*sky.model, request) : SkyPartition{};
  if (!o.out.empty()) write_output(o, sky, partition);
  say(context.options,
      fmt::format("{}; zenith {:.0f} cd/m2; {}", sky.description, sky.luminance(kZenith).value(),
                  sky.model ? partition.description : "no elements"));
  for (const Finding& f : sky.diagnostics) {
    say(context.options, fmt::format("{}: {}; {}", name_of(f.severity), f.what, f.repair));
  }
  if (context.options.json) fmt::print("{}\n", json_of(sky, partition).dump(2));
  return kDone;
}

}  // namespace

CommandBody make_sky_command(OptionList& app) {
  auto options = std::make_shared<SkyCommandOptions>();
  add_site_options(app, options->site);
  add_sky_options(app, options->sky);
  add_partition_options(app, options->partition, "adaptive");
  app.add_option("--directions", options->directions,
                 "CSV table of azimuth_deg,altitude_deg to give the luminance of");
  app.add_option(
      "--out", options->out,
      "CSV of luminances; without --directions the sky's elements (.csv, .vtp), a panorama "
      "(.hdr, .exr) or a plan of the dome (.png); - for CSV on standard output");
  return [options](const CommandContext& context) { return run_sky(*options, context); };
}

}  // namespace tenku
