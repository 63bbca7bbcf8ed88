/// The options of site, time, sun and sky, shared by the subcommands that need light.
#pragma once

#include <optional>
#include <string>

#include "site/civil_time.h"
#include "site/location.h"
#include "site/sun_position.h"
#include "sky_models/make_sky.h"

namespace tenku {

class OptionList;

/// `--lat --lon --elevation --time --zone --sun-altitude --sun-azimuth`
/// `--pressure --temperature --no-refraction`.
struct SiteOptions {
  std::optional<double> latitude_deg, longitude_deg, elevation_m;
  std::string time, zone;
  std::optional<double> sun_altitude_deg, sun_azimuth_deg;
  std::optional<double> pressure_hpa, temperature_c;
  bool no_refraction = false;
};

/// `--sky --sky-illuminance --sun-illuminance --sky-rotate`.
struct SkyOptions {
  std::string model = "cie-overcast";
  std::optional<double> sky_illuminance_lx, sun_illuminance_lx;
  double image_rotation_deg = 0.0;
};

void add_site_options(OptionList& app, SiteOptions& options);
void add_sky_options(OptionList& app, SkyOptions& options);

/// Site by the options, or else the scene's; each of `--lat --lon --elevation` replaces its part.
/// None if neither says.
/// @throws InputError if only one of latitude and longitude is known, or one is out of range
std::optional<Location> resolve_location(const SiteOptions& options,
                                         const std::optional<Location>& scene_site);

/// Time by the options; none if there is no `--time`.
/// @throws InputError as `parse_time`
std::optional<CivilTime> resolve_time(const SiteOptions& options);

/// Air, refraction and rotation for `sun_at`.
SunOptions resolve_sun_options(const SiteOptions& options);

/// The sun by its angles, or by site and time; none if neither is given.
/// @throws InputError if one of the angles is missing or out of range, or a time is given without
///         a site
std::optional<SunInSky> resolve_sun(const SiteOptions& options,
                                    const std::optional<Location>& scene_site);

/// The sky and the sun that the options ask for.
/// @throws InputError
Sky resolve_sky(const SiteOptions& site, const SkyOptions& sky,
                const std::optional<Location>& scene_site = std::nullopt);

}  // namespace tenku
