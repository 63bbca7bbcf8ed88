/// Whether a scene file is refused, and how.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "tests/scene/scene_files.h"

namespace tenku {

/// Nothing, if the file was read; the message, if it was refused. Anything else fails the test.
inline std::string refusal_of(const std::filesystem::path& path) {
  try {
    const Scene scene = read(path);
    const TriangleSoup soup = flatten(scene);
    for (const auto& triangle : soup.triangles) {
      for (const std::uint32_t v : triangle) EXPECT_LT(v, soup.vertices.size()) << path;
    }
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos)
        << error.what();
    return error.what();
  }
  return "";
}

inline std::string refusal_of_text(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return refusal_of(folder.write(name, text));
}

inline std::string replaced(std::string text, const std::string& old, const std::string& with) {
  const auto at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), with);
}

}  // namespace tenku
