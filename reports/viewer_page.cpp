#include "reports/viewer_page.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/atomic_file.h"
#include "core/error.h"
#include "flythrough/page_points.h"
#include "reports/html.h"
#include "reports/viewer_files.h"
#include "view/false_colour.h"

namespace tenku {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kColours = 1024;

Json json_of(Vec3 v) { return {v.x, v.y, v.z}; }

/// Text that cannot end a script.
std::string script_text(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; ++at) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

std::string data_element(const std::string& id, std::string_view type, const std::string& text) {
  return "<script type=\"" + std::string(type) + "\" id=\"" + id + "\">" + text + "</script>\n";
}

std::string bytes_element(const std::string& id, const std::string& bytes) {
  return data_element(id, "application/octet-stream", base64(bytes));
}

Json lighting_facts(const StoreLighting& lighting) {
  const Rgb below = lighting.below_horizon;
  return {{"label", lighting.time.empty() ? lighting.sky : lighting.time},
          {"below", {below.r, below.g, below.b}},
          {"columns", std::max(1, lighting.sky_map.columns)},
          {"rows", std::max(1, lighting.sky_map.rows)}};
}

std::string sky_bytes(const SkyMap& map) {
  return page_colours(map.pixels.empty() ? std::vector<Rgb>(1) : map.pixels);
}

Json frame_facts(const CameraPath& path, std::size_t first, std::size_t count) {
  Json numbers = Json::array();
  for (std::size_t k = first; k < first + count; ++k) {
    const CameraFrame& frame = path.frames[k];
    for (const double x : {frame.eye.x, frame.eye.y, frame.eye.z, frame.target.x, frame.target.y,
                           frame.target.z, frame.horizontal_fov.in_degrees()}) {
      numbers.push_back(x);
    }
  }
  return numbers;
}

Json colour_facts() {
  Json bytes = Json::array();
  for (int k = 0; k < kColours; ++k) {
    const Rgb8 c = colour_at(ColourMap::Viridis, k / (kColours - 1.0));
    for (const int byte : {int{c.r}, int{c.g}, int{c.b}, 255}) bytes.push_back(byte);
  }
  return bytes;
}

Json facts_of(const PointStore& store, const ViewerPageOptions& options,
              const std::vector<std::size_t>& lightings) {
  const CameraPath& path = store.header().path;
  const ValueScale& scale = options.tone.scale;
  Json facts{{"width", path.width},
             {"height", path.height},
             {"fps", path.frames_per_s},
             {"exposure", options.tone.exposure},
             {"scale", {scale.low, scale.high, scale.logarithmic ? 1 : 0}},
             {"ticks", Json::array()},
             {"told", options.told},
             {"colours", colour_facts()},
             {"frames", frame_facts(path, options.first_frame, options.frames)},
             {"lightings", Json::array()}};
  for (const double tick : scale.ticks()) {
    facts["ticks"].push_back({scale.position_of(tick), number_text(tick)});
  }
  for (const std::size_t k : lightings) {
    facts["lightings"].push_back(lighting_facts(store.lightings()[k]));
  }
  return facts;
}

std::string with(std::string text, std::string_view place, const std::string& value) {
  for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += value.size()) {
    text.replace(at, place.size(), value);
  }
  return text;
}

std::string chunk_elements(const PointStore& store, std::size_t chunk,
                           const std::vector<std::size_t>& lightings) {
  const StoredPoints points = store.points(chunk);
  const PagePoints page = page_points(points);
  Json blocks = Json::array();
  for (const PageBlock& block : page.blocks) {
    blocks.push_back({{"points", block.points},
                      {"origin", json_of(block.origin)},
                      {"step", json_of(block.step)},
                      {"finest", block.finest_m}});
  }
  const std::string c = std::to_string(chunk);
  std::string text = data_element("blocks" + c, "application/json", script_text(blocks)) +
                     bytes_element("points" + c, page.bytes);
  for (std::size_t k = 0; k < lightings.size(); ++k) {
    const PointLight light = store.light(chunk, lightings[k]);
    text += bytes_element("colours" + c + "-" + std::to_string(k),
                          page_colours(shown_luminance(store.header(), points, light)));
  }
  return text;
}

}  // namespace

std::vector<std::size_t> complete_lightings(const PointStore& store, std::size_t first) {
  std::vector<std::size_t> kept{first};
  for (std::size_t k = 0; k < store.lightings().size(); ++k) {
    bool is_complete = k != first;
    for (std::size_t c = 0; c < store.chunks_done() && is_complete; ++c) {
      is_complete = store.has_light(c, k);
    }
    if (is_complete) kept.push_back(k);
  }
  return kept;
}

void write_viewer_page(const std::filesystem::path& file, const PointStore& store,
                       const ViewerPageOptions& options, Progress& progress) {
  const std::size_t chunks = playable_chunks(store, options.lighting);
  const std::vector<std::size_t> lightings = complete_lightings(store, options.lighting);
  AtomicFile aside(file);
  std::ofstream out(aside.path(), std::ios::binary);
  std::string page = with(std::string(viewer_page_text()), "@FACTS@",
                          script_text(facts_of(store, options, lightings)));
  page = with(page, "@SCRIPT@", std::string(viewer_script()));
  out << with(page, "@TITLE@", escaped(options.title));
  for (std::size_t k = 0; k < lightings.size(); ++k) {
    out << bytes_element("sky" + std::to_string(k),
                         sky_bytes(store.lightings()[lightings[k]].sky_map));
  }
  progress.begin("page", chunks);
  for (std::size_t c = 0; c < chunks && out; ++c) {
    progress.stop_if_cancelled();
    out << chunk_elements(store, c, lightings);
    progress.advance(1);
  }
  out << "</body></html>\n" << std::flush;
  if (!out) throw ResourceError(file.string() + ": cannot be written (is the disk full?)");
  out.close();
  aside.commit();
  progress.end(std::to_string(store.point_count()) + " points");
}

}  // namespace tenku
