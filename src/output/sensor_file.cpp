#include "output/sensor_file.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "core/error.h"

namespace tenku {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f,";

struct Place {
  std::string_view file;
  std::size_t line;
  std::string text() const { return std::string(file) + ", line " + std::to_string(line) + ": "; }
};

double number_from(std::string_view word, const Place& place) {
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    throw InputError(place.text() + "\"" + std::string(word) + "\" is not a number");
  }
  if (!std::isfinite(value)) {
    throw InputError(place.text() + "\"" + std::string(word) + "\" is not a finite number");
  }
  return value;
}

// Number of words; the first six as numbers.
std::size_t read_numbers(std::string_view line, const Place& place, std::array<double, 6>& out) {
  std::size_t count = 0;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    const double value = number_from(line.substr(at, end - at), place);
    if (count < out.size()) out[count] = value;
    ++count;
    at = line.find_first_not_of(kBlanks, end);
  }
  return count;
}

void add_sensor(Sensors& sensors, std::string_view line, const Place& place) {
  std::array<double, 6> v{};
  const std::size_t count = read_numbers(line.substr(0, line.find('#')), place, v);
  if (count == 0) return;
  if (count != v.size()) {
    throw InputError(place.text() + std::to_string(count) +
                     " numbers where a sensor has six: x y z nx ny nz");
  }
  const Vec3 normal{v[3], v[4], v[5]};
  const double size = length(normal);
  if (!(size > 0.0 && std::isfinite(size))) {
    throw InputError(place.text() +
                     "the normal has no usable length; give a direction such as 0 0 1");
  }
  sensors.position.push_back({v[0], v[1], v[2]});
  sensors.normal.push_back(normal);
}

}  // namespace

Sensors sensors_from_text(std::string_view text, std::string_view name) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Sensors sensors;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    add_sensor(sensors, text.substr(0, end), {name, line});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (sensors.size() == 0) {
    throw InputError(std::string(name) + " holds no sensors; each line must be x y z nx ny nz");
  }
  return sensors;
}

Sensors read_sensor_file(const std::filesystem::path& path) {
  using Iterator = std::istreambuf_iterator<char>;
  if (path == "-") {
    return sensors_from_text(std::string(Iterator(std::cin), Iterator()), "standard input");
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError(path.string() + " is a folder, not a file of sensors");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("cannot read the sensors " + path.string());
  return sensors_from_text(std::string(Iterator(file), Iterator()), path.string());
}

}  // namespace tenku
