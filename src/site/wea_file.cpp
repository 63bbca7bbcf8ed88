#include "site/wea_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/csv.h"
#include "core/error.h"

namespace tenku {
namespace {

constexpr std::array kDaysInMonth{31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
constexpr std::string_view kBlanks = " \t\r";
constexpr double kMinutesPerDegree = 4.0;  // of a time zone
constexpr double kMissing = 9999.0;        // as epw2wea copies it

/// Lines of a file, each with its number and its words.
class WordReader {
 public:
  WordReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  /// The next line that is not blank.
  bool next() {
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      take_words(text_.substr(0, end));
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++number_;
      if (!words_.empty()) return true;
    }
    return false;
  }

  const std::vector<std::string_view>& words() const { return words_; }
  std::size_t number() const { return number_; }
  std::string where() const { return fmt::format("{}, line {}", name_, number_); }

  double value(std::size_t field, double low, double high) const {
    const double v = finite_number(words_.at(field), where());
    if (!(v >= low && v <= high)) {
      throw InputError(fmt::format("{}: {} is not in {}..{}", where(), v, low, high));
    }
    return v;
  }

  int integer(std::size_t field, int low, int high) const {
    const double v = value(field, low, high);
    if (v != std::floor(v)) {
      throw InputError(fmt::format("{}: {} is not a whole number", where(), v));
    }
    return static_cast<int>(v);
  }

 private:
  void take_words(std::string_view line) {
    words_.clear();
    for (std::size_t begin = line.find_first_not_of(kBlanks); begin != line.npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
      words_.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(kBlanks, end);
    }
  }

  std::string_view text_;
  const std::string& name_;
  std::vector<std::string_view> words_;
  std::size_t number_ = 0;
};

/// The value of a header line that begins with `key`.
double header_value(WordReader& line, std::string_view key, double low, double high) {
  if (!line.next() || line.words().front() != key || line.words().size() < 2) {
    throw InputError(fmt::format("{}: a WEA file has '{}' and a number here", line.where(), key));
  }
  return line.value(1, low, high);
}

void read_header(WordReader& line, WeatherFile& file) {
  line.next();
  for (std::size_t w = 1; w < line.words().size(); ++w) {
    if (w > 1) file.city += ' ';
    file.city += line.words()[w];
  }
  file.location.latitude = Angle::degrees(header_value(line, "latitude", -90.0, 90.0));
  file.location.longitude = Angle::degrees(-header_value(line, "longitude", -180.0, 180.0));
  const double zone = -header_value(line, "time_zone", -210.0, 210.0);
  file.offset_minutes = static_cast<int>(std::lround(kMinutesPerDegree * zone));
  file.location.elevation_m = header_value(line, "site_elevation", -500.0, 9000.0);
  if (header_value(line, "weather_data_file_units", 0.0, 9.0) != 1.0) {
    throw InputError(line.where() +
                     ": only units 1 are read, direct normal and diffuse horizontal irradiance");
  }
}

std::optional<Irradiance> irradiance(const WordReader& line, std::size_t field) {
  const double value = line.value(field, 0.0, 1e6);
  if (value >= kMissing) return std::nullopt;
  return Irradiance(value);
}

WeatherHour read_record(const WordReader& line) {
  if (line.words().size() != 5) {
    throw InputError(fmt::format("{}: {} numbers where month, day, hour, direct and diffuse are 5",
                                 line.where(), line.words().size()));
  }
  WeatherHour hour;
  hour.line = line.number();
  hour.month = line.integer(0, 1, 12);
  hour.day = line.integer(1, 1, kDaysInMonth[static_cast<std::size_t>(hour.month) - 1]);
  const double time = line.value(2, 0.0, 24.0);
  hour.hour = std::min(24, static_cast<int>(time) + 1);
  hour.minute = static_cast<int>(std::lround(60.0 * (time - (hour.hour - 1))));
  hour.direct_normal = irradiance(line, 3);
  hour.diffuse_horizontal = irradiance(line, 4);
  return hour;
}

/// As many as the first hour that is followed by another has.
int records_per_hour(const std::vector<WeatherHour>& hours) {
  std::size_t same = 1;
  while (same < hours.size() && hours[same].hour == hours.front().hour &&
         hours[same].day == hours.front().day) {
    ++same;
  }
  return static_cast<int>(same);
}

}  // namespace

bool is_wea(std::string_view text) { return text.starts_with("place"); }

WeatherFile parse_wea(std::string_view text, const std::string& name) {
  WeatherFile file;
  file.name = name;
  WordReader line(text, name);
  read_header(line, file);
  while (line.next()) file.hours.push_back(read_record(line));
  if (file.hours.empty()) throw InputError(name + ": there are no hours; the file is cut off");
  file.records_per_hour = records_per_hour(file.hours);
  return file;
}

}  // namespace tenku
