/// Tables as CSV files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec3.h"
#include "illuminance/decision.h"
#include "illuminance/sensor.h"

namespace tenku {

/// Shortest decimal text that reads back as the same double. `nan`, `inf` and `-inf` as such.
std::string shortest_text(double value);

/// Appends `value` to `out` in that form.
void append_number(std::string& out, double value);

/// Text as a CSV field: in double quotes where it holds a comma, a quote or a line break.
///
/// Source   RFC 4180.
std::string csv_field(std::string_view text);

/// A table in the making: a header line, then rows of numbers and texts.
class CsvTable {
 public:
  /// @param header  column names, separated by commas
  explicit CsvTable(std::string_view header);

  CsvTable& add(double value);
  CsvTable& add(std::string_view text);
  void end_row();

  const std::string& text() const { return text_; }

  /// Writes the table to `path`, or to standard output if `path` is `-`.
  /// @throws InputError, ResourceError as write_whole_file does
  void write(const std::filesystem::path& path) const;

 private:
  void separate();
  std::string text_;
  bool row_begun_ = false;
};

/// Header of illuminance tables.
inline constexpr std::string_view kIlluminanceHeader =
    "x,y,z,nx,ny,nz,sun_lux,sky_lux,reflected_lux,total_lux,error_lux,sky_view";

/// A sensor as the user gave it, in the coordinates of the scene file.
struct SensorInFile {
  Vec3 position, normal;
};

/// Adds the cells of kIlluminanceHeader to a row that is not ended.
void add_illuminance(CsvTable& table, const SensorInFile& sensor, const SensorIlluminance& results,
                     std::size_t index);

/// Table of `results` on sensors, in their order.
///
/// @param positions, normals  as the user gave them, in the coordinates of the scene file
/// @param decided  a last column `decided`, unless it is empty
CsvTable illuminance_table(std::span<const Vec3> positions, std::span<const Vec3> normals,
                           const SensorIlluminance& results, std::span<const Decided> decided = {});

}  // namespace tenku
