#include "cli/store_inspection.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "flythrough/point_store.h"

namespace tenku {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

Extent extent_of(const PointStore& store) {
  Extent box;
  for (const ChunkInfo& chunk : store.chunks())
    box.add(chunk.extent.min), box.add(chunk.extent.max);
  return box;
}

double bytes_a_point(const PointStore& store) {
  const std::size_t points = store.point_count();
  return points > 0 ? static_cast<double>(store.bytes()) / static_cast<double>(points) : 0.0;
}

Json json_of(const PointStore& store) {
  const StoreHeader& header = store.header();
  const Extent box = extent_of(store);
  Json out{{"format", "tkpts"},
           {"version", kPointStoreVersion},
           {"complete", store.is_complete()},
           {"scene", header.scene},
           {"scene_sha256", header.scene_sha256},
           {"software", header.software},
           {"crs", header.crs.empty() ? Json(nullptr) : Json(header.crs)},
           {"file_origin", json_of(header.file_origin)},
           {"points", store.point_count()},
           {"chunks", store.chunks().size()},
           {"bytes", store.bytes()},
           {"torn_bytes", store.torn_bytes()},
           {"bytes_a_point", bytes_a_point(store)},
           {"extent", store.chunks().empty()
                          ? Json(nullptr)
                          : Json{{"min", json_of(box.min)}, {"max", json_of(box.max)}}}};
  const CameraPath& path = header.path;
  out["path"] = {{"frames", path.size()},
                 {"frames_done", store.frames_done()},
                 {"frames_per_s", path.frames_per_s},
                 {"width", path.width},
                 {"height", path.height},
                 {"length_m", path.length_m()}};
  out["lightings"] = Json::array();
  for (const StoreLighting& l : store.lightings()) {
    out["lightings"].push_back({{"time", l.time},
                                {"sky", l.sky},
                                {"sun_direction", json_of(l.sun_direction)},
                                {"sun_normal_lux", l.sun_normal_lux},
                                {"horizontal_lux", l.horizontal_lux}});
  }
  out["settings"] = Json::object();
  for (const auto& [name, value] : header.settings) out["settings"][name] = value;
  return out;
}

void print_text(const PointStore& store) {
  const StoreHeader& header = store.header();
  const CameraPath& path = header.path;
  fmt::print("format      point store, version {}{}\n", kPointStoreVersion,
             store.is_complete() ? "" : ", not complete");
  fmt::print("scene       {} (SHA-256 {}), by {}\n", header.scene,
             header.scene_sha256.substr(0, 12), header.software);
  if (!header.crs.empty()) fmt::print("crs         {}\n", header.crs);
  fmt::print("path        {} frames of {}x{} at {:g} a second, {:.1f} m; {} done\n", path.size(),
             path.width, path.height, path.frames_per_s, path.length_m(), store.frames_done());
  fmt::print("points      {} in {} chunks, {:.1f} bytes a point\n", store.point_count(),
             store.chunks().size(), bytes_a_point(store));
  if (store.torn_bytes() > 0) fmt::print("cut off     {} bytes are lost\n", store.torn_bytes());
  for (const StoreLighting& l : store.lightings()) {
    fmt::print("lighting    {}{}{}\n", l.time, l.time.empty() ? "" : ", ", l.sky);
  }
  for (const auto& [name, value] : header.settings) {
    if (!value.empty()) fmt::print("setting     {} = {}\n", name, value);
  }
}

}  // namespace

bool is_store_name(const std::string& file) {
  return file.ends_with(".tkpts") || file.ends_with(".tkpts.part");
}

int inspect_store(const std::string& file, const CommonOptions& options) {
  const PointStore store(file);
  if (options.json) {
    fmt::print("{}\n", json_of(store).dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_text(store);
  }
  return kDone;
}

}  // namespace tenku
