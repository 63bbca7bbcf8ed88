#include "sky_models/make_sky.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "core/error.h"
#include "site/weather_file.h"
#include "sky_models/cie_general_sky.h"
#include "sky_models/cie_overcast_sky.h"
#include "sky_models/hemisphere_integral.h"
#include "sky_models/image_sky.h"
#include "sky_models/perez_sky.h"
#include "sky_models/sky_level.h"
#include "sky_models/sky_name.h"
#include "sky_models/uniform_sky.h"

namespace tenku {
namespace {

void check(const SkyRequest& request) {
  const auto check_level = [](const std::optional<Illuminance>& e, const char* name) {
    if (e && !(e->value() >= 0.0 && e->value() <= 1e9)) {
      throw InputError(fmt::format("{} {} lx is not in 0..1e9", name, e->value()));
    }
  };
  check_level(request.sky_illuminance, "sky illuminance");
  check_level(request.sun_illuminance, "sun illuminance");
  if (request.sun && !(is_finite(request.sun->direction) && is_unit(request.sun->direction))) {
    throw InputError("the direction of the sun is not a unit vector");
  }
}

bool sun_is_up(const SkyRequest& request) { return request.sun && request.sun->direction.z > 0.0; }

/// Whether a part of the disc stands above the horizon.
bool sun_shows(const SkyRequest& request) {
  return request.sun &&
         request.sun->direction.z > -std::sin(request.sun->angular_radius.in_radians());
}

Angle sun_altitude(const SkyRequest& request) { return altitude_of(request.sun->direction); }

void require_sun(const SkyRequest& request, std::string_view why) {
  if (request.sun) return;
  throw InputError(fmt::format(
      "sky '{}' needs the sun {}: give the site and --time, or --sun-altitude and --sun-azimuth",
      request.model, why));
}

void darken(Sky& sky, const SkyRequest& request) {
  sky.model.reset();
  sky.horizontal_diffuse_lux = 0.0;
  sky.sun.normal_illuminance = Illuminance(0.0);
  sky.diagnostics.push_back(
      {"night", Severity::Warning, "", "",
       fmt::format("the sun is at or below the horizon ({:.2f} degrees)",
                   sun_altitude(request).in_degrees()),
       "the sky is dark; give a level with --sky-illuminance and a sky that needs no sun "
       "(uniform, cie-overcast), or another time"});
}

/// Illuminance asked for, or that of an average overcast sky; none at night.
std::optional<Illuminance> overcast_level(const SkyRequest& request) {
  if (request.sky_illuminance) return request.sky_illuminance;
  require_sun(request, "for its level where --sky-illuminance is not given");
  if (!sun_is_up(request)) return std::nullopt;
  return overcast_illuminance(sun_altitude(request));
}

void make_uniform(Sky& sky, const SkyRequest& request) {
  const std::optional<Illuminance> level = overcast_level(request);
  if (!level) return darken(sky, request);
  sky.model = std::make_unique<UniformSky>(Luminance(level->value() / kPi));
  sky.horizontal_diffuse_lux = level->value();
}

void make_overcast(Sky& sky, const SkyRequest& request) {
  const std::optional<Illuminance> level = overcast_level(request);
  if (!level) return darken(sky, request);
  sky.model = std::make_unique<CieOvercastSky>(Luminance(level->value() * 9.0 / (7.0 * kPi)));
  sky.horizontal_diffuse_lux = level->value();
}

void make_cie(Sky& sky, const SkyRequest& request, int type) {
  const bool needs_sun = type != 1 && type != 3 && type != 5;
  if (needs_sun || !request.sky_illuminance) require_sun(request, "for its luminance or level");
  const bool up = sun_is_up(request);
  if (!up && (needs_sun || !request.sky_illuminance)) return darken(sky, request);
  const Vec3 sun = up ? request.sun->direction : kZenith;
  const CieSkyLevel level = cie_sky_level(type, altitude_of(sun));
  const Illuminance target = request.sky_illuminance.value_or(level.horizontal_diffuse);
  if (up) sky.sun.normal_illuminance = level.sun_normal;
  if (!(target > Illuminance(0.0))) return;
  const CieGeneralSky unit(type, sun, Luminance(1.0));
  const double zenith = target / horizontal_illuminance(unit, sun);
  sky.model = std::make_unique<CieGeneralSky>(type, sun, Luminance(zenith));
  sky.horizontal_diffuse_lux = target.value();
}

Irradiance extraterrestrial(Sky& sky, const SkyRequest& request) {
  if (request.sun->distance_au) return extraterrestrial_irradiance_at(*request.sun->distance_au);
  if (request.day_of_year) return extraterrestrial_irradiance(*request.day_of_year);
  sky.diagnostics.push_back({"no_date", Severity::Note, "", "",
                             "the sun's distance is unknown without a date",
                             "one astronomical unit was taken: sky brightness within 3.5 %"});
  return extraterrestrial_irradiance_at(1.0);
}

void make_perez(Sky& sky, const SkyRequest& request, Irradiance direct, Irradiance diffuse) {
  require_sun(request, "for its luminance");
  if (!sun_is_up(request)) return darken(sky, request);
  PerezConditions conditions;
  conditions.direct_normal = direct;
  conditions.diffuse_horizontal = diffuse;
  conditions.extraterrestrial = extraterrestrial(sky, request);
  conditions.dew_point_c = request.dew_point_c.value_or(conditions.dew_point_c);
  conditions.sun = request.sun->direction;
  const PerezParameters parameters = perez_parameters(conditions);
  for (const Finding& finding : parameters.findings) sky.diagnostics.push_back(finding);
  const Illuminance target =
      request.sky_illuminance.value_or(Illuminance(parameters.diffuse_efficacy * diffuse.value()));
  sky.sun.normal_illuminance = Illuminance(parameters.beam_efficacy * direct.value());
  if (!(target > Illuminance(0.0))) return;
  sky.model = std::make_unique<PerezSky>(parameters, conditions.sun, target);
  sky.horizontal_diffuse_lux = target.value();
}

Irradiance known(const std::optional<Irradiance>& value, const char* what,
                 const std::string& where) {
  if (value) return *value;
  throw InputError(fmt::format("{}: the {} irradiance of this hour is missing", where, what));
}

void make_weather(Sky& sky, const SkyRequest& request, const std::string& path) {
  if (!request.time) throw InputError("sky '" + request.model + "' needs the hour: give --time");
  const WeatherFile weather = read_weather(path);
  const WeatherHour& hour = weather.at(request.time->instant);
  const std::string where = fmt::format("{}, line {}", path, hour.line);
  SkyRequest measured = request;
  if (!measured.dew_point_c) measured.dew_point_c = hour.dew_point_c;
  make_perez(sky, measured, known(hour.direct_normal, "direct normal", where),
             known(hour.diffuse_horizontal, "diffuse horizontal", where));
}

void make_image(Sky& sky, const SkyRequest& request, const std::string& path) {
  SkyImage image = read_sky_image(path);
  sky.diagnostics = image.findings;
  auto model = std::make_unique<ImageSky>(std::move(image), request.image_rotation,
                                          Luminance(kRadianceEfficacy_lm_W));
  const double own = model->horizontal_illuminance().value();
  if (!(own > 0.0)) throw InputError("sky image '" + path + "' is black above the horizon");
  if (request.sky_illuminance) {
    model->scale(request.sky_illuminance->value() / own);
  } else {
    sky.diagnostics.push_back({"image_level", Severity::Note, "", path,
                               "no --sky-illuminance is given",
                               "pixels were taken as W/m2 sr, with 179 lm/W"});
  }
  sky.horizontal_diffuse_lux = model->horizontal_illuminance().value();
  if (sky.horizontal_diffuse_lux > 0.0) sky.model = std::move(model);
}

void set_sun(Sky& sky, const SkyRequest& request) {
  if (request.sun) {
    sky.sun.direction = request.sun->direction;
    sky.sun.angular_radius = request.sun->angular_radius;
  }
  if (!request.sun_illuminance) return;
  if (request.sun_illuminance->value() > 0.0) require_sun(request, "that is to shine");
  if (!request.sun || sun_shows(request)) sky.sun.normal_illuminance = *request.sun_illuminance;
}

void tell_grazing_sun(Sky& sky) {
  constexpr Angle kGrazing = Angle::degrees(2.0), kLeast = Angle::degrees(0.05);
  const Angle altitude = altitude_of(sky.sun.direction);
  if (!(sky.sun.normal_illuminance > Illuminance(0.0)) || !(altitude < kGrazing)) return;
  sky.diagnostics.push_back(
      {"grazing_sun", Severity::Warning, "",
       fmt::format("sun at azimuth {:.2f}, altitude {:.2f} degrees",
                   azimuth_of(sky.sun.direction).in_degrees(), altitude.in_degrees()),
       fmt::format("the sun is so low that shadows are {:.0f} times as long as what throws them is "
                   "high: a centimetre of height moves their ends by that many centimetres, and "
                   "what stands outside of the scene would shade it",
                   1.0 / std::tan(std::max(altitude, kLeast).in_radians())),
       "give a scene that reaches as far toward the sun, or a time with a higher sun"});
}

}  // namespace

Sky make_sky(const SkyRequest& request) {
  check(request);
  const SkyName name = parse_sky_name(request.model);
  Sky sky;
  sky.description = request.model;
  switch (name.kind) {
    case SkyKind::None:
      break;
    case SkyKind::Uniform:
      make_uniform(sky, request);
      break;
    case SkyKind::CieOvercast:
      make_overcast(sky, request);
      break;
    case SkyKind::CieGeneral:
      make_cie(sky, request, name.cie_type);
      break;
    case SkyKind::Perez:
      make_perez(sky, request, name.direct_normal, name.diffuse_horizontal);
      break;
    case SkyKind::Weather:
      make_weather(sky, request, name.file);
      break;
    case SkyKind::Image:
      make_image(sky, request, name.file);
      break;
  }
  set_sun(sky, request);
  tell_grazing_sun(sky);
  sky.description =
      fmt::format("{}, {:.0f} lx diffuse horizontal, sun {:.0f} lx normal", request.model,
                  sky.horizontal_diffuse_lux, sky.sun.normal_illuminance.value());
  return sky;
}

}  // namespace tenku
