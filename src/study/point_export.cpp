#include "study/point_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "core/atomic_file.h"
#include "core/error.h"
#include "output/field_writer.h"
#include "output/table_writer.h"
#include "view/tone_map.h"

namespace tenku {
namespace {

/// All points of a store, with what they show.
struct Cloud {
  StoredPoints points;
  PointLight light;
  std::vector<Rgb> luminance;  ///< cd/m2
};

Cloud cloud_of(const PointStore& store, std::size_t lighting) {
  Cloud cloud;
  const auto join = [](const auto& from, auto& to) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (std::size_t c = 0; c < store.chunks().size(); ++c) {
    const StoredPoints points = store.points(c);
    const PointLight light = store.light(c, lighting);
    join(points.position, cloud.points.position);
    join(points.normal, cloud.points.normal);
    join(points.footprint_m, cloud.points.footprint_m);
    join(points.object, cloud.points.object);
    join(light.sun_lux, cloud.light.sun_lux);
    join(light.sky_lux, cloud.light.sky_lux);
    join(light.reflected_lux, cloud.light.reflected_lux);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const StoreMaterial& m = store.header().materials.at(points.material[i]);
      cloud.luminance.push_back((1.0 / kPi) *
                                (light.total_lux(i) * m.reflectance + m.emission_lm_m2));
    }
  }
  return cloud;
}

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_floats(std::string& bytes, std::initializer_list<double> values) {
  for (const double v : values) put(bytes, static_cast<float>(v));
}

std::array<double, 3> shares_of_white(Rgb luminance, double white) {
  const double k = white > 0.0 ? 1.0 / white : 0.0;
  return {k * luminance.r, k * luminance.g, k * luminance.b};
}

std::string ply_bytes(const Cloud& cloud, const StoreLighting& lighting) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment east, north, up in metres; {}\n"
      "element vertex {}\n",
      lighting.time.empty() ? "no time given" : lighting.time, cloud.points.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
    bytes += fmt::format("property float {}\n", name);
  }
  for (const char* name : {"red", "green", "blue"})
    bytes += fmt::format("property uchar {}\n", name);
  for (const char* name :
       {"footprint_m", "sun_lux", "sky_lux", "reflected_lux", "luminance_cd_m2"}) {
    bytes += fmt::format("property float {}\n", name);
  }
  bytes += "end_header\n";
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3 p = cloud.points.position[i], n = cloud.points.normal[i];
    put_floats(bytes, {p.x, p.y, p.z, n.x, n.y, n.z});
    for (const double c : shares_of_white(cloud.luminance[i], lighting.white_cd_m2)) {
      put(bytes, srgb_code(c));
    }
    put_floats(bytes, {double{cloud.points.footprint_m[i]}, double{cloud.light.sun_lux[i]},
                       double{cloud.light.sky_lux[i]}, luminance_of(cloud.light.reflected_lux[i]),
                       luminance_of(cloud.luminance[i])});
  }
  return bytes;
}

/// Of glTF: points in the buffer one after another, each POSITION, NORMAL, COLOR_0.
std::string glb_bytes(const Cloud& cloud, const StoreLighting& lighting) {
  using Json = nlohmann::ordered_json;
  constexpr std::size_t kStride = 28;
  constexpr int kFloat = 5126, kByte = 5121, kArrayBuffer = 34962;
  std::string buffer;
  Extent box;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3 p = cloud.points.position[i], n = cloud.points.normal[i];
    const auto y_up = [](Vec3 v) {
      return Vec3{double{static_cast<float>(v.x)}, double{static_cast<float>(v.z)},
                  double{static_cast<float>(-v.y)}};
    };
    box.add(y_up(p));
    for (const Vec3 v : {y_up(p), y_up(n)}) put_floats(buffer, {v.x, v.y, v.z});
    for (const double c : shares_of_white(cloud.luminance[i], lighting.white_cd_m2)) {
      put(buffer, static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(c, 0.0, 1.0))));
    }
    put(buffer, std::uint8_t{255});
  }
  const std::size_t count = cloud.points.size();
  if (count == 0) throw InputError("a glTF file needs points, and the store has none");
  const auto accessor = [&](std::size_t offset, int type, const char* shape) {
    return Json{{"bufferView", 0},
                {"byteOffset", offset},
                {"componentType", type},
                {"count", count},
                {"type", shape}};
  };
  Json position = accessor(0, kFloat, "VEC3"), colour = accessor(24, kByte, "VEC4");
  position["min"] = {box.min.x, box.min.y, box.min.z};
  position["max"] = {box.max.x, box.max.y, box.max.z};
  colour["normalized"] = true;
  const Json json{{"asset", {{"version", "2.0"}, {"generator", "tenku"}}},
                  {"extensionsUsed", {"KHR_materials_unlit"}},
                  {"scene", 0},
                  {"scenes", {{{"nodes", {0}}}}},
                  {"nodes", {{{"mesh", 0}}}},
                  {"materials", {{{"extensions", {{"KHR_materials_unlit", Json::object()}}}}}},
                  {"meshes",
                   {{{"primitives",
                      {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"COLOR_0", 2}}},
                        {"material", 0},
                        {"mode", 0}}}}}}},
                  {"buffers", {{{"byteLength", buffer.size()}}}},
                  {"bufferViews",
                   {{{"buffer", 0},
                     {"byteLength", buffer.size()},
                     {"byteStride", kStride},
                     {"target", kArrayBuffer}}}},
                  {"accessors", Json::array({position, accessor(12, kFloat, "VEC3"), colour})}};
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string bytes("glTF");
  put(bytes, std::uint32_t{2});
  put(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + buffer.size()));
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += "JSON" + text;
  put(bytes, static_cast<std::uint32_t>(buffer.size()));
  bytes += std::string("BIN\0", 4) + buffer;
  return bytes;
}

template <class T, class Take>
FieldValues field(const char* name, const std::vector<T>& from, const Take& take) {
  FieldValues values{name, {}};
  for (const T& v : from) values.values.push_back(take(v));
  return values;
}

void write_field(const std::filesystem::path& path, const Cloud& cloud, const PointStore& store,
                 const StoreLighting& lighting) {
  const auto as_is = [](auto v) { return static_cast<double>(v); };
  FieldMesh mesh;
  mesh.points = cloud.points.position;
  mesh.point_values = {field("sun_lux", cloud.light.sun_lux, as_is),
                       field("sky_lux", cloud.light.sky_lux, as_is),
                       field("reflected_lux", cloud.light.reflected_lux, luminance_of),
                       field("luminance_cd_m2", cloud.luminance, luminance_of),
                       field("footprint_m", cloud.points.footprint_m, as_is),
                       field("object", cloud.points.object, as_is)};
  const Vec3 origin = store.header().file_origin;
  mesh.texts = {
      {"crs", {store.header().crs}},
      {"origin",
       {shortest_text(origin.x) + " " + shortest_text(origin.y) + " " + shortest_text(origin.z)}},
      {"time", {lighting.time}},
      {"sky", {lighting.sky}}};
  write_vtp(path, mesh);
}

}  // namespace

void check_export_ending(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".ply" || ending == ".glb" || ending == ".vtp") return;
  throw InputError("cannot export points to " + path.string() + ": .ply, .glb or .vtp is needed");
}

void export_points(const PointStore& store, std::size_t lighting,
                   const std::filesystem::path& path) {
  check_export_ending(path);
  if (lighting >= store.lightings().size()) {
    throw InputError(fmt::format("there is no lighting {}: the store has {}", lighting,
                                 store.lightings().size()));
  }
  const Cloud cloud = cloud_of(store, lighting);
  const StoreLighting& light = store.lightings()[lighting];
  const std::string ending = path.extension().string();
  if (ending == ".vtp") return write_field(path, cloud, store, light);
  write_whole_file(path, ending == ".ply" ? ply_bytes(cloud, light) : glb_bytes(cloud, light));
}

}  // namespace tenku
