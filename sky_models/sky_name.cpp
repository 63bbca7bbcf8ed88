#include "sky_models/sky_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace tenku {
namespace {

constexpr std::array<std::string_view, 7> kForms{
    "uniform",          "cie-overcast",   "cie:12", "perez:DNI,DHI",
    "weather:FILE.epw", "image:FILE.hdr", "none"};

/// Levenshtein's edit distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

[[noreturn]] void fail_unknown(std::string_view text) {
  const std::string_view head = text.substr(0, text.find(':'));
  const auto nearness = [&](std::string_view form) {
    return edit_distance(head, form.substr(0, form.find(':')));
  };
  const auto nearest = *std::min_element(
      kForms.begin(), kForms.end(),
      [&](std::string_view a, std::string_view b) { return nearness(a) < nearness(b); });
  throw InputError(fmt::format("sky '{}' is unknown; did you mean '{}'? The skies: {}", text,
                               nearest, fmt::join(kForms.begin(), kForms.end(), ", ")));
}

template <class T>
bool read_number(std::string_view text, T& value) {
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && last == text.data() + text.size();
}

SkyName cie_sky(std::string_view text, std::string_view rest) {
  SkyName name{SkyKind::CieGeneral, 0, {}, {}, {}};
  if (!read_number(rest, name.cie_type) || name.cie_type < 1 || name.cie_type > 15) {
    throw InputError(fmt::format("sky '{}': the CIE type is not in 1..15", text));
  }
  return name;
}

SkyName perez_sky(std::string_view text, std::string_view rest) {
  double direct = 0.0, diffuse = 0.0;
  const std::size_t comma = rest.find(',');
  if (comma == rest.npos || !read_number(rest.substr(0, comma), direct) ||
      !read_number(rest.substr(comma + 1), diffuse)) {
    throw InputError(fmt::format(
        "sky '{}': write perez:DNI,DHI with both irradiances in W/m2, as perez:600,120", text));
  }
  if (!(direct >= 0.0 && diffuse >= 0.0 && std::isfinite(direct) && std::isfinite(diffuse))) {
    throw InputError(fmt::format("sky '{}': an irradiance is negative or no number", text));
  }
  return {SkyKind::Perez, 0, Irradiance(direct), Irradiance(diffuse), {}};
}

SkyName file_sky(SkyKind kind, std::string_view text, std::string_view rest) {
  if (rest.empty()) throw InputError(fmt::format("sky '{}': no file is named", text));
  return {kind, 0, {}, {}, std::string(rest)};
}

}  // namespace

SkyName parse_sky_name(std::string_view text) {
  if (text == "none") return {};
  if (text == "uniform") return {SkyKind::Uniform, 0, {}, {}, {}};
  if (text == "cie-overcast") return {SkyKind::CieOvercast, 0, {}, {}, {}};
  const std::size_t colon = text.find(':');
  const std::string_view head = text.substr(0, colon);
  const std::string_view rest = colon == text.npos ? std::string_view() : text.substr(colon + 1);
  if (head == "cie") return cie_sky(text, rest);
  if (head == "perez") return perez_sky(text, rest);
  if (head == "weather") return file_sky(SkyKind::Weather, text, rest);
  if (head == "image") return file_sky(SkyKind::Image, text, rest);
  fail_unknown(text);
}

}  // namespace tenku
