/// Time as people write it, and the instant that it names.
#pragma once

#include <string>
#include <string_view>

namespace tenku {

/// An instant, in UTC.
///
/// A two-part quasi Julian date: the first part ends in .5 (0h), the second counts the fraction of
/// that UTC day. A day with a leap second is one second longer and its fraction still runs to 1.
/// Source   "SOFA Time Scale and Calendar Tools", section 3.5, for the quasi Julian date.
/// Error    about 1e-11 s; before 1960, when there was no UTC, the same numbers mean UT1.
struct Instant {
  double day = 2451544.5;  ///< Julian date of 0h
  double fraction = 0.5;   ///< of the day since, 0 to 1
};

/// A date of the Gregorian calendar with the time of day.
struct CalendarTime {
  int year = 2000, month = 1, day = 1, hour = 12, minute = 0;
  double second = 0.0;
};

/// An instant with the clock that the user reads.
struct CivilTime {
  Instant instant;
  int offset_minutes = 0;  ///< of the clock, east positive
  std::string zone;        ///< IANA name, or empty where only the offset is known
};

/// @param time  UTC; year 1600 to 2400; second below 60, below 61 on a day with a leap second
/// @throws InputError if there is no such date or time
Instant instant_from_utc(const CalendarTime& time);

/// UTC calendar time, to the nearest millisecond.
CalendarTime utc_calendar(Instant instant);

/// The instant `seconds` later, on a clock that knows no leap seconds.
Instant later_by(Instant instant, double seconds);

/// Seconds from `a` to `b`, on a clock that knows no leap seconds.
double seconds_between(Instant a, Instant b);

/// Reads `2026-06-21T09:00+09:00`, `2026-06-21T00:00Z`, or a time without an offset in `zone`.
///
/// Seconds and fractions of them may follow the minutes; a blank may stand for the `T`.
/// @param zone  IANA name such as `Asia/Tokyo`, or empty; read where the text has no offset
/// @throws InputError if the text is no time, the zone is unknown, there is neither offset nor
///         zone, or daylight saving makes the local time happen never or twice (both readings are
///         named)
CivilTime parse_time(std::string_view text, std::string_view zone = "");

/// Offset from UTC of a zone's clock at an instant, minutes, east positive.
/// @throws InputError if the zone is unknown
int zone_offset_minutes(std::string_view zone, Instant instant);

/// The same clock (zone, or else offset) at another instant.
CivilTime on_clock_of(const CivilTime& clock, Instant instant);

/// Noon of the calendar day of `time`, on its clock.
CivilTime local_noon(const CivilTime& time);

/// `2026-06-21T00:00:00Z`; with milliseconds where they are not zero.
std::string iso_utc(Instant instant);

/// `2026-06-21T09:00:00+09:00`; with milliseconds where they are not zero.
std::string iso_local(const CivilTime& time);

/// 1 to 366, in UTC.
int day_of_year(Instant instant);

}  // namespace tenku
