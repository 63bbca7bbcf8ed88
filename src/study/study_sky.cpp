#include "study/study_sky.h"

#include <cmath>

#include "core/error.h"

namespace tenku {
namespace {

/// Mean solar time at the site: 12 h when the mean sun crosses its meridian.
CivilTime solar_time(const std::string& text, const Location& site) {
  CivilTime time = parse_time(text + "Z");
  const double hours = site.longitude.in_degrees() / 15.0;
  time.instant = later_by(time.instant, -3600.0 * hours);
  time.offset_minutes = static_cast<int>(std::lround(60.0 * hours));
  return time;
}

bool has_offset(const std::string& text) {
  const std::size_t clock = text.find_first_of("T ");
  return clock != std::string::npos && text.find_first_of("Z+-", clock) != std::string::npos;
}

}  // namespace

StudyMoment moment_of(const Study& study, const std::optional<Location>& scene_site) {
  StudyMoment moment;
  moment.site = study.scene.site ? study.scene.site : scene_site;
  if (study.time.sun_altitude || study.time.at.empty()) return moment;
  if (!moment.site) {
    throw InputError(study.file.string() +
                     ": the scene does not say where it is; give [site] latitude_deg and "
                     "longitude_deg, or the sun's altitude and azimuth");
  }
  const bool solar = study.time.zone == "solar" && !has_offset(study.time.at);
  moment.time = solar
                    ? solar_time(study.time.at, *moment.site)
                    : parse_time(study.time.at, study.time.zone == "solar" ? "" : study.time.zone);
  moment.sun = sun_at(*moment.site, moment.time->instant);
  return moment;
}

Sky sky_of(const Study& study, const StudyMoment& moment) {
  SkyRequest request;
  request.model = study.sky.model;
  request.sky_illuminance = study.sky.sky_illuminance;
  request.sun_illuminance = study.sky.sun_illuminance;
  request.time = moment.time;
  if (moment.sun) {
    request.sun = SunInSky{moment.sun->apparent_direction, moment.sun->angular_radius,
                           moment.sun->distance_au};
    request.day_of_year = day_of_year(moment.time->instant);
  } else if (study.time.sun_altitude && study.time.sun_azimuth) {
    request.sun = SunInSky{};
    request.sun->direction = direction_from(*study.time.sun_azimuth, *study.time.sun_altitude);
  }
  return make_sky(request);
}

}  // namespace tenku
