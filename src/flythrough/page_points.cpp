#include "flythrough/page_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flythrough/point_codec.h"

namespace tenku {
namespace {

// Small blocks have small steps: on a surface 4096 points reach some 64 footprints.
constexpr std::size_t kPointsInBlock = 4096;
constexpr double kMostCode = 65535.0;
constexpr int kBias = 15, kMantissaBits = 9;
constexpr double kMostShared = 65408.0;

using Column = std::vector<std::uint16_t>;

PageBlock block_of(const StoredPoints& points, std::size_t from, std::size_t to) {
  Extent extent;
  PageBlock block{to - from, {}, {}, std::numeric_limits<float>::infinity()};
  for (std::size_t i = from; i < to; ++i) {
    extent.add(points.position[i]);
    block.finest_m = std::min(block.finest_m, points.footprint_m[i]);
  }
  block.origin = extent.min;
  block.step = (1.0 / kMostCode) * extent.size();
  return block;
}

std::uint16_t place_code(double along, double step) {
  return step > 0.0 ? static_cast<std::uint16_t>(std::lround(std::min(along / step, kMostCode)))
                    : std::uint16_t{0};
}

std::uint16_t footprint_code(float metres, bool is_edge) {
  const double k = 1.0 + std::round(512.0 * (std::log2(double{metres}) + 20.0));
  return static_cast<std::uint16_t>(2 * static_cast<int>(std::clamp(k, 0.0, 32767.0)) +
                                    (is_edge ? 1 : 0));
}

std::array<std::uint16_t, 2> octahedral(Vec3 n) {
  const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  double u = n.x / sum, v = n.y / sum;
  if (n.z < 0.0) {
    const double folded = (1.0 - std::abs(v)) * std::copysign(1.0, u);
    v = (1.0 - std::abs(u)) * std::copysign(1.0, v);
    u = folded;
  }
  const auto code = [](double x) {
    return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(32767.0 * x)));
  };
  return {code(u), code(v)};
}

void append_differences(const Column& column, std::string& bytes) {
  Column differences(column.size());
  std::uint16_t before = 0;
  for (std::size_t i = 0; i < column.size(); ++i) {
    differences[i] = static_cast<std::uint16_t>(column[i] - before);
    before = column[i];
  }
  for (const std::uint16_t d : differences) bytes.push_back(static_cast<char>(d & 255U));
  for (const std::uint16_t d : differences) bytes.push_back(static_cast<char>(d >> 8U));
}

}  // namespace

PagePoints page_points(const StoredPoints& points) {
  PagePoints page;
  std::array<Column, 6> columns;
  for (std::size_t from = 0; from < points.size(); from += kPointsInBlock) {
    const std::size_t to = std::min(points.size(), from + kPointsInBlock);
    const PageBlock block = block_of(points, from, to);
    page.blocks.push_back(block);
    for (std::size_t i = from; i < to; ++i) {
      const Vec3 d = points.position[i] - block.origin;
      columns[0].push_back(place_code(d.x, block.step.x));
      columns[1].push_back(place_code(d.y, block.step.y));
      columns[2].push_back(place_code(d.z, block.step.z));
      columns[3].push_back(footprint_code(points.footprint_m[i], points.is_edge[i] != 0));
      const auto normal = octahedral(points.normal[i]);
      columns[4].push_back(normal[0]);
      columns[5].push_back(normal[1]);
    }
  }
  std::string bytes;
  for (const Column& column : columns) append_differences(column, bytes);
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      bytes.push_back(points.is_edge[i] != 0 ? static_cast<char>(points.borders[i].code[k]) : '\0');
    }
  }
  page.bytes = deflated(bytes).substr(sizeof(std::uint32_t));
  return page;
}

std::string page_colours(const std::vector<Rgb>& colours) {
  std::vector<std::uint32_t> codes(colours.size());
  std::transform(colours.begin(), colours.end(), codes.begin(), shared_exponent_code);
  std::string bytes;
  for (unsigned plane = 0; plane < 32; plane += 8) {
    for (const std::uint32_t code : codes) {
      bytes.push_back(static_cast<char>((code >> plane) & 255U));
    }
  }
  return deflated(bytes).substr(sizeof(std::uint32_t));
}

std::uint32_t shared_exponent_code(Rgb colour) {
  const auto kept = [](double v) { return v > 0.0 ? std::min(v, kMostShared) : 0.0; };
  const Rgb c{kept(colour.r), kept(colour.g), kept(colour.b)};
  const double most = std::max({c.r, c.g, c.b});
  int exponent = most > 0.0 ? std::max(-kBias - 1, std::ilogb(most)) + 1 + kBias : 0;
  // A mantissa that would round up to 2^9 takes the next exponent.
  if (std::lround(std::ldexp(most, kBias + kMantissaBits - exponent)) >> kMantissaBits) ++exponent;
  const auto mantissa = [&](double v) {
    return static_cast<std::uint32_t>(std::lround(std::ldexp(v, kBias + kMantissaBits - exponent)));
  };
  const std::uint32_t code = mantissa(c.r) | mantissa(c.g) << 9U | mantissa(c.b) << 18U |
                             static_cast<std::uint32_t>(exponent) << 27U;
  return code == kNoColourCode ? code - 1 : code;
}

Rgb colour_of_shared_exponent(std::uint32_t code) {
  const int exponent = static_cast<int>(code >> 27U) - kBias - kMantissaBits;
  const auto value = [&](unsigned shift) {
    return std::ldexp(static_cast<double>((code >> shift) & 511U), exponent);
  };
  return {value(0), value(9), value(18)};
}

}  // namespace tenku
