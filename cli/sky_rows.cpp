#include "cli/sky_rows.h"

#include <algorithm>
#include <array>

#include "core/csv.h"
#include "core/error.h"
#include "core/suggest.h"

namespace tenku {
namespace {

constexpr std::array<std::string_view, 7> kColumns{
    "time", "sun_altitude_deg",   "sun_azimuth_deg",
    "sky",  "sky_illuminance_lx", "sun_illuminance_lx",
    "lamps"};

/// Header line of a table, cell by cell.
std::vector<std::string> header_of(std::string_view text) {
  std::vector<std::string> names{""};
  for (const char c : text.substr(0, text.find('\n'))) {
    if (c == ',') {
      names.emplace_back();
    } else if (c != ' ' && c != '\r' && c != '"') {
      names.back() += c;
    }
  }
  return names;
}

void check_header(std::string_view text, const std::string& path) {
  for (const std::string& name : header_of(text)) {
    if (std::find(kColumns.begin(), kColumns.end(), name) == kColumns.end()) {
      throw InputError(path + ": a table of skies has no column '" + name + "'" +
                       suggestion(name, kColumns));
    }
  }
}

}  // namespace

std::vector<SkyRow> read_sky_rows(const std::string& path, const SiteOptions& site,
                                  const SkyOptions& sky) {
  const std::string text = read_whole_file(path);
  check_header(text, path);
  const CsvInput csv(text, path);
  if (csv.size() == 0) throw InputError(path + " holds no skies");
  std::vector<SkyRow> rows;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    SkyRow row{site, sky};
    const auto has = [&](std::string_view name) {
      return csv.has(name) && !csv.text(i, name).empty();
    };
    const auto number = [&](std::string_view name, std::optional<double>& value) {
      if (has(name)) value = csv.number(i, name);
    };
    if (has("time")) {
      row.site.time = csv.text(i, "time");
      row.site.sun_altitude_deg = row.site.sun_azimuth_deg = std::nullopt;
    }
    number("sun_altitude_deg", row.site.sun_altitude_deg);
    number("sun_azimuth_deg", row.site.sun_azimuth_deg);
    if (has("sky")) row.sky.model = csv.text(i, "sky");
    number("sky_illuminance_lx", row.sky.sky_illuminance_lx);
    number("sun_illuminance_lx", row.sky.sun_illuminance_lx);
    if (has("lamps")) row.lamp_scale = csv.number(i, "lamps");
    if (!(row.lamp_scale >= 0.0)) {
      throw InputError(csv.where(i) + ": lamps is a factor of 0 or more");
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace tenku
