#include "site/weather_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/csv.h"
#include "core/error.h"
#include "site/sun_position.h"
#include "site/wea_file.h"

namespace tenku {
namespace {

constexpr std::size_t kHeaderLines = 8;
constexpr std::size_t kFieldsNeeded = 16;  // up to the diffuse horizontal irradiance
constexpr std::array kDaysInMonth{31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};

/// Lines of a file, each with its number and its cells.
class LineReader {
 public:
  LineReader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  bool next() {
    if (text_.empty()) return false;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++number_;
    cells_.clear();
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t comma = std::min(line.find(',', begin), line.size());
      cells_.push_back(line.substr(begin, comma - begin));
      begin = comma + 1;
    }
    return true;
  }

  const std::vector<std::string_view>& cells() const { return cells_; }
  std::size_t number() const { return number_; }
  std::string where() const { return fmt::format("{}, line {}", name_, number_); }

  double value(std::size_t field) const {
    return finite_number(stripped(cells_.at(field)),
                         fmt::format("{}, field {}", where(), field + 1));
  }

  int integer(std::size_t field, int low, int high) const {
    const double v = value(field);
    if (!(v >= low && v <= high) || v != std::floor(v)) {
      throw InputError(fmt::format("{}, field {}: {} is not a whole number in {}..{}", where(),
                                   field + 1, v, low, high));
    }
    return static_cast<int>(v);
  }

 private:
  static std::string_view stripped(std::string_view s) {
    while (s.starts_with(' ')) s.remove_prefix(1);
    while (s.ends_with(' ')) s.remove_suffix(1);
    return s;
  }

  std::string_view text_;
  std::string name_;
  std::vector<std::string_view> cells_;
  std::size_t number_ = 0;
};

/// LOCATION,city,state,country,source,WMO,latitude,longitude,time zone,elevation
void read_location(LineReader& line, WeatherFile& file) {
  if (!line.next() || line.cells().front() != "LOCATION" || line.cells().size() < 10) {
    throw InputError(
        fmt::format("{}, line 1: an EPW file begins with LOCATION and nine fields after it, a WEA "
                    "file with place",
                    file.name));
  }
  file.city = std::string(line.cells()[1]);
  file.location = {Angle::degrees(line.value(6)), Angle::degrees(line.value(7)), line.value(9)};
  check_location(file.location);
  const double hours = line.value(8);
  if (!(std::abs(hours) <= 14.0)) {
    throw InputError(fmt::format("{}: time zone {} h is not in -14..14", line.where(), hours));
  }
  file.offset_minutes = static_cast<int>(std::lround(60.0 * hours));
}

/// DATA PERIODS,periods,records per hour,...
void read_data_periods(const LineReader& line, WeatherFile& file) {
  if (line.cells().front() != "DATA PERIODS" || line.cells().size() < 3) {
    throw InputError(line.where() + ": the eighth line of an EPW file is DATA PERIODS");
  }
  file.records_per_hour = line.integer(2, 1, 60);
}

std::optional<double> unless_missing(double value, double missing_from) {
  if (value >= missing_from) return std::nullopt;
  return value;
}

std::optional<Irradiance> irradiance(const LineReader& line, std::size_t field) {
  const double value = line.value(field);
  if (value < 0.0) {
    throw InputError(fmt::format("{}, field {}: irradiance {} W/m2 is negative", line.where(),
                                 field + 1, value));
  }
  if (value >= 9999.0) return std::nullopt;
  return Irradiance(value);
}

WeatherHour read_hour(const LineReader& line) {
  if (line.cells().size() < kFieldsNeeded) {
    throw InputError(fmt::format("{}: {} fields where {} are needed; the file is cut off here",
                                 line.where(), line.cells().size(), kFieldsNeeded));
  }
  WeatherHour hour;
  hour.line = line.number();
  hour.year = line.integer(0, 1600, 2400);
  hour.month = line.integer(1, 1, 12);
  hour.day = line.integer(2, 1, kDaysInMonth[static_cast<std::size_t>(hour.month) - 1]);
  hour.hour = line.integer(3, 1, 24);
  hour.minute = line.integer(4, 0, 60);
  hour.dry_bulb_c = unless_missing(line.value(6), 99.9);
  hour.dew_point_c = unless_missing(line.value(7), 99.9);
  const std::optional<double> pressure_pa = unless_missing(line.value(9), 999999.0);
  if (pressure_pa) hour.pressure_hpa = *pressure_pa / 100.0;
  hour.direct_normal = irradiance(line, 14);
  hour.diffuse_horizontal = irradiance(line, 15);
  return hour;
}

void check_whole(const WeatherFile& file, std::size_t lines) {
  const auto per_hour = static_cast<std::size_t>(file.records_per_hour);
  const std::size_t hours = file.hours.size() / per_hour;
  if (file.hours.empty() || file.hours.size() % (24 * per_hour) != 0) {
    throw InputError(fmt::format(
        "{}, line {}: the file ends after {} hours, which are not whole days; it is cut off",
        file.name, lines, hours));
  }
}

}  // namespace

const WeatherHour& WeatherFile::at(Instant instant) const {
  const CalendarTime t = utc_calendar(later_by(instant, offset_minutes * 60.0));
  const auto matches = [&](const WeatherHour& h, int day) {
    return h.month == t.month && h.day == day && h.hour == t.hour + 1;
  };
  const int within = static_cast<int>((t.minute + t.second / 60.0) / 60.0 * records_per_hour);
  const std::array days{t.day, t.month == 2 && t.day == 29 ? 28 : t.day};
  for (const int day : days) {
    for (std::size_t i = 0; i < hours.size(); ++i) {
      if (!matches(hours[i], day)) continue;
      const std::size_t record = i + static_cast<std::size_t>(within);
      return record < hours.size() && matches(hours[record], day) ? hours[record] : hours[i];
    }
  }
  throw InputError(fmt::format("{}: there is no record for {:02}-{:02}, hour {}", name, t.month,
                               t.day, t.hour + 1));
}

WeatherFile parse_weather(std::string_view text, const std::string& name) {
  if (is_wea(text)) return parse_wea(text, name);
  WeatherFile file;
  file.name = name;
  LineReader line(text, name);
  read_location(line, file);
  while (line.number() < kHeaderLines) {
    if (!line.next()) {
      throw InputError(fmt::format("{}, line {}: the header is cut off; it has {} lines", name,
                                   line.number() + 1, kHeaderLines));
    }
  }
  read_data_periods(line, file);
  while (line.next()) {
    if (line.cells().size() == 1 && line.cells().front().empty()) continue;
    file.hours.push_back(read_hour(line));
  }
  check_whole(file, line.number());
  return file;
}

WeatherFile read_weather(const std::filesystem::path& path) {
  return parse_weather(read_whole_file(path), path.string());
}

}  // namespace tenku
