#include "scene/obj_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>

#include "scene/text_cursor.h"

namespace tenku {
namespace {

struct AxisClause {
  Vec3 axis;      ///< direction in the file along which the quantity grows
  double offset;  ///< what is to be added
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? "" : text.substr(first, last - first + 1);
}

/// The number at the beginning of `text`, up to the first letter that cannot be part of it.
std::optional<double> leading_number(std::string_view text) {
  text = trimmed(text);
  return finite_number(text.substr(0, text.find_first_not_of("0123456789.")));
}

/// The part before a quantity's name, read backwards: `z = -(` or `x =`.
std::optional<Vec3> axis_before(std::string_view before) {
  double sign = 1.0;
  const auto step_back = [&](std::string_view letters) {
    before = trimmed(before);
    const bool is_there = !before.empty() && letters.find(before.back()) != std::string_view::npos;
    if (is_there) before.remove_suffix(1);
    return is_there;
  };
  step_back("(");
  if (step_back("-")) sign = -1.0;
  if (!step_back("=")) return std::nullopt;
  before = trimmed(before);
  if (before.empty()) return std::nullopt;
  switch (before.back()) {
    case 'x':
      return Vec3{sign, 0.0, 0.0};
    case 'y':
      return Vec3{0.0, sign, 0.0};
    case 'z':
      return Vec3{0.0, 0.0, sign};
    default:
      return std::nullopt;
  }
}

/// What stands after a quantity's name up to the end of its clause: ` - 70700.0`. The file's axis
/// is the quantity less its offset, so the sign is turned.
std::optional<double> offset_after(std::string_view after) {
  after = after.substr(0, after.find_first_of(",;()"));
  const auto sign = after.find_first_of("+-");
  if (sign == std::string_view::npos) return 0.0;
  const auto value = leading_number(after.substr(sign + 1));
  if (!value) return std::nullopt;
  return after[sign] == '-' ? *value : -*value;
}

/// `x = easting - 70700.0` or `z = -(northing - 352400.0)`; the text is in small letters.
std::optional<AxisClause> find_axis(std::string_view text, std::string_view quantity) {
  const auto at = text.find(quantity);
  if (at == std::string_view::npos) return std::nullopt;
  const auto axis = axis_before(text.substr(0, at));
  const auto offset = offset_after(text.substr(at + quantity.size()));
  if (!axis || !offset) return std::nullopt;
  return AxisClause{*axis, *offset};
}

void read_axes(std::string_view text, RawScene& raw) {
  const auto easting = find_axis(text, "easting"), northing = find_axis(text, "northing"),
             height = find_axis(text, "height");
  const auto epsg = text.find("epsg:");
  if (!easting || !northing || !height || epsg == std::string_view::npos) return;
  std::string_view code = text.substr(epsg + 5);
  code = code.substr(0, code.find_first_not_of("0123456789"));
  if (code.empty() || dot(cross(easting->axis, northing->axis), height->axis) != 1.0) return;
  raw.crs = "EPSG:" + std::string(code);
  raw.axes = {easting->axis,
              northing->axis,
              height->axis,
              {easting->offset, northing->offset, height->offset}};
  raw.axes_are_given = true;
}

void read_place(std::string_view text, RawScene& raw) {
  const auto colon = text.find(':');
  const std::string_view name = trimmed(text.substr(0, colon));
  const auto value = finite_number(trimmed(text.substr(colon + 1)));
  if (!value) return;
  Location place = raw.place.value_or(Location{});
  if (name == "elevation") {
    place.elevation_m = *value;
  } else if (name == "longitude" && std::abs(*value) <= 180.0) {
    place.longitude = Angle::degrees(*value);
  } else if (name == "latitude" && std::abs(*value) <= 90.0) {
    place.latitude = Angle::degrees(*value);
  } else {
    return;
  }
  raw.place = place;
  raw.axes = kYUpAxes;
  raw.axes_are_given = true;
}

}  // namespace

void read_obj_comment(std::string_view comment, RawScene& raw) {
  constexpr std::size_t kLongest = 400;
  if (comment.size() > kLongest) return;
  std::string text(comment);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (text.find("easting") != std::string::npos) read_axes(text, raw);
  if (text.find(':') != std::string::npos) read_place(text, raw);
}

}  // namespace tenku
