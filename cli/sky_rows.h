/// Tables of skies and hours: `--skies`. Private to this module.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/sky_options.h"

namespace tenku {

/// One light: a sky, a sun, and how bright the lamps are.
struct SkyRow {
  SiteOptions site;
  SkyOptions sky;
  double lamp_scale = 1.0;
};

/// Rows of a table with the columns `time`, `sun_altitude_deg` and `sun_azimuth_deg`, `sky`,
/// `sky_illuminance_lx`, `sun_illuminance_lx`, `lamps` (a factor on all emission), each of them
/// optional: what a row lacks or leaves empty is as the options say.
/// @throws InputError  a column that is not known, a cell that is no number, no rows
std::vector<SkyRow> read_sky_rows(const std::string& path, const SiteOptions& site,
                                  const SkyOptions& sky);

}  // namespace tenku
