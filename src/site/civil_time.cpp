#include "site/civil_time.h"

#include <date/tz.h>
#include <erfa.h>
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/error.h"

namespace tenku {
namespace {

constexpr double kDay_s = 86400.0;
constexpr int kFirstYear = 1600, kLastYear = 2400;
constexpr int kFirstUtcYear = 1960;

std::string plain(const CalendarTime& t) {
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:06.3f}", t.year, t.month, t.day, t.hour,
                     t.minute, t.second);
}

void check_date(const CalendarTime& t) {
  const date::year_month_day day{date::year(t.year), date::month(static_cast<unsigned>(t.month)),
                                 date::day(static_cast<unsigned>(t.day))};
  if (!day.ok()) {
    throw InputError(fmt::format("there is no date {:04}-{:02}-{:02}", t.year, t.month, t.day));
  }
  if (t.year < kFirstYear || t.year > kLastYear) {
    throw InputError(fmt::format("year {} is not in {}..{}", t.year, kFirstYear, kLastYear));
  }
}

date::sys_days sys_day(const CalendarTime& t) {
  return date::sys_days(date::year(t.year) / t.month / t.day);
}

date::local_seconds local_minutes(const CalendarTime& t) {
  return date::local_days(date::year(t.year) / t.month / t.day) + std::chrono::hours(t.hour) +
         std::chrono::minutes(t.minute);
}

const date::time_zone& zone_named(std::string_view name) {
  try {
    return *date::locate_zone(name);
  } catch (const std::exception&) {
    throw InputError(fmt::format(
        "time zone '{}' is unknown; give an IANA name such as Asia/Tokyo, Europe/Vienna or UTC",
        name));
  }
}

int minutes_of(std::chrono::seconds offset) {
  return static_cast<int>(std::chrono::round<std::chrono::minutes>(offset).count());
}

std::string offset_text(int minutes) {
  return fmt::format("{}{:02}:{:02}", minutes < 0 ? '-' : '+', std::abs(minutes) / 60,
                     std::abs(minutes) % 60);
}

/// Reads the parts of a time one after the other.
class TimeReader {
 public:
  explicit TimeReader(std::string_view text) : text_(text), rest_(text) {}

  CalendarTime calendar_time() {
    CalendarTime t;
    t.year = digits(4);
    literal("-");
    t.month = digits(2);
    literal("-");
    t.day = digits(2);
    if (!take('T') && !take(' ')) fail();
    t.hour = digits(2);
    literal(":");
    t.minute = digits(2);
    t.second = take(':') ? seconds() : 0.0;
    if (t.hour > 23 || t.minute > 59 || t.second >= 61.0) fail();
    return t;
  }

  /// Offset in minutes; none where the text ends here.
  std::optional<int> offset() {
    if (rest_.empty()) return std::nullopt;
    if (take('Z')) return end(0);
    const int sign = take('-') ? -1 : 1;
    if (sign == 1) literal("+");
    const int hours = digits(2);
    take(':');
    const int minutes = digits(2);
    if (hours > 15 || minutes > 59) fail();
    return end(sign * (60 * hours + minutes));
  }

  [[noreturn]] void fail() const {
    throw InputError(
        fmt::format("'{}' is not a time; write 2026-06-21T09:00+09:00, 2026-06-21T00:00Z, or "
                    "2026-06-21T09:00 with a time zone",
                    text_));
  }

 private:
  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void literal(std::string_view s) {
    if (!rest_.starts_with(s)) fail();
    rest_.remove_prefix(s.size());
  }

  int digits(std::size_t count) {
    int value = 0;
    if (rest_.size() < count) fail();
    const auto [last, error] = std::from_chars(rest_.data(), rest_.data() + count, value);
    if (error != std::errc() || last != rest_.data() + count || value < 0) fail();
    rest_.remove_prefix(count);
    return value;
  }

  double seconds() {
    double value = digits(2);
    if (!take('.') && !take(',')) return value;
    double unit = 0.1;
    if (rest_.empty() || !is_digit(rest_.front())) fail();
    for (; !rest_.empty() && is_digit(rest_.front()); rest_.remove_prefix(1), unit *= 0.1) {
      value += unit * (rest_.front() - '0');
    }
    return value;
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  int end(int value) const {
    if (!rest_.empty()) fail();
    return value;
  }

  std::string_view text_, rest_;
};

[[noreturn]] void fail_gap(const CalendarTime& t, std::string_view zone, int before, int after) {
  throw InputError(fmt::format(
      "{} never happens in {}: the clock is put forward over it. Give an offset: {}{} or {}{}",
      plain(t).substr(0, 16), zone, plain(t).substr(0, 16), offset_text(before),
      plain(t).substr(0, 16), offset_text(after)));
}

[[noreturn]] void fail_overlap(const CalendarTime& t, std::string_view zone, int first,
                               int second) {
  throw InputError(fmt::format(
      "{} happens twice in {}: the clock is put back over it. Give an offset: {}{} or {}{}",
      plain(t).substr(0, 16), zone, plain(t).substr(0, 16), offset_text(first),
      plain(t).substr(0, 16), offset_text(second)));
}

int offset_in_zone(const CalendarTime& t, std::string_view zone) {
  const date::local_info info = zone_named(zone).get_info(local_minutes(t));
  const int first = minutes_of(info.first.offset), second = minutes_of(info.second.offset);
  if (info.result == date::local_info::nonexistent) fail_gap(t, zone, first, second);
  if (info.result == date::local_info::ambiguous) fail_overlap(t, zone, first, second);
  return first;
}

/// Whole days and minutes of a calendar time after it was moved by whole minutes; seconds stay.
CalendarTime moved(CalendarTime t, int minutes) {
  const auto time = local_minutes(t) + std::chrono::minutes(minutes);
  const auto day = std::chrono::floor<date::days>(time);
  const date::year_month_day ymd{day};
  const auto in_day = std::chrono::duration_cast<std::chrono::minutes>(time - day).count();
  t.year = int(ymd.year());
  t.month = static_cast<int>(unsigned(ymd.month()));
  t.day = static_cast<int>(unsigned(ymd.day()));
  t.hour = static_cast<int>(in_day / 60);
  t.minute = static_cast<int>(in_day % 60);
  return t;
}

std::string with_seconds(const CalendarTime& t) {
  const std::string text = plain(t);
  return text.ends_with(".000") ? text.substr(0, text.size() - 4) : text;
}

}  // namespace

Instant instant_from_utc(const CalendarTime& t) {
  check_date(t);
  if (!(t.second >= 0.0 && t.second < 61.0) || t.hour < 0 || t.hour > 23 || t.minute < 0 ||
      t.minute > 59) {
    throw InputError("there is no time " + plain(t));
  }
  Instant instant;
  const char* scale = t.year < kFirstUtcYear ? "UT1" : "UTC";
  const int status = eraDtf2d(scale, t.year, t.month, t.day, t.hour, t.minute, t.second,
                              &instant.day, &instant.fraction);
  // 1 is a year for which leap seconds are not yet known; 2 and 3 a second beyond the day's end
  if (status < 0 || status > 1 || (t.second >= 60.0 && (t.hour != 23 || t.minute != 59))) {
    throw InputError("there is no time " + plain(t) + " UTC: no leap second was inserted there");
  }
  const double midnight = std::floor(instant.day + 0.5) - 0.5;
  instant.fraction += instant.day - midnight;
  instant.day = midnight;
  return instant;
}

CalendarTime utc_calendar(Instant instant) {
  CalendarTime t;
  int parts[4] = {};
  const bool is_utc = instant.day >= 2436934.5;  // 1960-01-01
  eraD2dtf(is_utc ? "UTC" : "UT1", 3, instant.day, instant.fraction, &t.year, &t.month, &t.day,
           parts);
  t.hour = parts[0];
  t.minute = parts[1];
  t.second = parts[2] + parts[3] / 1000.0;
  return t;
}

Instant later_by(Instant instant, double seconds) {
  const double fraction = instant.fraction + seconds / kDay_s;
  const double days = std::floor(fraction);
  return {instant.day + days, fraction - days};
}

double seconds_between(Instant a, Instant b) {
  return ((b.day - a.day) + (b.fraction - a.fraction)) * kDay_s;
}

CivilTime parse_time(std::string_view text, std::string_view zone) {
  TimeReader reader(text);
  const CalendarTime local = reader.calendar_time();
  check_date(local);
  const std::optional<int> offset = reader.offset();
  CivilTime time;
  if (!zone.empty()) zone_named(zone);
  if (offset) {
    time.offset_minutes = *offset;
  } else if (!zone.empty()) {
    time.zone = zone;
    time.offset_minutes = offset_in_zone(local, zone);
  } else {
    throw InputError(fmt::format(
        "'{}' has no offset from UTC; write {}+09:00, {}Z, or give a time zone", text, text, text));
  }
  time.instant = instant_from_utc(moved(local, -time.offset_minutes));
  return time;
}

int zone_offset_minutes(std::string_view zone, Instant instant) {
  const CalendarTime t = utc_calendar(instant);
  const date::sys_seconds utc =
      sys_day(t) + std::chrono::hours(t.hour) + std::chrono::minutes(t.minute);
  return minutes_of(zone_named(zone).get_info(utc).offset);
}

CivilTime on_clock_of(const CivilTime& clock, Instant instant) {
  CivilTime time = clock;
  time.instant = instant;
  if (!clock.zone.empty()) time.offset_minutes = zone_offset_minutes(clock.zone, instant);
  return time;
}

CivilTime local_noon(const CivilTime& time) {
  CalendarTime noon = moved(utc_calendar(time.instant), time.offset_minutes);
  noon.hour = 12;
  noon.minute = 0;
  noon.second = 0.0;
  CivilTime result = time;
  // A change of the clock between the time given and noon moves noon by the difference.
  for (int i = 0; i < 2; ++i) {
    result = on_clock_of(result, instant_from_utc(moved(noon, -result.offset_minutes)));
  }
  result.instant = instant_from_utc(moved(noon, -result.offset_minutes));
  return result;
}

std::string iso_utc(Instant instant) { return with_seconds(utc_calendar(instant)) + "Z"; }

std::string iso_local(const CivilTime& time) {
  return with_seconds(moved(utc_calendar(time.instant), time.offset_minutes)) +
         offset_text(time.offset_minutes);
}

int day_of_year(Instant instant) {
  const CalendarTime t = utc_calendar(instant);
  return static_cast<int>((sys_day(t) - date::sys_days(date::year(t.year) / 1 / 1)).count()) + 1;
}

}  // namespace tenku
