#include "output/table_writer.h"

#include <charconv>
#include <cmath>

#include "core/atomic_file.h"
#include "core/error.h"

namespace tenku {

void append_number(std::string& out, double value) {
  char text[32];
  const auto result =
      std::to_chars(text, text + sizeof text, std::isnan(value) ? std::abs(value) : value);
  out.append(text, result.ptr);
}

std::string shortest_text(double value) {
  std::string out;
  append_number(out, value);
  return out;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

CsvTable::CsvTable(std::string_view header) : text_(std::string(header) + "\n") {}

void CsvTable::separate() {
  if (row_begun_) text_ += ',';
  row_begun_ = true;
}

CsvTable& CsvTable::add(double value) {
  separate();
  append_number(text_, value);
  return *this;
}

CsvTable& CsvTable::add(std::string_view text) {
  separate();
  text_ += csv_field(text);
  return *this;
}

void CsvTable::end_row() {
  text_ += '\n';
  row_begun_ = false;
}

void CsvTable::write(const std::filesystem::path& path) const { write_whole_file(path, text_); }

void add_illuminance(CsvTable& table, const SensorInFile& sensor, const SensorIlluminance& results,
                     std::size_t index) {
  for (const Vec3 v : {sensor.position, sensor.normal}) table.add(v.x).add(v.y).add(v.z);
  table.add(results.sun_lux[index]).add(results.sky_lux[index]).add(results.reflected_lux[index]);
  table.add(results.total_lux(index)).add(results.error_lux[index]).add(results.sky_view[index]);
}

CsvTable illuminance_table(std::span<const Vec3> positions, std::span<const Vec3> normals,
                           const SensorIlluminance& results, std::span<const Decided> decided) {
  expects(positions.size() == results.size() && normals.size() == results.size(),
          "each sensor has a position, a normal and a result");
  expects(decided.empty() || decided.size() == results.size(), "each sensor is decided or not");
  CsvTable table(std::string(kIlluminanceHeader) + (decided.empty() ? "" : ",decided"));
  for (std::size_t i = 0; i < results.size(); ++i) {
    add_illuminance(table, {positions[i], normals[i]}, results, i);
    if (!decided.empty()) table.add(name_of(decided[i]));
    table.end_row();
  }
  return table;
}

}  // namespace tenku
