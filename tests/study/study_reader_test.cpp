#include "study/study_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "core/error.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

class StudyReader : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("tenku_study_") + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& text) const {
    const fs::path path = folder_ / "study.toml";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  Study read(const std::string& text, const StudyOverrides& overrides = {}) const {
    return read_study(write(text), overrides);
  }
  /// The message with which `text` is refused, without the folder; or nothing.
  std::string refusal(const std::string& text, const StudyOverrides& overrides = {}) const {
    try {
      read(text, overrides);
    } catch (const InputError& error) {
      std::string message = error.what();
      const std::string prefix = folder_.string() + "/";
      return message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message;
    }
    return "";
  }

  fs::path folder_;
};

const std::string kLeast = "[scene]\nfile = \"a.obj\"\n[time]\nat = \"2026-06-21T10:00+09:00\"\n";

TEST_F(StudyReader, LeavesTheDefaultsThatTheDocumentationGives) {
  const Study study = read(kLeast);
  EXPECT_EQ(study.scene.file, folder_ / "a.obj");
  EXPECT_EQ(study.scene.building_lod, "");
  EXPECT_EQ(study.scene.ground, "auto");
  EXPECT_EQ(study.scene.scale, 1.0);
  EXPECT_FALSE(study.scene.site);
  EXPECT_EQ(study.time.at, "2026-06-21T10:00+09:00");
  EXPECT_EQ(study.sky.model, "cie:12");
  EXPECT_EQ(study.calculation.tolerance_percent, 2.0);
  EXPECT_EQ(study.calculation.bounces, 5);
  EXPECT_EQ(study.calculation.seed, 1U);
  EXPECT_TRUE(study.views.empty());
  EXPECT_FALSE(study.plan);
  EXPECT_FALSE(study.report);
}

TEST_F(StudyReader, ReadsEveryKey) {
  const Study study = read(R"(
[scene]
file = "town/a.city.json"
lod = 2.2
materials = "m.toml"
crs = "EPSG:6680"
ground = 12.5
up = "y"
scale = 0.001
rotate_deg = -30
[site]
latitude_deg = 43.06
longitude_deg = 141.35
elevation_m = 18
[time]
at = 2026-06-21T10:00:00+09:00
zone = "Asia/Tokyo"
[sun]
altitude_deg = 40
azimuth_deg = 135.5
illuminance_lx = 0
[sky]
model = "weather:w/sapporo.epw"
illuminance_lx = 10000
[calculation]
tolerance_percent = 0.5
bounces = 0
seed = 42
engine = "rays"
partition = "uniform"
elements = 300
decide = "300lx"
[[view]]
name = "a"
eye = [-73300, -104030.5, 60]
target = [-73300, -104000, 20]
fov_deg = 35
size = [800, 600]
show = "falsecolor"
files = ["exr", "png"]
mirrors = "rays"
depth = 7
background = "cube:street"
background_white_cd_m2 = 3000
[[view]]
name = "b"
[[illuminance]]
name = "all"
surfaces = ["walls"]
spacing_m = 0.5
most_sensors = 1000
[[sensors]]
name = "desk"
file = "desk.pts"
[plan]
spacing_m = 4
lowest_lx = 100
highest_lx = 100000
[report]
title = "T"
author = "A"
sun_path = false
)");
  EXPECT_EQ(study.scene.file, folder_ / "town/a.city.json");
  EXPECT_EQ(study.scene.building_lod, "2.2");
  EXPECT_EQ(study.scene.materials, folder_ / "m.toml");
  EXPECT_EQ(study.scene.crs, "EPSG:6680");
  EXPECT_EQ(study.scene.ground, "12.5");
  EXPECT_EQ(study.scene.up, "y");
  EXPECT_EQ(study.scene.scale, 0.001);
  EXPECT_NEAR(study.scene.rotate.in_degrees(), -30.0, 1e-12);
  ASSERT_TRUE(study.scene.site);
  EXPECT_NEAR(study.scene.site->latitude.in_degrees(), 43.06, 1e-12);
  EXPECT_NEAR(study.scene.site->longitude.in_degrees(), 141.35, 1e-12);
  EXPECT_EQ(study.scene.site->elevation_m, 18.0);
  EXPECT_EQ(study.time.at, "2026-06-21T10:00:00+09:00");
  EXPECT_EQ(study.time.zone, "Asia/Tokyo");
  EXPECT_NEAR(study.time.sun_altitude->in_degrees(), 40.0, 1e-12);
  EXPECT_NEAR(study.time.sun_azimuth->in_degrees(), 135.5, 1e-12);
  EXPECT_EQ(study.sky.sun_illuminance, Illuminance(0.0));
  EXPECT_EQ(study.sky.model, "weather:" + (folder_ / "w/sapporo.epw").string());
  EXPECT_EQ(study.sky.sky_illuminance, Illuminance(10000.0));
  EXPECT_EQ(study.calculation.tolerance_percent, 0.5);
  EXPECT_EQ(study.calculation.bounces, 0);
  EXPECT_EQ(study.calculation.seed, 42U);
  EXPECT_EQ(study.calculation.decide, "300lx");
  EXPECT_EQ(study.calculation.engine, EngineChoice::Rays);
  ASSERT_TRUE(study.calculation.partition);
  EXPECT_EQ(study.calculation.partition->method, PartitionMethod::Uniform);
  EXPECT_EQ(study.calculation.partition->elements, 300U);
  ASSERT_EQ(study.views.size(), 2U);
  EXPECT_EQ(study.views[0].eye, (Vec3{-73300, -104030.5, 60}));
  EXPECT_EQ(study.views[0].target, (Vec3{-73300, -104000, 20}));
  EXPECT_NEAR(study.views[0].field_of_view.in_degrees(), 35.0, 1e-12);
  EXPECT_EQ(study.views[0].size, (std::array{800, 600}));
  EXPECT_EQ(study.views[0].show, ViewKind::FalseColour);
  EXPECT_EQ(study.views[0].formats, (std::vector<std::string>{"exr", "png"}));
  EXPECT_EQ(study.views[0].mirrors.method, MirrorMethod::Rays);
  EXPECT_EQ(study.views[0].mirrors.depth, 7);
  EXPECT_EQ(study.views[0].background, "cube:" + (folder_ / "street").string());
  EXPECT_EQ(study.views[0].background_white, Luminance(3000.0));
  EXPECT_EQ(study.views[1].mirrors.depth, 4);
  EXPECT_TRUE(study.views[1].background.empty());
  EXPECT_FALSE(study.views[1].eye);
  ASSERT_EQ(study.fields.size(), 1U);
  EXPECT_EQ(study.fields[0].surfaces, std::vector<std::string>{"walls"});
  EXPECT_EQ(study.fields[0].spacing_m, 0.5);
  EXPECT_EQ(study.fields[0].most_sensors, 1000U);
  ASSERT_EQ(study.sensors.size(), 1U);
  EXPECT_EQ(study.sensors[0].file, folder_ / "desk.pts");
  EXPECT_EQ(study.plan->spacing_m, 4.0);
  EXPECT_EQ(study.plan->highest, Illuminance(100000.0));
  EXPECT_EQ(study.report->title, "T");
  EXPECT_FALSE(study.report->sun_path);
}

TEST_F(StudyReader, SuggestsTheKeyThatWasMeant) {
  EXPECT_EQ(refusal("[calculation]\nbounces = 1\ntolerence_percent = 1\n"),
            "study.toml:3: unknown key 'tolerence_percent' in [calculation]; did you mean "
            "'tolerance_percent'?");
  EXPECT_EQ(refusal("[scen]\nfile = \"a.obj\"\n"),
            "study.toml:1: unknown key 'scen' in the study; did you mean 'scene'?");
  EXPECT_EQ(refusal("[[view]]\nquux = 1\n"), "study.toml:2: unknown key 'quux' in [view]");
  EXPECT_EQ(refusal(kLeast + "[calculation]\nengine = \"ray\"\n"),
            "study.toml:6: engine in [calculation] is 'ray'; it must be one of 'auto', 'rays', "
            "'shadow-maps'; did you mean 'rays'?");
}

struct Refused {
  const char* text;
  const char* message;  ///< how it begins
};

TEST_F(StudyReader, RefusesValuesOutOfRangeWithTheirLine) {
  const Refused cases[]{
      {"[calculation]\ntolerance_percent = 0\n", "6: tolerance_percent in [calculation] is 0"},
      {"[calculation]\ntolerance_percent = nan\n", "6: tolerance_percent in [calculation] is nan"},
      {"[calculation]\ntolerance_percent = \"2\"\n",
       "6: tolerance_percent in [calculation] must be a number, not string"},
      {"[calculation]\nbounces = 2.5\n", "6: bounces in [calculation] must be a whole number"},
      {"[calculation]\nbounces = -1\n", "6: bounces in [calculation] is -1"},
      {"[calculation]\nseed = -1\n", "6: seed in [calculation] is -1"},
      {"[calculation]\npartition = \"square\"\n", "6: partition 'square' is unknown"},
      {"[calculation]\nelements = 0\n", "6: elements in [calculation] is 0"},
      {"[calculation]\ndecide = \"300\"\n", "6: '300' is nothing to decide on"},
      {"[calculation]\nenergy_threshold_lx = 0\n", "6: energy_threshold_lx in [calculation] is 0"},
      {"[calculation]\nelements = 9\nenergy_threshold_lx = 1\n", "6: sky elements: give a count"},
      {"[calculation]\nelements = 9\npartition = \"tregenza\"\n", "7: the tregenza and reinhart"},
      {"[site]\nlatitude_deg = 91\nlongitude_deg = 0\n", "6: latitude_deg in [site] is 91"},
      {"[site]\nlatitude_deg = 9\n", "5: [site] needs latitude_deg and longitude_deg"},
      {"[sun]\nazimuth_deg = 9\n", "6: azimuth_deg needs altitude_deg beside it"},
      {"[sun]\nilluminance_lx = -inf\n", "6: illuminance_lx in [sun] is -inf"},
      {"[sky]\nmodel = \"\"\n", "6: model in [sky] is empty"},
      {"[sky]\nmodel = \"a\\u0000b\"\n", "6: model in [sky] holds a control character"},
      {"[[view]]\neye = [0, 0, 1]\n", "6: eye needs target beside it"},
      {"[[view]]\ndepth = 65\n", "6: depth in [view] is 65"},
      {"[[view]]\nmirrors = \"ray\"\n", "6: mirrors in [view]"},
      {"[[view]]\nbackground = \"street.png\"\n", "6: background in [view] must be cube:"},
      {"[[view]]\neye = [0, 0, 1]\ntarget = [0, 0, 1]\n", "7: target is where eye is"},
      {"[[view]]\neye = [0, 0]\ntarget = [0, 0, 1]\n", "6: eye in [view] must be a list of 3"},
      {"[[view]]\neye = [0, 0, inf]\ntarget = [0, 0, 1]\n", "6: eye in [view] is inf"},
      {"[[view]]\nfov_deg = 180\n", "6: fov_deg in [view] is 180"},
      {"[[view]]\nsize = [0, 100]\n", "6: size in [view] is 0"},
      {"[[view]]\nsize = [10.5, 100]\n", "6: size in [view] must be whole numbers"},
      {"[[view]]\nfiles = [\"jpg\"]\n", "6: files in [view] is 'jpg'; it must be one of"},
      {"[[view]]\nfiles = []\n", "6: files in [view] is empty"},
      {"[[view]]\nfiles = [\"png\", \"png\"]\n", "6: files in [view] has 'png' twice"},
      {"[[view]]\nname = \"../../etc\"\n", "6: a name becomes the name of a file"},
      {"[[view]]\nname = \"a\"\n[[sensors]]\nname = \"a\"\nfile = \"x\"\n",
       "8: the name 'a' is taken"},
      {"[[view]]\n[[view]]\n", "6: the name 'view' is taken"},
      {"[view]\nname = \"a\"\n", "5: view must be tables: [[view]]"},
      {"[[plan]]\nspacing_m = 1\n", "5: plan must be a table: [plan]"},
      {"[[illuminance]]\nspacing_m = 0\n", "6: spacing_m in [illuminance] is 0"},
      {"[[sensors]]\nname = \"a\"\n", "5: [[sensors]] needs a file"},
      {"[plan]\nlowest_lx = 10\nhighest_lx = 5\n", "7: highest_lx must be above lowest_lx"},
      {"[report]\nsun_path = 1\n", "6: sun_path in [report] must be true or false"},
      {"[calculation\n", "5: not TOML: "},
      {"[time]\n", "5: not TOML: "},
  };
  for (const Refused& each : cases) {
    const std::string message = refusal(kLeast + each.text);
    EXPECT_EQ(message.rfind(std::string("study.toml:") + each.message, 0), 0U)
        << each.text << "gave: " << message;
  }
}

TEST_F(StudyReader, RefusesWrongGround) {
  EXPECT_EQ(refusal("[scene]\nfile = \"a\"\nground = \"flat\"\n"),
            "study.toml:3: ground in [scene] must be 'auto', 'none' or a height in metres");
  EXPECT_EQ(read("[scene]\nfile = \"a\"\nground = \"none\"\n[time]\nat = \"x\"\n").scene.ground,
            "none");
}

TEST_F(StudyReader, NeedsASceneAndATimeOrASun) {
  EXPECT_EQ(refusal("[time]\nat = \"x\"\n"),
            "study.toml:1: file in [scene] is missing, and --scene is not given");
  EXPECT_EQ(refusal("[scene]\nfile = \"a\"\n").rfind("study.toml:1: the study needs a time", 0),
            0U);
  EXPECT_EQ(refusal("[scene]\nfile = \"a\"\n[sun]\naltitude_deg = 1\nazimuth_deg = 2\n"), "");
}

TEST_F(StudyReader, TakesSceneAndTimeFromTheCommandLine) {
  const Study study = read("[[view]]\nname = \"overview\"\n", {"city.json", "2026-01-01T09:00Z"});
  EXPECT_EQ(study.scene.file, "city.json");
  EXPECT_EQ(study.time.at, "2026-01-01T09:00Z");
}

TEST_F(StudyReader, RefusesToMoveToAnotherSceneWhatBelongsToItsOwn) {
  const StudyOverrides other{"city.json", ""};
  EXPECT_EQ(refusal(kLeast, other), "");
  for (const char* own : {"[[view]]\neye = [0, 0, 1]\ntarget = [1, 1, 1]\n",
                          "[site]\nlatitude_deg = 1\nlongitude_deg = 1\n"}) {
    EXPECT_NE(refusal(kLeast + own, other).find("belongs to the study's own scene"),
              std::string::npos);
  }
  EXPECT_NE(refusal("[scene]\nground = 3\n[time]\nat = \"x\"\n", other).find(":2: this belongs"),
            std::string::npos);
}

TEST_F(StudyReader, RefusesFilesThatAreNoStudy) {
  const auto message_of = [](const fs::path& path) {
    try {
      read_study(path);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message_of(folder_ / "absent.toml").find("there is no such file"), std::string::npos);
  EXPECT_NE(message_of(folder_).find("is a folder"), std::string::npos);
  EXPECT_NE(message_of(write("")).find("is empty"), std::string::npos);
  EXPECT_NE(message_of(write(std::string(2 << 20, '#'))).find("over 1 MiB"), std::string::npos);
}

TEST_F(StudyReader, SurvivesBrokenFiles) {
  EXPECT_NE(refusal(std::string("\0\1\2\xff", 4)), "");
  EXPECT_NE(refusal("a = " + std::string(100000, '[')), "");
  EXPECT_NE(refusal("a" + std::string(100000, '.') + " = 1"), "");
  std::ifstream demo(fs::path(TENKU_SOURCE_DIR) / "scenes/examples/demo.toml");
  const std::string whole{std::istreambuf_iterator<char>(demo), {}};
  ASSERT_GT(whole.size(), 100U);
  for (std::size_t cut = 0; cut < whole.size(); cut += 7) refusal(whole.substr(0, cut));
  for (std::size_t i = 0; i < whole.size(); i += 5) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x15);
    refusal(changed);
  }
}

TEST_F(StudyReader, ReadsTheExamples) {
  const fs::path examples = fs::path(TENKU_SOURCE_DIR) / "scenes/examples";
  const Study demo = read_study(examples / "demo.toml");
  EXPECT_TRUE(fs::exists(demo.scene.file));
  EXPECT_FALSE(demo.views.empty());
  const Study any = read_study(examples / "any_city.toml", {"city.json", ""});
  EXPECT_FALSE(any.views.empty());
}

/// `table.key` of every row of docs/study.md: headings name tables, first columns keys.
std::vector<std::string> documented_keys() {
  std::ifstream in(fs::path(TENKU_SOURCE_DIR) / "docs/study.md");
  const std::regex heading(R"(## `\[{1,2}(\w+)\]{1,2}`.*)"), row(R"(\| `(\w+)` \|.*\|.*\|.*\|)");
  std::vector<std::string> keys;
  std::string table, line;
  std::smatch match;
  while (std::getline(in, line)) {
    if (std::regex_match(line, match, heading)) table = match[1];
    if (std::regex_match(line, match, row)) keys.push_back(table + "." + match[1].str());
  }
  return keys;
}

TEST(StudyDocumentation, HasEveryKeyAndNoOther) { EXPECT_EQ(documented_keys(), study_keys()); }

}  // namespace
}  // namespace tenku
