#include "cli/sky_options.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/option_list.h"
#include "core/error.h"

namespace tenku {
namespace {

bool has_angles(const SiteOptions& options) {
  return options.sun_altitude_deg || options.sun_azimuth_deg;
}

SunInSky sun_by_angles(const SiteOptions& options) {
  if (!options.sun_altitude_deg || !options.sun_azimuth_deg) {
    throw InputError("--sun-altitude and --sun-azimuth are given together");
  }
  const double altitude = *options.sun_altitude_deg, azimuth = *options.sun_azimuth_deg;
  if (!(std::abs(altitude) <= 90.0)) {
    throw InputError(fmt::format("--sun-altitude {} degrees is not in -90..90", altitude));
  }
  if (!(std::abs(azimuth) <= 360.0)) {
    throw InputError(fmt::format("--sun-azimuth {} degrees is not in -360..360", azimuth));
  }
  SunInSky sun;
  sun.direction = direction_from(Angle::degrees(azimuth), Angle::degrees(altitude));
  return sun;
}

std::optional<Illuminance> lux(const std::optional<double>& value) {
  if (!value) return std::nullopt;
  return Illuminance(*value);
}

}  // namespace

void add_site_options(OptionList& app, SiteOptions& o) {
  app.add_option("--lat", o.latitude_deg, "latitude of the site, degrees, north positive");
  app.add_option("--lon", o.longitude_deg, "longitude of the site, degrees, east positive");
  app.add_option("--elevation", o.elevation_m, "height above the ellipsoid, metres (default 0)");
  app.add_option("--time", o.time, "2026-06-21T09:00+09:00, or without an offset and with --zone");
  app.add_option("--zone", o.zone, "IANA time zone, such as Asia/Tokyo");
  app.add_option("--sun-altitude", o.sun_altitude_deg,
                 "altitude of the sun, degrees, instead of site and time");
  app.add_option("--sun-azimuth", o.sun_azimuth_deg, "its azimuth, degrees clockwise from north");
  app.add_option("--pressure", o.pressure_hpa,
                 "air pressure at the site, hPa (default: standard atmosphere at the height)");
  app.add_option("--temperature", o.temperature_c,
                 "air temperature, degrees C (default: standard atmosphere at the height)");
  app.add_flag("--no-refraction", o.no_refraction, "leave refraction out");
}

void add_sky_options(OptionList& app, SkyOptions& o) {
  app.add_option("--sky", o.model,
                 "uniform, cie-overcast (default), cie:1 .. cie:15, perez:DNI,DHI (W/m2), "
                 "weather:FILE.epw or FILE.wea, image:FILE.hdr, none");
  app.add_option("--sky-illuminance", o.sky_illuminance_lx,
                 "horizontal diffuse illuminance of the open sky, lx");
  app.add_option("--sun-illuminance", o.sun_illuminance_lx,
                 "direct normal illuminance of the sun, lx; 0 for no sun");
  app.add_option("--sky-rotate", o.image_rotation_deg,
                 "turn of an image sky, degrees clockwise seen from above");
}

std::optional<Location> resolve_location(const SiteOptions& options,
                                         const std::optional<Location>& scene_site) {
  if (!scene_site && !options.latitude_deg && !options.longitude_deg) return std::nullopt;
  if (!scene_site && !(options.latitude_deg && options.longitude_deg)) {
    throw InputError("--lat and --lon are given together");
  }
  Location location = scene_site.value_or(Location{});
  if (options.latitude_deg) location.latitude = Angle::degrees(*options.latitude_deg);
  if (options.longitude_deg) location.longitude = Angle::degrees(*options.longitude_deg);
  if (options.elevation_m) location.elevation_m = *options.elevation_m;
  check_location(location);
  return location;
}

std::optional<CivilTime> resolve_time(const SiteOptions& options) {
  if (options.time.empty()) return std::nullopt;
  return parse_time(options.time, options.zone);
}

SunOptions resolve_sun_options(const SiteOptions& options) {
  SunOptions result;
  result.refraction = !options.no_refraction;
  if (options.pressure_hpa || options.temperature_c) {
    Air air = standard_air(options.elevation_m.value_or(0.0));
    air.pressure_hpa = options.pressure_hpa.value_or(air.pressure_hpa);
    air.temperature_c = options.temperature_c.value_or(air.temperature_c);
    result.air = air;
  }
  return result;
}

std::optional<SunInSky> resolve_sun(const SiteOptions& options,
                                    const std::optional<Location>& scene_site) {
  if (has_angles(options)) return sun_by_angles(options);
  const std::optional<CivilTime> time = resolve_time(options);
  if (!time) return std::nullopt;
  const std::optional<Location> site = resolve_location(options, scene_site);
  if (!site) throw InputError("--time needs the site: give --lat and --lon");
  const Sun sun = sun_at(*site, time->instant, resolve_sun_options(options));
  return SunInSky{sun.apparent_direction, sun.angular_radius, sun.distance_au};
}

Sky resolve_sky(const SiteOptions& site, const SkyOptions& sky,
                const std::optional<Location>& scene_site) {
  if (!std::isfinite(sky.image_rotation_deg)) throw InputError("--sky-rotate is no number");
  SkyRequest request;
  request.model = sky.model;
  request.sky_illuminance = lux(sky.sky_illuminance_lx);
  request.sun_illuminance = lux(sky.sun_illuminance_lx);
  request.sun = resolve_sun(site, scene_site);
  request.time = resolve_time(site);
  if (request.time) request.day_of_year = day_of_year(request.time->instant);
  request.image_rotation = Angle::degrees(sky.image_rotation_deg);
  return make_sky(request);
}

}  // namespace tenku
