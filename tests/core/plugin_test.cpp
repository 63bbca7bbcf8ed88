#include "core/plugin.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/version.h"

namespace tenku {
namespace {

std::string refusal(std::string_view name) {
  try {
    load_plugin(name);
  } catch (const ResourceError& error) {
    return error.what();
  }
  return {};
}

std::string file_of(const std::string& name) {
  const std::string software(software_name());  // "tenku 0.1.0"
  return name + "-" + software.substr(software.find(' ') + 1) + ".so";
}

TEST(Plugin, AMissingOneIsNamedWithTheFoldersSearched) {
  ASSERT_EQ(setenv("TENKU_PLUGINS", "/a/folder/of/mine", 1), 0);
  const std::string text = refusal("nothing");
  unsetenv("TENKU_PLUGINS");
  EXPECT_NE(text.find(file_of("nothing")), std::string::npos) << text;
  EXPECT_NE(text.find("/a/folder/of/mine"), std::string::npos) << text;
  EXPECT_NE(text.find("lib/tenku"), std::string::npos) << text;
}

TEST(Plugin, ABrokenOneIsNamedWithTheReason) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "tenku_plugin_broken";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / file_of("broken")) << std::string(4096, 'x');
  ASSERT_EQ(setenv("TENKU_PLUGINS", folder.c_str(), 1), 0);
  const std::string text = refusal("broken");
  unsetenv("TENKU_PLUGINS");
  EXPECT_NE(text.find((folder / file_of("broken")).string()), std::string::npos) << text;
  EXPECT_NE(text.find("ELF"), std::string::npos) << text;  // the loader's own words
  std::filesystem::remove_all(folder);
}

// A library that is no plug-in of ours: that of the C mathematics functions.
TEST(Plugin, OneWithoutTheEntryIsRefused) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "tenku_plugin_foreign";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find("/libm.so") == std::string::npos) continue;
    std::filesystem::create_symlink(line.substr(line.find('/')), folder / file_of("foreign"));
    break;
  }
  if (!std::filesystem::exists(folder / file_of("foreign"))) GTEST_SKIP() << "no libm.so in use";
  ASSERT_EQ(setenv("TENKU_PLUGINS", folder.c_str(), 1), 0);
  const std::string text = refusal("foreign");
  unsetenv("TENKU_PLUGINS");
  EXPECT_NE(text.find("tenku_plugin"), std::string::npos) << text;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace tenku
