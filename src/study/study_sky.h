/// The sun and the sky of a study.
#pragma once

#include <optional>

#include "site/civil_time.h"
#include "site/location.h"
#include "site/sun_position.h"
#include "sky_models/make_sky.h"
#include "study/study.h"

namespace tenku {

/// When and where, worked out; `time` and `sun` are absent where the study gives the sun directly.
struct StudyMoment {
  std::optional<Location> site;
  std::optional<CivilTime> time;
  std::optional<Sun> sun;
};

/// @param scene_site  where the scene says it is; the study's own site comes first
/// @throws InputError if the time cannot be read or the site is not known
StudyMoment moment_of(const Study& study, const std::optional<Location>& scene_site);

/// @throws InputError as `make_sky`
Sky sky_of(const Study& study, const StudyMoment& moment);

}  // namespace tenku
