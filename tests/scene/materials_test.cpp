#include <gtest/gtest.h>

#include <functional>

#include "core/error.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

const char* const kHouse =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "o house\ng front\nusemtl plaster\nf 1 2 3\ng back\nusemtl wall\nf 1 3 4\n"
    "o shed\ng front\nusemtl wall\nf 1 2 4\n";

Scene read_with(const std::string& toml) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.materials = folder.write("materials.toml", toml);
  return read(folder.write("a.obj", kHouse), options);
}

double reflectance(const Scene& scene, std::size_t surface) {
  return scene.materials[scene.surfaces.material[surface]].reflectance.r;
}

std::string refusal(const std::string& toml) {
  try {
    read_with(toml);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Materials, DefaultsFollowTheSurfaceType) {
  const Scene scene = read_with("# none\n");
  EXPECT_EQ(reflectance(scene, 0), 0.30);  // plaster tells no type
  EXPECT_EQ(reflectance(scene, 1), 0.35);
}

TEST(Materials, MostSpecificNameWins) {
  const std::string by_type = "[wall]\nreflectance = 0.11\n";
  EXPECT_EQ(reflectance(read_with(by_type), 1), 0.11);
  const std::string by_group = by_type + "[front]\nreflectance = 0.22\n";
  EXPECT_EQ(reflectance(read_with(by_group), 0), 0.22);
  const std::string by_material = by_group + "[plaster]\nreflectance = 0.33\n";
  EXPECT_EQ(reflectance(read_with(by_material), 0), 0.33);
  EXPECT_EQ(reflectance(read_with(by_material), 2), 0.11);  // material `wall` before group `front`
  const std::string by_object = by_material + "[house]\nreflectance = 0.44\n";
  EXPECT_EQ(reflectance(read_with(by_object), 0), 0.44);
  EXPECT_EQ(reflectance(read_with(by_object), 1), 0.44);
  EXPECT_EQ(reflectance(read_with(by_object), 2), 0.11);
}

// An object with a wall and a window, and one that is a window.
TEST(Materials, AnObjectsNameLeavesItsWindows) {
  const auto read_windows = [](const std::string& toml) {
    const TemporaryFolder folder;
    ReadOptions options;
    options.materials = folder.write("materials.toml", toml);
    return read(folder.write("a.obj",
                             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                             "o house\nusemtl wall\nf 1 2 3\nusemtl window\nf 1 3 4\n"
                             "usemtl pane\nf 2 3 4\no shutter\nusemtl window\nf 1 2 4\n"),
                options);
  };
  const std::string panes = "[window]\nreflectance = 0.11\n[pane]\nindex = 1.52\n";
  const Scene painted =
      read_windows(panes + "[house]\nreflectance = 0.44\n[shutter]\nreflectance = 0.55\n");
  EXPECT_EQ(reflectance(painted, 0), 0.44);
  EXPECT_EQ(reflectance(painted, 1), 0.11);
  EXPECT_TRUE(painted.materials[painted.surfaces.material[2]].is_glass());
  EXPECT_EQ(reflectance(painted, 3), 0.55);
  const Scene glazed = read_windows(panes + "[house]\ntransmittance = 0.7\n");
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_EQ(glazed.materials[glazed.surfaces.material[s]].transmittance, 0.7) << s;
  }
}

TEST(Materials, AllKeysAreRead) {
  const Scene scene = read_with(
      "[plaster]\nreflectance = [0.1, 0.2, 0.3]\nmirror = 0.9\nindex = 1.52\n"
      "emission_lm_m2 = 100\n[wall]\ntransmittance = 0.8\n");
  const Material& plaster = scene.materials[scene.surfaces.material[0]];
  EXPECT_EQ(plaster.reflectance, (Rgb{0.1, 0.2, 0.3}));
  EXPECT_EQ(plaster.mirror, 0.9);
  EXPECT_EQ(plaster.index, 1.52);
  EXPECT_EQ(plaster.emission_lm_m2, Rgb::grey(100.0));
  const Material& pane = scene.materials[scene.surfaces.material[1]];
  EXPECT_EQ(pane.transmittance, 0.8);
  EXPECT_EQ(pane.reflectance, Rgb{});  // a clear pane scatters nothing unless it is said
}

TEST(Materials, MirrorsHaveColoursAndPanesOfAnIndexTheirReflectance) {
  const Scene scene =
      read_with("[plaster]\nmirror = [0.5, 0.8, 0.9]\n[wall]\nmirror_index = 1.52\n");
  const Material& tinted = scene.materials[scene.surfaces.material[0]];
  EXPECT_NEAR(tinted.mirror, 0.2126 * 0.5 + 0.7152 * 0.8 + 0.0722 * 0.9, 1e-15);
  EXPECT_NEAR(tinted.mirror * tinted.mirror_tint.r, 0.5, 1e-15);
  EXPECT_NEAR(tinted.mirror * tinted.mirror_tint.b, 0.9, 1e-15);
  const Material& pane = scene.materials[scene.surfaces.material[1]];
  EXPECT_NEAR(pane.mirror, 0.0816820, 1e-7);  // (n - 1)^2 / (n^2 + 1): both faces, series summed
  EXPECT_EQ(pane.reflectance, Rgb{});
  EXPECT_FALSE(pane.is_glass());
}

TEST(Materials, ValuesOutOfRangeAreRefusedWithTheirPlace) {
  EXPECT_NE(refusal("[wall]\nreflectance = 1.2\n").find("line 2: wall.reflectance = 1.2"),
            std::string::npos);
  for (const char* toml :
       {"[wall]\nreflectance = 1.0", "[wall]\nreflectance = nan", "[wall]\nreflectance = -0.1",
        "[wall]\nreflectance = [0.1, 0.2]", "[wall]\nreflectance = \"white\"",
        "[wall]\nmirror = 1.1", "[wall]\nmirror = [0.5, 0.5, -0.1]", "[wall]\nmirror_index = 0.5",
        "[wall]\nindex = 0.9", "[wall]\nindex = inf", "[wall]\ntransmittance = -1",
        "[wall]\nemission_lm_m2 = -5", "wall = 0.5", "[wall",
        "[wall]\nindex = 1.5\ntransmittance = 0.8"}) {
    EXPECT_NE(refusal(toml).find("materials.toml"), std::string::npos) << toml;
  }
}

TEST(Materials, UnknownKeyIsRefusedWithASuggestion) {
  EXPECT_NE(refusal("[wall]\nreflectanse = 0.5\n").find("did you mean 'reflectance'?"),
            std::string::npos);
}

TEST(Materials, NameThatNothingBearsIsAFinding) {
  EXPECT_EQ(count_of(read_with("[plastre]\nreflectance = 0.5\n"), "unused_material"), 1U);
  EXPECT_EQ(count_of(read_with("[window]\nreflectance = 0.5\n"), "unused_material"), 0U);
}

}  // namespace
}  // namespace tenku
