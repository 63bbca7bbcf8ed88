/// From the words of the command line or a study to a sky and a sun.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/finding.h"
#include "core/units.h"
#include "core/vec3.h"
#include "site/civil_time.h"
#include "sky_models/sky_model.h"

namespace tenku {

/// Where the sun stands, as far as a sky needs to know.
struct SunInSky {
  Vec3 direction = kZenith;  ///< unit, to the centre; with refraction where that is known
  Angle angular_radius = Angle::degrees(0.533 / 2);
  std::optional<double> distance_au;
};

/// What is asked for.
struct SkyRequest {
  /// `uniform`, `cie-overcast`, `cie:1` .. `cie:15`, `perez:DNI,DHI` (W/m2), `weather:FILE.epw`,
  /// `image:FILE` or `none`.
  std::string model = "cie-overcast";
  std::optional<Illuminance> sky_illuminance;  ///< horizontal, diffuse; default by the model
  std::optional<Illuminance> sun_illuminance;  ///< direct normal; default by the model
  std::optional<SunInSky> sun;
  std::optional<int> day_of_year;     ///< for `perez` where the sun's distance is not known
  std::optional<CivilTime> time;      ///< for `weather`
  std::optional<double> dew_point_c;  ///< for `perez`
  Angle image_rotation;               ///< turns an `image` clockwise seen from above
};

/// A sky and its sun.
struct Sky {
  std::unique_ptr<SkyModel> model;  ///< none: no light from the sky
  SolarDisc sun;
  double horizontal_diffuse_lux = 0.0;  ///< unobstructed
  std::string description;              ///< one line for logs and reports
  std::vector<Finding> diagnostics;

  /// Luminance in a direction, without the solar disc; zero where there is no model.
  [[nodiscard]] Luminance luminance(Vec3 direction) const {
    return model ? model->luminance(direction) : Luminance(0.0);
  }
};

/// Makes the sky that is asked for.
///
/// Where no level is given: `uniform` and `cie-overcast` have the illuminance of an average
/// overcast sky at the sun's altitude and no sun, `cie:N` the typical level of its type
/// (`sky_level.h`), `perez` and `weather` that of the irradiance, `image` that of its pixels. With
/// the sun on or below the horizon sky and sun are dark, with a finding, but for skies that need
/// no sun and are given a level.
/// @throws InputError if the model is unknown (with a suggestion) or lacks what it needs, or an
///         illuminance is negative or no number
Sky make_sky(const SkyRequest& request);

}  // namespace tenku
