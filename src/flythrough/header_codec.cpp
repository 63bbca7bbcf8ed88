#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "flythrough/point_codec.h"

namespace tenku {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(Vec3 v) { return Json::array({v.x, v.y, v.z}); }
Json json_of(Rgb c) { return Json::array({c.r, c.g, c.b}); }
Vec3 vec3_of(const Json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}
Rgb rgb_of(const Json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json json_of(const CameraPath& path) {
  Json frames = Json::array();
  for (const CameraFrame& f : path.frames) {
    frames.push_back({f.time_s, f.eye.x, f.eye.y, f.eye.z, f.target.x, f.target.y, f.target.z,
                      f.horizontal_fov.in_degrees()});
  }
  return {{"width", path.width},
          {"height", path.height},
          {"frames_per_s", path.frames_per_s},
          {"frames", std::move(frames)}};
}

CameraPath path_of(const Json& json) {
  CameraPath path;
  path.width = json.at("width").get<int>();
  path.height = json.at("height").get<int>();
  path.frames_per_s = json.at("frames_per_s").get<double>();
  for (const Json& f : json.at("frames")) {
    const auto at = [&](std::size_t i) { return f.at(i).get<double>(); };
    path.frames.push_back(
        {at(0), {at(1), at(2), at(3)}, {at(4), at(5), at(6)}, Angle::degrees(at(7))});
    const PerspectiveCamera checked(path.view(path.size() - 1));
  }
  return path;
}

/// @throws InputError in place of the errors of the JSON library
template <class Made, class Make>
Made checked(const Make& make) {
  try {
    return make();
  } catch (const Json::exception&) {
    throw InputError("a record of the point store does not hold what it should");
  }
}

/// Green, and what red and blue differ from it, each less that of the pixel before: grey skies and
/// even ones become zeros.
void put_map(const SkyMap& map, std::string& bytes) {
  std::array<std::uint16_t, 3> last{};
  for (const Rgb& c : map.pixels) {
    const std::uint16_t green = log_code(c.g);
    const std::array<std::uint16_t, 3> now{green, static_cast<std::uint16_t>(log_code(c.r) - green),
                                           static_cast<std::uint16_t>(log_code(c.b) - green)};
    for (std::size_t k = 0; k < now.size(); ++k) {
      const auto less = static_cast<std::uint16_t>(now[k] - last[k]);
      bytes.append(reinterpret_cast<const char*>(&less), sizeof less);
    }
    last = now;
  }
}

void get_map(std::string_view bytes, SkyMap& map) {
  constexpr int kLargestSide = 32768;
  if (map.columns < 0 || map.rows < 0 || map.columns > kLargestSide || map.rows > kLargestSide ||
      bytes.size() !=
          6 * static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows)) {
    throw InputError("a record of the point store is damaged");
  }
  std::array<std::uint16_t, 3> sum{};
  for (std::size_t at = 0; at < bytes.size(); at += 6) {
    std::array<std::uint16_t, 3> less{};
    std::memcpy(less.data(), bytes.data() + at, sizeof less);
    for (std::size_t k = 0; k < sum.size(); ++k)
      sum[k] = static_cast<std::uint16_t>(sum[k] + less[k]);
    const auto value = [&](int code) {
      return value_of_log_code(static_cast<std::uint16_t>(code));
    };
    map.pixels.push_back({value(sum[0] + sum[1]), value(sum[0]), value(sum[0] + sum[2])});
  }
}

}  // namespace

std::string packed(const StoreHeader& header) {
  Json json{{"version", kPointStoreVersion},
            {"scene", header.scene},
            {"scene_sha256", header.scene_sha256},
            {"software", header.software},
            {"crs", header.crs},
            {"file_origin", json_of(header.file_origin)}};
  json["materials"] = Json::array();
  for (const StoreMaterial& m : header.materials) {
    json["materials"].push_back({{"name", m.name},
                                 {"reflectance", json_of(m.reflectance)},
                                 {"emission_lm_m2", json_of(m.emission_lm_m2)}});
  }
  json["settings"] = Json::array();
  for (const auto& [name, value] : header.settings) json["settings"].push_back({name, value});
  json["path"] = json_of(header.path);
  return deflated(text_of(json));
}

StoreHeader unpacked_header(std::string_view bytes) {
  const std::string text = inflated(bytes);
  return checked<StoreHeader>([&] {
    const Json json = Json::parse(text);
    if (const int version = json.at("version").get<int>(); version != kPointStoreVersion) {
      throw InputError("its format is of version " + std::to_string(version) +
                       ", and this program reads version " + std::to_string(kPointStoreVersion));
    }
    StoreHeader header;
    header.scene = json.at("scene").get<std::string>();
    header.scene_sha256 = json.at("scene_sha256").get<std::string>();
    header.software = json.at("software").get<std::string>();
    header.crs = json.at("crs").get<std::string>();
    header.file_origin = vec3_of(json.at("file_origin"));
    for (const Json& m : json.at("materials")) {
      header.materials.push_back({m.at("name").get<std::string>(), rgb_of(m.at("reflectance")),
                                  rgb_of(m.at("emission_lm_m2"))});
    }
    for (const Json& s : json.at("settings")) {
      header.settings.push_back({s.at(0).get<std::string>(), s.at(1).get<std::string>()});
    }
    header.path = path_of(json.at("path"));
    return header;
  });
}

std::string packed(const StoreLighting& lighting) {
  const Json json{{"time", lighting.time},
                  {"sky", lighting.sky},
                  {"sun_direction", json_of(lighting.sun_direction)},
                  {"sun_normal_lux", lighting.sun_normal_lux},
                  {"horizontal_lux", lighting.horizontal_lux},
                  {"white_cd_m2", lighting.white_cd_m2},
                  {"below_horizon", json_of(lighting.below_horizon)},
                  {"map_columns", lighting.sky_map.columns},
                  {"map_rows", lighting.sky_map.rows}};
  const std::string text = text_of(json);
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string bytes(reinterpret_cast<const char*>(&length), sizeof length);
  bytes += text;
  put_map(lighting.sky_map, bytes);
  return deflated(bytes);
}

StoreLighting unpacked_lighting(std::string_view bytes) {
  const std::string all = inflated(bytes);
  std::uint32_t length = 0;
  if (all.size() < sizeof length) throw InputError("a record of the point store is damaged");
  std::memcpy(&length, all.data(), sizeof length);
  if (length > all.size() - sizeof length) {
    throw InputError("a record of the point store is damaged");
  }
  return checked<StoreLighting>([&] {
    const Json json = Json::parse(all.substr(sizeof length, length));
    StoreLighting lighting;
    lighting.time = json.at("time").get<std::string>();
    lighting.sky = json.at("sky").get<std::string>();
    lighting.sun_direction = vec3_of(json.at("sun_direction"));
    lighting.sun_normal_lux = json.at("sun_normal_lux").get<double>();
    lighting.horizontal_lux = json.at("horizontal_lux").get<double>();
    lighting.white_cd_m2 = json.at("white_cd_m2").get<double>();
    lighting.below_horizon = rgb_of(json.at("below_horizon"));
    lighting.sky_map.columns = json.at("map_columns").get<int>();
    lighting.sky_map.rows = json.at("map_rows").get<int>();
    get_map(std::string_view(all).substr(sizeof length + length), lighting.sky_map);
    return lighting;
  });
}

}  // namespace tenku
