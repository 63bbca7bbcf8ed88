#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "scene/obj_reader.h"

namespace tenku {
namespace {

struct NameRow {
  std::string_view word;
  SurfaceType type;
};

constexpr std::array<NameRow, 24> kWords{{
    {"ground", SurfaceType::Ground},   {"terrain", SurfaceType::Ground},
    {"wall", SurfaceType::Wall},       {"walls", SurfaceType::Wall},
    {"facade", SurfaceType::Wall},     {"roof", SurfaceType::Roof},
    {"roofs", SurfaceType::Roof},      {"ceil", SurfaceType::Ceiling},
    {"ceiling", SurfaceType::Ceiling}, {"ceilings", SurfaceType::Ceiling},
    {"floor", SurfaceType::Floor},     {"floors", SurfaceType::Floor},
    {"window", SurfaceType::Window},   {"windows", SurfaceType::Window},
    {"glass", SurfaceType::Window},    {"glazing", SurfaceType::Window},
    {"door", SurfaceType::Door},       {"doors", SurfaceType::Door},
    {"road", SurfaceType::Road},       {"street", SurfaceType::Road},
    {"water", SurfaceType::Water},     {"vegetation", SurfaceType::Vegetation},
    {"tree", SurfaceType::Vegetation}, {"trees", SurfaceType::Vegetation},
}};

SurfaceType type_of_word(const std::string& word) {
  for (const NameRow& row : kWords) {
    if (row.word == word) return row.type;
  }
  return SurfaceType::Unknown;
}

}  // namespace

SurfaceType type_by_name(std::string_view name) {
  std::string word;
  for (std::size_t i = 0; i <= name.size(); ++i) {
    const auto c = static_cast<unsigned char>(i < name.size() ? name[i] : ' ');
    if (std::isalpha(c) != 0) {
      // A capital after a small letter begins a word: `backWall`.
      const bool begins = std::isupper(c) != 0 && i > 0 &&
                          std::islower(static_cast<unsigned char>(name[i - 1])) != 0;
      if (begins && type_of_word(word) != SurfaceType::Unknown) return type_of_word(word);
      if (begins) word.clear();
      word += static_cast<char>(std::tolower(c));
      continue;
    }
    if (type_of_word(word) != SurfaceType::Unknown) return type_of_word(word);
    word.clear();
  }
  return SurfaceType::Unknown;
}

}  // namespace tenku
