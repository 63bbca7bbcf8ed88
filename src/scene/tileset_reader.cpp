#include "scene/tileset_reader.h"

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/byte_cursor.h"
#include "scene/gltf_scene.h"
#include "scene/implicit_tiles.h"
#include "scene/input_file.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDeepest = 32;  // tilesets within tilesets

/// A file of triangles and where it stands.
struct Content {
  fs::path file;
  Affine frame;
};

Affine transform_of(JsonElement tile, const JsonSource& source) {
  const auto transform = JsonSource::member(tile, "transform");
  if (!transform) return {};
  const auto m = source.numbers(*transform, 16, "transform");
  return {{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}}, {m[12], m[13], m[14]}};
}

class TilesetReader {
 public:
  TilesetReader(fs::path path, Progress& progress)
      : path_(std::move(path)), progress_(progress), scene_(progress) {}

  RawScene read();

 private:
  void read_tileset(const std::string& bytes, const fs::path& file, const Affine& frame,
                    std::size_t depth);
  std::vector<Content> contents_of(JsonElement tile, const Affine& parent, bool replaces,
                                   const fs::path& folder, const JsonSource& source);
  std::vector<Content> implicit_contents(JsonElement tile, const Affine& frame, bool replaces,
                                         const fs::path& folder, const JsonSource& source);
  void add_content(const Content& content, std::size_t depth);
  void add_bytes(std::string bytes, const Content& content, std::size_t depth);
  void add_b3dm(std::string_view bytes, const Content& content);
  void add_composite(std::string_view bytes, const Content& content, std::size_t depth);
  void add_gltf(std::string bytes, const Content& content, FeatureNames names, Vec3 centre);
  void tell_missing(const std::string& what);
  void place();

  fs::path path_;
  Progress& progress_;
  GltfScene scene_;
  Affine up_ = kYUpToZUp;  ///< of the glTF files of the tileset being read
};

void TilesetReader::tell_missing(const std::string& what) {
  scene_.raw().findings.add({"missing_tile", Severity::Warning, "", what,
                             "tiles are named that are not there", "left out"});
}

/// The tile's own contents and those of the tiles under it; where these take its place, theirs
/// alone.
std::vector<Content> TilesetReader::contents_of(JsonElement tile, const Affine& parent,
                                                bool replaces, const fs::path& folder,
                                                const JsonSource& source) {
  const Affine frame = parent * transform_of(tile, source);
  const std::string refine = source.text(tile, "refine");
  if (!refine.empty()) replaces = refine != "ADD" && refine != "add";
  if (JsonSource::member(tile, "implicitTiling")) {
    return implicit_contents(tile, frame, replaces, folder, source);
  }
  std::vector<Content> finer;
  for (const JsonElement child : source.list(tile, "children")) {
    for (Content& content : contents_of(child, frame, replaces, folder, source)) {
      finer.push_back(std::move(content));
    }
  }
  if (replaces && !finer.empty()) return finer;
  std::vector<JsonElement> own = source.list(tile, "contents");
  if (const auto one = JsonSource::member(tile, "content")) own.push_back(*one);
  for (const JsonElement content : own) {
    std::string uri = source.text(content, "uri");
    if (uri.empty()) uri = source.text(content, "url");  // before 1.0
    if (uri.empty()) source.refuse("a tile has a content without 'uri'");
    finer.push_back({folder / uri, frame});
  }
  return finer;
}

std::vector<Content> TilesetReader::implicit_contents(JsonElement tile, const Affine& frame,
                                                      bool replaces, const fs::path& folder,
                                                      const JsonSource& source) {
  const auto content = JsonSource::member(tile, "content");
  const std::string uri = content ? source.text(*content, "uri") : "";
  if (uri.empty()) source.refuse("an implicit tile has no 'uri' of its content");
  ImplicitTiles tiles = implicit_tiles(*JsonSource::member(tile, "implicitTiling"), folder, source);
  for (const std::string& missing : tiles.missing) tell_missing(missing);
  if (replaces) tiles.with_content = finest(tiles.with_content);
  std::vector<Content> contents;
  for (const TileAddress& address : tiles.with_content) {
    contents.push_back({folder / uri_of(uri, address), frame});
  }
  return contents;
}

void TilesetReader::read_tileset(const std::string& bytes, const fs::path& file,
                                 const Affine& frame, std::size_t depth) {
  const JsonSource source(file.string());
  if (depth > kDeepest) source.refuse("tilesets name each other without end");
  simdjson::dom::parser parser;
  const JsonElement json = parse_json(parser, bytes, source);
  const auto asset = JsonSource::member(json, "asset"), root = JsonSource::member(json, "root");
  if (!asset || !root) source.refuse("this is not 3D Tiles: 'asset' or 'root' is missing");
  if (depth == 0) scene_.raw().scene.format = "3D Tiles " + source.text(*asset, "version");
  const Affine former = up_;
  const std::string up = source.text(*asset, "gltfUpAxis");
  up_ = up == "Z" || up == "z" ? Affine{} : kYUpToZUp;
  for (const Content& content : contents_of(*root, frame, true, file.parent_path(), source)) {
    add_content(content, depth);
  }
  up_ = former;
}

void TilesetReader::add_content(const Content& content, std::size_t depth) {
  progress_.stop_if_cancelled();
  std::error_code error;
  if (!fs::is_regular_file(content.file, error)) return tell_missing(content.file.string());
  add_bytes(read_input_file(content.file), content, depth);
}

void TilesetReader::add_bytes(std::string bytes, const Content& content, std::size_t depth) {
  const std::string_view kind = std::string_view(bytes).substr(0, 4);
  if (kind == "b3dm") return add_b3dm(bytes, content);
  if (kind == "cmpt") return add_composite(bytes, content, depth);
  if (kind == "i3dm" || kind == "pnts") {
    scene_.raw().findings.add({"ignored_tile", Severity::Warning, "", content.file.string(),
                               "tiles of points and of repeated models are not read", "left out"});
    return;
  }
  const std::string_view head = std::string_view(bytes).substr(0, 65536);
  if (kind != "glTF" && head.find("\"geometricError\"") != std::string_view::npos) {
    return read_tileset(bytes, content.file, content.frame, depth + 1);
  }
  add_gltf(std::move(bytes), content, {}, {});
}

void TilesetReader::add_composite(std::string_view bytes, const Content& content,
                                  std::size_t depth) {
  const JsonSource source(content.file.string());
  if (depth > kDeepest) source.refuse("tiles hold each other without end");
  ByteCursor header(bytes);
  header.skip(12);
  const auto count = header.next<std::uint32_t>();
  if (!count) source.refuse("the tile is cut off");
  std::string_view left = header.rest();
  for (std::uint32_t k = 0; k < *count; ++k) {
    ByteCursor inner(left);
    inner.skip(8);
    const auto size = inner.next<std::uint32_t>();
    if (!size || *size < 12 || *size > left.size()) source.refuse("the tile is cut off");
    add_bytes(std::string(left.substr(0, *size)), content, depth + 1);
    left.remove_prefix(*size);
  }
}

/// Names of features out of a batch table.
std::vector<std::string> names_in(JsonElement table, const JsonSource& source) {
  for (const char* key : {"gml_id", "gml:id", "id", "building_id", "name", "ID"}) {
    const auto column = JsonSource::member(table, key);
    if (!column || !column->is_array()) continue;
    std::vector<std::string> names;
    for (const JsonElement item : source.items(*column, key)) {
      std::string_view text;
      names.emplace_back(item.get(text) == simdjson::SUCCESS ? std::string(text)
                                                             : simdjson::minify(item));
    }
    return names;
  }
  return {};
}

void TilesetReader::add_b3dm(std::string_view bytes, const Content& content) {
  const JsonSource source(content.file.string());
  ByteCursor cursor(bytes);
  cursor.skip(8);
  const auto length = cursor.next<std::uint32_t>();
  std::array<std::size_t, 4> sizes{};  // JSON and binary of the feature table and the batch table
  std::size_t sum = 28;
  for (std::size_t& size : sizes) {
    const auto next = cursor.next<std::uint32_t>();
    if (!next) source.refuse("the tile is cut off");
    size = *next;
    sum += size;
  }
  if (!length || *length > bytes.size() || sum > *length) source.refuse("the tile is cut off");
  std::string_view left = bytes.substr(28, *length - 28);
  const std::string_view features = left.substr(0, sizes[0]);
  const std::string_view batch = left.substr(sizes[0] + sizes[1], sizes[2]);
  Vec3 centre{};
  FeatureNames names{.are_given = true, .names = {}, .tile = content.file.stem().string()};
  simdjson::dom::parser parser;
  if (!features.empty()) {
    const JsonElement table = parse_json(parser, features, source);
    const auto rtc = JsonSource::member(table, "RTC_CENTER");
    if (rtc) centre = source.point(*rtc, "RTC_CENTER");
  }
  if (!batch.empty()) names.names = names_in(parse_json(parser, batch, source), source);
  left.remove_prefix(sum - 28);
  add_gltf(std::string(left), content, std::move(names), centre);
}

void TilesetReader::add_gltf(std::string bytes, const Content& content, FeatureNames names,
                             Vec3 centre) {
  GltfDocument document(std::move(bytes), content.file.string(), content.file.parent_path());
  if (!names.are_given) {
    names.names = feature_ids(document);
    names.are_given = true;
    names.tile = content.file.stem().string();
  }
  const Vec3 about = centre + rtc_centre(document);
  scene_.add(document, content.frame * Affine::moved(about) * up_, std::move(names));
}

/// Coordinates about the centre of the Earth become those of a map; others are local already.
void TilesetReader::place() {
  RawScene& raw = scene_.raw();
  std::vector<Vec3>& vertices = raw.scene.vertices;
  constexpr double kLeast_m = 6.3e6, kMost_m = 6.45e6;
  const auto on_earth = [&](Vec3 p) { return length(p) > kLeast_m && length(p) < kMost_m; };
  const auto count =
      static_cast<std::size_t>(std::count_if(vertices.begin(), vertices.end(), on_earth));
  if (2 * count <= vertices.size()) return;
  const GeographicLib::Geocentric& earth = GeographicLib::Geocentric::WGS84();
  for (Vec3& p : vertices) {
    double latitude = 0.0, longitude = 0.0, height = 0.0;
    earth.Reverse(p.x, p.y, p.z, latitude, longitude, height);
    p = {longitude, latitude, height};
  }
  raw.crs = "EPSG:4979";
}

RawScene TilesetReader::read() {
  std::string bytes = read_input_file(path_);
  if (bytes.starts_with("b3dm") || bytes.starts_with("cmpt")) {
    scene_.raw().scene.format = "3D Tiles 1.0";
    add_bytes(std::move(bytes), {path_, {}}, 0);
  } else {
    read_tileset(bytes, path_, {}, 0);
  }
  place();
  return std::move(scene_.raw());
}

}  // namespace

RawScene read_tileset(const fs::path& path, Progress& progress) {
  return TilesetReader(path, progress).read();
}

}  // namespace tenku
