#include "scene/implicit_tiles.h"

#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "scene/byte_cursor.h"
#include "scene/input_file.h"

namespace tenku {
namespace {

constexpr std::size_t kMostTiles = 10'000'000;
constexpr std::size_t kMostLevels = 30;
constexpr std::size_t kTilesPerFile = 500;  // to read a subtree takes as long as so many tiles

/// One bit a tile, or the same for all.
struct Availability {
  std::string_view bits;
  bool constant = false, is_constant = true;

  bool at(std::size_t index) const {
    if (is_constant) return constant;
    return (static_cast<unsigned char>(bits[index / 8]) >> (index % 8) & 1U) != 0;
  }
};

/// A subtree file: JSON, and bits in its own binary part or in files beside it.
class Subtree {
 public:
  Subtree(std::string bytes, const std::string& name, std::filesystem::path folder)
      : source_(name), folder_(std::move(folder)), bytes_(std::move(bytes)) {
    std::string_view text = bytes_;
    if (text.starts_with("subt")) {
      ByteCursor cursor(text);
      cursor.skip(8);
      const auto json = cursor.next<std::uint64_t>(), binary = cursor.next<std::uint64_t>();
      if (!json || !binary || *json > cursor.left() || *binary > cursor.left() - *json) {
        source_.refuse("the subtree is cut off");
      }
      binary_ = cursor.rest().substr(*json, *binary);
      text = cursor.rest().substr(0, *json);
    }
    json_ = parse_json(parser_, text, source_);
  }

  const JsonSource& source() const { return source_; }

  /// @param count  how many bits there must be
  Availability availability(const char* name, std::size_t count) {
    auto found = JsonSource::member(json_, name);
    if (found && found->is_array()) {
      const auto contents = source_.items(*found, name);
      found = contents.empty() ? std::nullopt : std::optional(contents[0]);
    }
    Availability available;
    if (!found) return available;
    // 1.1, and the older draft of the same
    for (const char* key : {"bitstream", "bufferView"}) {
      const auto view = source_.whole_if_given(*found, key);
      if (!view) continue;
      available.bits = view_of(*view);
      available.is_constant = false;
      if (available.bits.size() < (count + 7) / 8) source_.refuse("a bitstream is too short");
      return available;
    }
    available.constant = source_.whole_if_given(*found, "constant").value_or(0) != 0;
    return available;
  }

 private:
  std::string_view view_of(std::size_t index) {
    const auto views = source_.list(json_, "bufferViews"), buffers = source_.list(json_, "buffers");
    if (index >= views.size()) source_.refuse("a buffer view of the subtree is not there");
    const std::size_t buffer = source_.whole(views[index], "buffer");
    if (buffer >= buffers.size()) source_.refuse("a buffer of the subtree is not there");
    std::string_view bytes = binary_;
    if (const std::string uri = source_.text(buffers[buffer], "uri"); !uri.empty()) {
      loaded_.push_back(read_input_file(folder_ / uri));
      bytes = loaded_.back();
    }
    const std::size_t offset = source_.whole_if_given(views[index], "byteOffset").value_or(0);
    const std::size_t length = source_.whole(views[index], "byteLength");
    if (offset > bytes.size() || length > bytes.size() - offset) {
      source_.refuse("a buffer view reaches out of the subtree");
    }
    return bytes.substr(offset, length);
  }

  JsonSource source_;
  std::filesystem::path folder_;
  simdjson::dom::parser parser_;
  std::string bytes_;
  std::string_view binary_;
  JsonElement json_;
  std::vector<std::string> loaded_ = [] {
    std::vector<std::string> buffers;
    buffers.reserve(8);  // views point into them
    return buffers;
  }();
};

/// The tile at a Morton index `levels` below another.
TileAddress below(const TileAddress& top, std::size_t levels, std::size_t morton, int dimensions) {
  TileAddress tile{top[0] + levels, top[1] << levels, top[2] << levels,
                   dimensions == 3 ? top[3] << levels : 0};
  for (std::size_t bit = 0; bit < levels; ++bit) {
    for (int d = 0; d < dimensions; ++d) {
      const std::size_t from =
          bit * static_cast<std::size_t>(dimensions) + static_cast<std::size_t>(d);
      tile[1 + static_cast<std::size_t>(d)] |= (morton >> from & 1U) << bit;
    }
  }
  return tile;
}

}  // namespace

std::string uri_of(std::string text, const TileAddress& address) {
  constexpr std::array<std::string_view, 4> kNames{"{level}", "{x}", "{y}", "{z}"};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const std::string value = std::to_string(address[k]);
    for (auto at = text.find(kNames[k]); at != std::string::npos; at = text.find(kNames[k], at)) {
      text.replace(at, kNames[k].size(), value);
    }
  }
  return text;
}

ImplicitTiles implicit_tiles(JsonElement tiling, const std::filesystem::path& folder,
                             const JsonSource& source) {
  const std::string scheme = source.text(tiling, "subdivisionScheme");
  if (scheme != "QUADTREE" && scheme != "OCTREE") {
    source.refuse("the subdivision scheme '" + scheme + "' is not QUADTREE or OCTREE");
  }
  const int dimensions = scheme == "OCTREE" ? 3 : 2;
  const std::size_t branches = dimensions == 3 ? 8 : 4;
  const std::size_t levels = source.whole(tiling, "subtreeLevels");
  const auto subtrees = JsonSource::member(tiling, "subtrees");
  const std::string uri = subtrees ? source.text(*subtrees, "uri") : "";
  std::size_t available = source.whole_if_given(tiling, "availableLevels").value_or(0);
  if (available == 0) available = source.whole_if_given(tiling, "maximumLevel").value_or(0) + 1;
  if (uri.empty() || levels == 0 || levels > 11 || available > kMostLevels) {
    source.refuse("'implicitTiling' has no subtrees, or levels beyond all measure");
  }
  std::size_t inside = 0, width = 1;  // tiles of a subtree, and of the level under it
  for (std::size_t k = 0; k < levels; ++k) inside += width, width *= branches;
  ImplicitTiles tiles;
  std::vector<TileAddress> open{{0, 0, 0, 0}};
  std::size_t looked_at = 0;
  while (!open.empty()) {
    const TileAddress top = open.back();
    open.pop_back();
    looked_at += inside + width + kTilesPerFile;
    if (looked_at > kMostTiles) source.refuse("implicit tiles are more than 10 million");
    const std::filesystem::path file = folder / uri_of(uri, top);
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
      tiles.missing.push_back(uri_of(uri, top));
      continue;
    }
    Subtree subtree(read_input_file(file), file.string(), file.parent_path());
    const Availability contents = subtree.availability("contentAvailability", inside);
    const Availability children = subtree.availability("childSubtreeAvailability", width);
    std::size_t first = 0, count = 1;
    for (std::size_t level = 0; level < levels; ++level) {
      for (std::size_t m = 0; m < count && top[0] + level < available; ++m) {
        if (contents.at(first + m)) tiles.with_content.push_back(below(top, level, m, dimensions));
      }
      first += count;
      count *= branches;
    }
    for (std::size_t m = 0; m < width && top[0] + levels < available; ++m) {
      if (children.at(m)) open.push_back(below(top, levels, m, dimensions));
    }
  }
  return tiles;
}

std::vector<TileAddress> finest(const std::vector<TileAddress>& tiles) {
  std::set<TileAddress> coarser;
  for (TileAddress tile : tiles) {
    while (tile[0] > 0) {
      tile = {tile[0] - 1, tile[1] >> 1U, tile[2] >> 1U, tile[3] >> 1U};
      if (!coarser.insert(tile).second) break;
    }
  }
  std::vector<TileAddress> result;
  for (const TileAddress& tile : tiles) {
    if (!coarser.contains(tile)) result.push_back(tile);
  }
  return result;
}

}  // namespace tenku
