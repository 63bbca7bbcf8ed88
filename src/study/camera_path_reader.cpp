#include "study/camera_path_reader.h"

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "study/toml_section.h"

namespace tenku {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 8> kPathKeys{
    "curve", "speed", "frames_per_second", "size", "fov_deg", "stand_s", "walk_height_m", "key"};
constexpr std::array<std::string_view, 4> kKeyKeys{"time_s", "eye", "target", "fov_deg"};
constexpr std::array<std::string_view, 2> kCurves{"catmull-rom", "straight"};
constexpr std::array<std::string_view, 3> kSpeeds{"keyed", "constant", "eased"};
constexpr NumberRange kFov{1.0, 175.0};

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (fs::is_directory(path) || !in || !(text << in.rdbuf())) {
    throw InputError("cannot read the camera path " + path.string());
  }
  return text.str();
}

CameraKey key_of(const TomlSection& in, Angle usual_fov) {
  in.refuse_unknown_keys(kKeyKeys);
  const auto time = in.number("time_s", {-1e6, 1e6});
  const auto eye = in.point("eye"), target = in.point("target");
  if (!time) in.refuse("time_s", "a key of a path needs its time_s");
  if (!eye) in.refuse("eye", "a key of a path needs its eye");
  if (!target) in.refuse("target", "a key of a path needs its target");
  const auto fov = in.number("fov_deg", kFov);
  return {*time, *eye, *target, fov ? Angle::degrees(*fov) : usual_fov};
}

/// Height of what one can walk on under (x, y), past roofs and bridges above it: the highest ground
/// or road, or else, where the file tells no kinds of surfaces, the lowest that is no wall.
std::optional<double> ground_below(const LitScene& lit, double x, double y, double top) {
  constexpr int kMostLayers = 256;
  constexpr double kWalkable = 0.5;  // cosine of the steepest slope
  double z = top;
  std::optional<double> lowest;
  for (int k = 0; k < kMostLayers; ++k) {
    const auto hit = lit.rays().first_hit({x, y, z}, {0.0, 0.0, -1.0});
    if (!hit) break;
    z -= hit->distance_m;
    if (std::abs(lit.rays().normal(hit->triangle).z) > kWalkable) {
      const SurfaceType type = lit.soup().surface_type[hit->triangle];
      if (type == SurfaceType::Ground || type == SurfaceType::Road) return z;
      if (type == SurfaceType::Unknown) lowest = z;
    }
    z -= 10.0 * lit.rays().lift_m();
  }
  return lowest;
}

}  // namespace

CameraPathRequest read_camera_path(const fs::path& path) {
  const TomlSection document = TomlSection::parse(text_of(path), path.string());
  document.refuse_unknown_keys(kPathKeys);
  CameraPathRequest request;
  if (document.choice("curve", kCurves) == "straight") request.curve = PathCurve::Straight;
  const auto speed = document.choice("speed", kSpeeds);
  if (speed == "constant") request.speed = PathSpeed::Constant;
  if (speed == "eased") request.speed = PathSpeed::Eased;
  request.frames_per_s =
      document.number("frames_per_second", {0.0, 1000.0, true}).value_or(request.frames_per_s);
  if (const auto size = document.numbers("size", 2, {1.0, 16384.0})) {
    if (std::floor((*size)[0]) != (*size)[0] || std::floor((*size)[1]) != (*size)[1]) {
      document.refuse("size", "size is two whole numbers of pixels");
    }
    request.width = static_cast<int>((*size)[0]), request.height = static_cast<int>((*size)[1]);
  }
  const Angle fov = Angle::degrees(document.number("fov_deg", kFov).value_or(60.0));
  request.standing_s = document.number("stand_s", {0.0, 1e6}).value_or(0.0);
  request.walk_height_m = document.number("walk_height_m", {0.0, 1000.0, true});
  for (const TomlSection& key : document.tables("key")) request.keys.push_back(key_of(key, fov));
  if (request.keys.empty()) document.refuse("key", "the path has no [[key]]");
  return request;
}

CameraPath camera_path_in(CameraPathRequest request, const LitScene& lit) {
  for (CameraKey& key : request.keys) {
    key.eye = lit.scene().frame.to_local(key.eye);
    key.target = lit.scene().frame.to_local(key.target);
  }
  const double top = lit.extent().max.z + 1.0;
  return make_camera_path(request,
                          [&](double x, double y) { return ground_below(lit, x, y, top); });
}

std::vector<std::string> camera_path_keys() {
  std::vector<std::string> keys;
  for (const std::string_view key : kPathKeys) {
    if (key != "key") keys.emplace_back(key);
  }
  for (const std::string_view key : kKeyKeys) keys.push_back("key." + std::string(key));
  return keys;
}

}  // namespace tenku
