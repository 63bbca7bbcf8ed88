#include "scene/obj_header.h"

#include <cctype>
#include <cmath>
#include <regex>
#include <string>

#include "scene/text_cursor.h"

namespace tenku {
namespace {

struct AxisClause {
  Vec3 axis;      ///< direction in the file along which the quantity grows
  double offset;  ///< what is to be added
};

/// `x = Easting - 70700.0` or `z = -(Northing - 352400.0)`: the named quantity in terms of the file.
std::optional<AxisClause> find_axis(const std::string& text, const char* quantity) {
  const std::regex pattern(R"(\b([xyz])\s*=\s*(-?)\s*\(?\s*)" + std::string(quantity) +
                               R"(\b[^-+,;()]*(?:([-+])\s*([0-9.]+))?)",
                           std::regex::icase);
  std::smatch match;
  if (!std::regex_search(text, match, pattern)) return std::nullopt;
  const double sign = match[2].length() > 0 ? -1.0 : 1.0;
  const char letter = static_cast<char>(std::tolower(static_cast<unsigned char>(match[1].str()[0])));
  const Vec3 axis{letter == 'x' ? sign : 0.0, letter == 'y' ? sign : 0.0,
                  letter == 'z' ? sign : 0.0};
  double offset = 0.0;
  if (match[4].matched) {
    const auto value = finite_number(match[4].str());
    if (!value) return std::nullopt;
    offset = match[3].str() == "-" ? *value : -*value;
  }
  return AxisClause{axis, offset};
}

void read_axes(const std::string& text, RawScene& raw) {
  const auto easting = find_axis(text, "Easting"), northing = find_axis(text, "Northing"),
             height = find_axis(text, "(?:height|elevation)");
  std::smatch epsg;
  const bool has_crs = std::regex_search(text, epsg, std::regex(R"(EPSG:(\d{4,6}))"));
  if (!easting || !northing || !height || !has_crs) return;
  if (dot(cross(easting->axis, northing->axis), height->axis) != 1.0) return;
  raw.crs = epsg[0].str();
  raw.axes = {easting->axis, northing->axis, height->axis,
              {easting->offset, northing->offset, height->offset}};
  raw.axes_are_given = true;
}

void read_place(const std::string& text, RawScene& raw) {
  std::smatch match;
  static const std::regex pattern(R"(^\s*(Longitude|Latitude|Elevation):\s*(-?[0-9.]+)\s*$)");
  if (!std::regex_match(text, match, pattern)) return;
  const auto value = finite_number(match[2].str());
  if (!value) return;
  Location place = raw.place.value_or(Location{});
  if (match[1] == "Elevation") place.elevation_m = *value;
  if (match[1] == "Longitude" && std::abs(*value) <= 180.0) place.longitude = Angle::degrees(*value);
  if (match[1] == "Latitude" && std::abs(*value) <= 90.0) place.latitude = Angle::degrees(*value);
  raw.place = place;
  raw.axes = kYUpAxes;
  raw.axes_are_given = true;
}

}  // namespace

void read_obj_comment(std::string_view comment, RawScene& raw) {
  constexpr std::size_t kLongest = 400;  // std::regex recurses; a header line is short
  if (comment.empty() || comment.size() > kLongest) return;
  const std::string text(comment);
  if (text.find("asting") != std::string::npos) read_axes(text, raw);
  if (text.find("tude:") != std::string::npos || text.find("Elevation:") != std::string::npos) {
    read_place(text, raw);
  }
}

}  // namespace tenku
