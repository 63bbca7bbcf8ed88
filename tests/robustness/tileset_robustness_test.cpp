// Broken and hostile 3D Tiles: read, or refused with the file that is wrong.
#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/robustness/refusal.h"
#include "tests/scene/tile_texts.h"

namespace tenku {
namespace {

const std::string kBatched =
    b3dm(batched_glb(), R"({"BATCH_LENGTH":2,"RTC_CENTER":[1,2,3]})", R"({"gml_id":["a","b"]})");

const std::string kTileset =
    R"({"asset":{"version":"1.1"},"geometricError":1,"root":{"geometricError":1,"refine":"ADD",)"
    R"("transform":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"children":[{"content":{"uri":"box.glb"}},)"
    R"({"content":{"uri":"{level}_{x}_{y}.glb"},"implicitTiling":{"subdivisionScheme":"QUADTREE",)"
    R"("subtreeLevels":2,"availableLevels":2,"subtrees":{"uri":"{level}.{x}.{y}.subtree"}}}]}})";

const std::string kSubtree =
    subtree(R"({"buffers":[{"byteLength":1}],"bufferViews":[{"buffer":0,"byteLength":1}],)"
            R"("tileAvailability":{"constant":1},"contentAvailability":[{"bitstream":0}],)"
            R"("childSubtreeAvailability":{"constant":0}})",
            "\x01");

/// Reads a tileset with its tiles beside it. True if it was read.
bool is_read(const TemporaryFolder& folder, const std::string& tileset,
             const std::string& subtree) {
  folder.write("tileset.json", tileset);
  folder.write("0.0.0.subtree", subtree);
  try {
    flatten(read(folder.path() / "tileset.json"));
    return true;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(folder.path().string()), std::string::npos)
        << error.what();
    return false;
  }
}

TEST(TilesetRobustness, WholeFilesAreReadAndCutOnesRefused) {
  EXPECT_EQ(refusal_of_text("a.b3dm", kBatched), "");
  for (std::size_t length = 0; length < kBatched.size(); length += 7) {
    EXPECT_NE(refusal_of_text("a.b3dm", kBatched.substr(0, length)), "") << length;
  }
  const TemporaryFolder folder;
  folder.write("box.glb", glb());
  folder.write("0_0_0.glb", glb());
  EXPECT_TRUE(is_read(folder, kTileset, kSubtree));
  for (std::size_t length = 0; length < kTileset.size(); length += 5) {
    EXPECT_FALSE(is_read(folder, kTileset.substr(0, length), kSubtree)) << length;
  }
  for (std::size_t length = 0; length < kSubtree.size() - 7; length += 3) {
    EXPECT_FALSE(is_read(folder, kTileset, kSubtree.substr(0, length))) << length;
  }
}

TEST(TilesetRobustness, WrongValuesAreRefused) {
  const TemporaryFolder folder;
  folder.write("box.glb", glb());
  folder.write("0_0_0.glb", glb());
  for (const auto& [old, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {R"("root")", R"("roof")"},
           {R"("transform":[1,)", R"("transform":[)"},
           {R"("transform":[1,)", R"("transform":[1e308,)"},
           {R"("uri":"box.glb")", R"("uri":7)"},
           {R"("children":[)", R"("children":7,"x":[)"},
           {"QUADTREE", "TREE"},
           {R"("subtreeLevels":2)", R"("subtreeLevels":0)"},
           {R"("subtreeLevels":2)", R"("subtreeLevels":40)"},
           {R"("subtreeLevels":2)", R"("subtreeLevels":5)"},  // the bits are too few
           {R"("availableLevels":2)", R"("availableLevels":1000000000)"}}) {
    EXPECT_FALSE(is_read(folder, replaced(kTileset, old, with), kSubtree)) << with;
  }
  for (const auto& [old, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {R"("bitstream":0)", R"("bitstream":1)"},
           {R"("byteLength":1})", R"("byteLength":9})"},
           {R"("buffer":0,"byteLength":1)", R"("buffer":0,"byteLength":0)"}}) {
    std::string wrong = kSubtree.substr(24);
    wrong = subtree(replaced(wrong.substr(0, wrong.rfind('}') + 1), old, with), "\x01");
    EXPECT_EQ(is_read(folder, kTileset, wrong), std::string(with) == R"("byteLength":9})") << with;
  }
}

// Subtrees that all are the same file and say that there are more under them.
TEST(TilesetRobustness, TreesWithoutEndAreRefused) {
  const TemporaryFolder folder;
  folder.write("box.glb", glb());
  std::string tiles = replaced(kTileset, "{level}.{x}.{y}.subtree", "0.0.0.subtree");
  tiles = replaced(tiles, R"("availableLevels":2)", R"("availableLevels":30)");
  const std::string endless =
      subtree(R"({"tileAvailability":{"constant":1},"contentAvailability":[{"constant":0}],)"
              R"("childSubtreeAvailability":{"constant":1}})",
              "");
  EXPECT_FALSE(is_read(folder, tiles, endless));
}

TEST(TilesetRobustness, EachByteMayBeWrong) {
  for (std::size_t i = 0; i < kBatched.size(); i += 2) {
    for (const char c : {'0', '"', '\xff'}) {
      std::string broken = kBatched;
      broken[i] = c;
      refusal_of_text("a.b3dm", broken);
    }
  }
  const TemporaryFolder folder;
  folder.write("box.glb", glb());
  folder.write("0_0_0.glb", glb());
  for (std::size_t i = 0; i < kTileset.size(); ++i) {
    std::string broken = kTileset;
    broken[i] = '0';
    is_read(folder, broken, kSubtree);
  }
  for (std::size_t i = 0; i < kSubtree.size(); ++i) {
    std::string broken = kSubtree;
    broken[i] = '\xff';
    is_read(folder, kTileset, broken);
  }
}

}  // namespace
}  // namespace tenku
