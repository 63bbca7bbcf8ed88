#include "study/sun_moments.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "site/sun_position.h"

namespace tenku {
namespace {

constexpr double kHalfDay = 720.0;  // minutes

struct TurningDay {
  const char* name;
  int month;
  double declination_sign;  ///< 1: the greatest is sought, -1: the least, 0: the nearest to zero
};
constexpr std::array<TurningDay, 4> kTurningDays{{{"March equinox", 3, 0.0},
                                                  {"June solstice", 6, 1.0},
                                                  {"September equinox", 9, 0.0},
                                                  {"December solstice", 12, -1.0}}};
constexpr int kFirstDay = 12, kLastDay = 30;  // of the month: all four fall well within

}  // namespace

std::vector<CivilTime> instants_of_day(const CivilTime& day, double step_min) {
  if (!(step_min >= 0.1 && step_min <= kHalfDay)) {
    throw InputError(fmt::format("a step of {} minutes is not in 0.1..720", step_min));
  }
  const CivilTime noon = local_noon(day);
  const int before = static_cast<int>(std::floor(kHalfDay / step_min));
  std::vector<CivilTime> times;
  for (int k = -before; k * step_min < kHalfDay; ++k) {
    times.push_back(on_clock_of(noon, later_by(noon.instant, 60.0 * step_min * k)));
  }
  return times;
}

std::vector<NamedDay> turning_days(const CivilTime& time, const Location& site) {
  const Instant on_clock = later_by(time.instant, 60.0 * time.offset_minutes);
  const int year = utc_calendar(on_clock).year;
  std::vector<NamedDay> days;
  for (const TurningDay& turning : kTurningDays) {
    NamedDay best{turning.name, {}};
    double least = 1e300;
    for (int day = kFirstDay; day <= kLastDay; ++day) {
      const CivilTime noon =
          local_noon(on_clock_of(time, instant_from_utc({year, turning.month, day, 12, 0, 0.0})));
      const double declination = sun_at(site, noon.instant).declination.in_radians();
      const double miss = turning.declination_sign == 0.0 ? std::abs(declination)
                                                          : -turning.declination_sign * declination;
      if (miss >= least) continue;
      least = miss;
      best.noon = noon;
    }
    days.push_back(best);
  }
  return days;
}

std::vector<SunMoment> moments_of(const std::vector<CivilTime>& times, double step_min, int day,
                                  const SkyAt& sky_at) {
  std::vector<SunMoment> moments;
  for (const CivilTime& time : times) {
    const Sky sky = sky_at(time);
    if (!(sky.sun.direction.z > 0.0)) continue;
    const SunMoment moment{time, sky.sun, 60.0 * step_min, day};
    if (moment.is_up()) moments.push_back(moment);
  }
  return moments;
}

}  // namespace tenku
