#include <algorithm>
#include <optional>
#include <string>

#include "scene/obj_reader.h"
#include "scene/text_cursor.h"

namespace tenku {
namespace {

// No surface reflects more in practice, fresh snow and barium sulphate aside.
constexpr double kMostReflectance = 0.9;

/// Nothing if the colour is given as a spectrum or as CIE XYZ.
std::optional<Rgb> read_reflectance(TextCursor& cursor, const std::string& file,
                                    const std::string& material, RawScene& raw) {
  const std::string_view first = cursor.word();
  if (first == "spectral" || first == "xyz") return std::nullopt;
  const std::optional<double> red = finite_number(first);
  if (!red) cursor.refuse("Kd should be three numbers");
  Rgb kd = Rgb::grey(*red);
  if (!cursor.line_is_done()) kd.g = cursor.number();
  if (!cursor.line_is_done()) kd.b = cursor.number();
  const Rgb clamped{std::clamp(kd.r, 0.0, kMostReflectance),
                    std::clamp(kd.g, 0.0, kMostReflectance),
                    std::clamp(kd.b, 0.0, kMostReflectance)};
  if (!(clamped == kd)) {
    raw.findings.add({"reflectance_clamped", Severity::Note, "",
                      file + ", line " + std::to_string(cursor.line()),
                      "Kd of material '" + material + "' is outside 0 to 0.9",
                      "brought into that range; --materials can say better"});
  }
  return clamped;
}

}  // namespace

void read_mtl(std::string_view text, const std::string& file, RawScene& raw) {
  TextCursor cursor(text, file);
  RawScene::FileMaterial* current = nullptr;
  for (; !cursor.at_end(); cursor.next_line()) {
    const std::string_view keyword = cursor.word();
    if (keyword == "newmtl") {
      raw.file_materials.emplace_back();
      current = &raw.file_materials.back();
      current->material.name = cursor.rest();
    } else if (current == nullptr) {
      continue;
    } else if (keyword == "Kd") {
      const auto kd = read_reflectance(cursor, file, current->material.name, raw);
      if (!kd) continue;
      current->material.reflectance = *kd;
      current->given = true;
    } else if (keyword.starts_with("map_Kd")) {
      raw.findings.add({"texture_ignored", Severity::Note, "", file, "textures are not read",
                        "the plain reflectance is used"});
    }
  }
}

}  // namespace tenku
