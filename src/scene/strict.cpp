#include "scene/strict.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace tenku {
namespace {

/// Warnings of what is read as it is.
constexpr std::array<std::string_view, 15> kOnlyTold{"open_shell",
                                                     "misoriented_faces",
                                                     "nonplanar_over_10cm",
                                                     "coincident_faces",
                                                     "far_from_origin",
                                                     "flat_city",
                                                     "huge_triangle",
                                                     "unlikely_size",
                                                     "footprint_only",
                                                     "floating_building",
                                                     "buried_building",
                                                     "off_terrain",
                                                     "overlapping_buildings",
                                                     "shell_in_parts",
                                                     "inner_shell_outside"};

/// Notes of what is not.
constexpr std::array<std::string_view, 5> kMended{"duplicate_vertices", "repeated_vertex",
                                                  "zero_area_face", "reflectance_clamped",
                                                  "feet_lowered"};

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& codes, const std::string& code) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

bool is_mended(const Finding& finding) {
  if (finding.severity == Severity::Note) return is_among(kMended, finding.code);
  return !is_among(kOnlyTold, finding.code);
}

struct Kind {
  const Finding* first;
  std::size_t count;
};

}  // namespace

void refuse_mended(const RawScene& raw, const std::filesystem::path& path) {
  std::vector<Kind> kinds;
  for (const Finding& finding : raw.findings.all()) {
    if (!is_mended(finding)) continue;
    const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) {
      return kind.first->code == finding.code;
    });
    if (known == kinds.end()) {
      kinds.push_back({&finding, finding.count});
    } else {
      known->count += finding.count;
    }
  }
  if (kinds.empty()) return;
  std::string message = path.string();
  message += ": refused, as nothing is to be mended (--strict)";
  for (const Kind& kind : kinds) {
    message +=
        "; " + std::to_string(kind.count) + " x " + kind.first->code + ": " + kind.first->what;
    if (!kind.first->object.empty()) message += " [" + kind.first->object + "]";
  }
  throw InputError(message);
}

}  // namespace tenku
