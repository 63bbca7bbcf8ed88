// Radiance pictures. Written here because the header must carry EXPOSURE, without which the
// numbers would mean something else to Radiance's own programs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/version.h"
#include "output/image_writer.h"

namespace tenku {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr double kLumensPerWatt = 179.0;  // Radiance reference manual: WHTEFFICACY

Rgbe encoded(Rgb c) {
  const double largest = std::max({c.r, c.g, c.b});
  if (!(c.r >= 0.0 && c.g >= 0.0 && c.b >= 0.0 && largest < 1e37)) {
    throw InputError("a Radiance picture cannot hold negative, infinite or undefined values");
  }
  if (largest < 1e-32) return {0, 0, 0, 0};
  int exponent = 0;
  const double scale = std::frexp(largest, &exponent) * 256.0 / largest;
  return {static_cast<std::uint8_t>(c.r * scale), static_cast<std::uint8_t>(c.g * scale),
          static_cast<std::uint8_t>(c.b * scale), static_cast<std::uint8_t>(exponent + 128)};
}

std::size_t run_length(const std::vector<std::uint8_t>& bytes, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < bytes.size() && end - begin < 127 && bytes[end] == bytes[begin]) ++end;
  return end - begin;
}

// Runs of four or more equal bytes as (128 + length, byte), all else as (length, bytes...).
void append_run_lengths(std::string& out, const std::vector<std::uint8_t>& bytes) {
  constexpr std::size_t kShortestRun = 4, kLongestDump = 128;
  std::size_t at = 0;
  while (at < bytes.size()) {
    std::size_t run_at = at, run = 0;
    while (run_at < bytes.size() && (run = run_length(bytes, run_at)) < kShortestRun) {
      run_at += run;
      run = 0;
    }
    while (at < run_at) {
      const std::size_t dump = std::min(kLongestDump, run_at - at);
      out.push_back(static_cast<char>(dump));
      out.append(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + dump));
      at += dump;
    }
    if (run >= kShortestRun) {
      out.push_back(static_cast<char>(128 + run));
      out.push_back(static_cast<char>(bytes[at]));
      at += run;
    }
  }
}

void append_row(std::string& out, const Image& image, int row) {
  const bool can_be_packed = image.width >= 8 && image.width < 32768;
  std::array<std::vector<std::uint8_t>, 4> planes;
  for (int column = 0; column < image.width; ++column) {
    const Rgbe code = encoded(image.at(column, row));
    if (!can_be_packed) out.append(code.begin(), code.end());
    for (std::size_t k = 0; k < 4; ++k) planes[k].push_back(code[k]);
  }
  if (!can_be_packed) return;
  out += {2, 2, static_cast<char>(image.width >> 8), static_cast<char>(image.width & 255)};
  for (const auto& plane : planes) append_run_lengths(out, plane);
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32; }, ' ');
  return text;
}

}  // namespace

void write_hdr(const std::filesystem::path& path, const Image& image, const PictureInfo& info) {
  std::string out = "#?RADIANCE\nSOFTWARE= " + std::string(software_name()) + "\n";
  if (!info.title.empty()) out += "TITLE= " + one_line(info.title) + "\n";
  if (!info.time.empty()) out += "TIME= " + one_line(info.time) + "\n";
  if (!info.units.empty()) out += "UNITS= " + one_line(info.units) + "\n";
  out += "PRIMARIES= 0.64 0.33 0.30 0.60 0.15 0.06 0.3127 0.3290\n";
  out += "EXPOSURE=" + std::to_string(static_cast<int>(kLumensPerWatt)) + "\n";
  out += "FORMAT=32-bit_rle_rgbe\n\n";
  out += "-Y " + std::to_string(image.height) + " +X " + std::to_string(image.width) + "\n";
  for (int row = 0; row < image.height; ++row) append_row(out, image, row);
  write_whole_file(path, out);
}

}  // namespace tenku
