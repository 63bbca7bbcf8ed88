#include <array>
#include <string_view>

#include "scene/byte_cursor.h"
#include "scene/gltf_scene.h"

namespace tenku {
namespace {

/// Names under which publishers keep the ids of buildings.
constexpr std::array<std::string_view, 8> kIdProperties{
    "gml_id", "gml:id", "id", "identificatie", "building_id", "buildingID", "name", "ID"};

std::vector<std::string> texts_of(GltfDocument& document, JsonElement property, std::size_t count) {
  const JsonSource& source = document.source();
  const std::string_view values = document.view(source.whole(property, "values"));
  ByteCursor offsets(document.view(source.whole(property, "stringOffsets")));
  const std::string type = source.text(property, "stringOffsetType");
  const auto next = [&]() -> std::optional<std::uint64_t> {
    if (type == "UINT8") return offsets.next<std::uint8_t>();
    if (type == "UINT16") return offsets.next<std::uint16_t>();
    if (type == "UINT64") return offsets.next<std::uint64_t>();
    return offsets.next<std::uint32_t>();
  };
  std::vector<std::string> texts;
  auto begin = next();
  for (std::size_t k = 0; k < count; ++k) {
    const auto end = next();
    if (!begin || !end || *end < *begin || *end > values.size()) {
      source.refuse("the table of properties is damaged");
    }
    texts.emplace_back(values.substr(*begin, *end - *begin));
    begin = end;
  }
  return texts;
}

}  // namespace

Vec3 rtc_centre(const GltfDocument& document) {
  const auto extensions = JsonSource::member(document.json(), "extensions");
  const auto rtc = extensions ? JsonSource::member(*extensions, "CESIUM_RTC") : std::nullopt;
  const auto centre = rtc ? JsonSource::member(*rtc, "center") : std::nullopt;
  return centre ? document.source().point(*centre, "center") : Vec3{};
}

std::vector<std::string> feature_ids(GltfDocument& document) {
  const JsonSource& source = document.source();
  const auto extensions = JsonSource::member(document.json(), "extensions");
  const auto metadata =
      extensions ? JsonSource::member(*extensions, "EXT_structural_metadata") : std::nullopt;
  if (!metadata) return {};
  for (const JsonElement table : source.list(*metadata, "propertyTables")) {
    const auto properties = JsonSource::member(table, "properties");
    if (!properties) continue;
    for (const std::string_view name : kIdProperties) {
      const auto property = JsonSource::member(*properties, name);
      if (!property || !JsonSource::member(*property, "stringOffsets")) continue;
      return texts_of(document, *property, source.whole(table, "count"));
    }
  }
  return {};
}

}  // namespace tenku
