// What the program says when the input is wrong: exit code 2, the value and where it stands.
#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

#include "cli/lit_scene_files.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

struct Case {
  std::string arguments, word;
};

/// Each case ends with code 2, names `word`, and is not an abort or a crash.
void expect_refused(const std::vector<Case>& cases, const fs::path& folder) {
  for (const Case& c : cases) {
    const ProgramRun run = run_tenku(c.arguments, folder);
    EXPECT_EQ(run.exit_code, 2) << c.arguments << "\n" << run.err;
    EXPECT_NE(run.err.find(c.word), std::string::npos)
        << c.arguments << "\nlacks '" << c.word << "': " << run.err;
  }
}

/// No result and nothing half-written.
void expect_only(const fs::path& folder, std::size_t files) {
  std::size_t found = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    EXPECT_EQ(entry.path().filename().string().find(".partial"), std::string::npos);
    ++found;
  }
  EXPECT_EQ(found, files + 2);  // said.out, said.err
}

const std::string kCity = R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],
"translate":[0,0,0]},"vertices":[[0,0,0],[9,0,0],[9,9,0]],"CityObjects":{"house":{"type":"Building",
"geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}]}}})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("nothing to replace: " + from);
  return text.replace(at, from.size(), to);
}

/// One broken scene: file name, contents, and a word that the message must have.
struct BrokenScene {
  std::string file, text, word;
};

std::vector<BrokenScene> broken_scenes() {
  return {{"cut.city.json", kCity.substr(0, kCity.size() / 2), "cut.city.json"},
          {"type.city.json", replaced(kCity, "\"CityJSON\"", "7"), "type.city.json"},
          {"vertices.city.json", replaced(kCity, "[9,9,0]", "\"here\""), "vertices.city.json"},
          {"nan.city.json", replaced(kCity, "[9,9,0]", "[9,NaN,0]"), "nan.city.json"},
          {"huge.city.json", replaced(kCity, "[9,9,0]", "[9,1e999,0]"), "huge.city.json"},
          {"empty.city.json", "", "empty.city.json is empty"},
          {"objects.city.json", replaced(kCity, "\"CityObjects\":{", "\"CityObjects\":[{"),
           "objects.city.json"},
          {"deep.city.json", std::string(100000, '['), "deep.city.json"},
          {"none.city.json", "{}", "none.city.json"},
          {"binary.city.json", std::string("\0\1\2\xff\xfe", 5), "binary.city.json"},
          {"index.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "line 3"},
          {"nan.obj", "v 0 0 nan\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "line 1"},
          {"word.obj", "v 0 0 0\nv one 0 0\nv 1 1 0\nf 1 2 3\n", "line 2"},
          {"empty.obj", "", "empty.obj is empty"},
          {"blank.obj", "# nothing\n", "blank.obj"},
          {"cut.obj.gz", std::string("\x1f\x8b\x08\x00\x00", 5), "cut.obj.gz"},
          {"scene.dwg", "x", "scene.dwg"}};
}

TEST(WrongInput, BrokenScenesAreRefusedByEveryCommandThatReadsOne) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  std::vector<Case> cases;
  for (const BrokenScene& scene : broken_scenes()) {
    write_text(folder / scene.file, scene.text);
    cases.push_back({"inspect " + scene.file, scene.word});
  }
  for (const BrokenScene& scene : {broken_scenes().front(), broken_scenes()[10]}) {
    write_text(folder / (scene.file + ".toml"), "[scene]\nfile = \"" + scene.file + "\"\n" + kSun);
    cases.push_back(
        {"illuminance " + scene.file + " --sensors open.pts --out o.csv" + kSky, scene.word});
    cases.push_back({"render " + scene.file + " --out o.png" + kSky, scene.word});
    cases.push_back({"run " + scene.file + ".toml --out results", scene.word});
  }
  expect_refused(cases, folder);
  EXPECT_FALSE(fs::exists(folder / "o.csv"));
  EXPECT_FALSE(fs::exists(folder / "o.png"));
}

TEST(WrongInput, AnIndexOutOfRangeNamesTheObject) {
  const fs::path folder = test_folder();
  write_text(folder / "index.city.json", replaced(kCity, "[[[0,1,2]]]", "[[[0,1,7]]]"));
  const ProgramRun run = run_tenku("inspect index.city.json --json", folder);
  EXPECT_NE((run.out + run.err).find("house"), std::string::npos) << run.out << run.err;
  EXPECT_NE((run.out + run.err).find('7'), std::string::npos) << run.out << run.err;
}

TEST(WrongInput, FoldersAndMissingFilesAreNamed) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  fs::create_directory(folder / "model.obj");
  expect_refused(
      {{"inspect no.obj", "no.obj"},
       {"inspect model.obj", "model.obj is a folder"},
       {"illuminance no.obj --sensors open.pts --out o.csv" + kSky, "no.obj"},
       {"illuminance model.obj --sensors open.pts --out o.csv" + kSky, "is a folder"},
       {"illuminance box.obj --sensors no.pts --out o.csv" + kSky, "no.pts"},
       {"illuminance box.obj --sensors model.obj --out o.csv" + kSky, "is a folder"},
       {"illuminance box.obj --materials no.toml --sensors open.pts --out o.csv" + kSky, "no.toml"},
       {"render box.obj --materials model.obj --out o.png" + kSky, "model.obj"},
       {"illuminance box.obj --sensors open.pts --decide 300 --out o.csv" + kSky, "300lx"},
       {"illuminance box.obj --sensors open.pts --decide 200%sky --out o.csv" + kSky, "27%sky"},
       {"run no.toml --time-limit soon --out results", "such as 120s"},
       {"run no.toml --out results", "no.toml"},
       {"run model.obj --out results", "model.obj"},
       {"sky --sky image:model.obj --json", "model.obj"}},
      folder);
}

TEST(WrongInput, UnreadableFilesAreNamed) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read every file";
  const fs::path folder = test_folder();
  write_box_scene(folder);
  fs::permissions(folder / "box.obj", fs::perms::none);
  expect_refused({{"inspect box.obj", "cannot read box.obj"}}, folder);
}

TEST(WrongInput, MaterialsAreRefusedWithTheirLine) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "bright.toml", "[wall]\nreflectance = 1.2\n");
  write_text(folder / "nan.toml", "[wall]\nreflectance = nan\n");
  write_text(folder / "word.toml", "[wall]\nreflectance = \"dark\"\n");
  write_text(folder / "key.toml", "[wall]\nreflectence = 0.5\n");
  write_text(folder / "cut.toml", "[wall\nreflec");
  const std::string rest = " --sensors open.pts --out o.csv" + kSky;
  expect_refused({{"illuminance box.obj --materials bright.toml" + rest, "1.2"},
                  {"illuminance box.obj --materials bright.toml" + rest, "wall"},
                  {"illuminance box.obj --materials nan.toml" + rest, "nan.toml"},
                  {"illuminance box.obj --materials word.toml" + rest, "word.toml"},
                  {"illuminance box.obj --materials key.toml" + rest, "reflectance"},
                  {"illuminance box.obj --materials cut.toml" + rest, "cut.toml"},
                  {"render box.obj --materials bright.toml --out o.png" + kSky, "1.2"}},
                 folder);
}

TEST(WrongInput, TimesAndPlacesThatAreNotAreRefused) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const std::string lit = " --sky cie:12 --out o.csv --sensors open.pts";
  expect_refused(
      {{"illuminance box.obj --lat 48 --lon 2 --time 2026-03-29T02:30 --zone Europe/Paris" + lit,
        "never happens"},
       {"illuminance box.obj --lat 91 --lon 2 --time 2026-03-29T02:30Z" + lit, "latitude 91"},
       {"illuminance box.obj --lat nan --lon 2 --time 2026-03-29T02:30Z" + lit, "latitude"},
       {"illuminance box.obj --lat 48 --lon 999 --time 2026-03-29T02:30Z" + lit, "longitude 999"},
       {"illuminance box.obj --lat 48 --time 2026-03-29T02:30Z" + lit, "--lon"},
       {"illuminance box.obj --time 2026-03-29T02:30Z" + lit, "--lat"},
       {"illuminance box.obj --lat 48 --lon 2 --time 2026-02-30T12:00Z" + lit, "2026-02-30"},
       {"illuminance box.obj --sensors open.pts --out o.csv --sky cloudy", "cloudy"},
       {"render box.obj --out o.png --sky cloudy", "cloudy"},
       {"illuminance box.obj --sensors open.pts --out o.csv --sky cie:99", "99"}},
      folder);
}

TEST(WrongInput, CalculationOptionsOutOfRangeAreRefused) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const std::string base = "illuminance box.obj --out o.csv" + kSky;
  const std::string points = base + " --sensors open.pts";
  expect_refused({{points + " --tolerance 0", "tolerance 0"},
                  {points + " --elements 0", "elements 0"},
                  {points + " --elements many", "elements"},
                  {points + " --energy-threshold 0", "energy threshold 0"},
                  {points + " --energy-threshold nan", "energy threshold nan"},
                  {points + " --partition square", "square"},
                  {points + " --partition reinhart:9", "reinhart:9"},
                  {points + " --partition tregenza --elements 9", "their own count"},
                  {points + " --elements 9 --energy-threshold 9", "not two"},
                  {"render box.obj --out o.png --elements 0" + kSky, "elements 0"},
                  {points + " --tolerance -1", "tolerance -1"},
                  {points + " --tolerance nan", "tolerance nan"},
                  {points + " --tolerance 101", "tolerance 101"},
                  {points + " --tolerance two", "two"},
                  {points + " --bounces -1", "bounces -1"},
                  {points + " --bounces 1.5", "1.5"},
                  {points + " --engine shadow-map", "shadow-maps"},
                  {points + " --lod papers", "paper"},
                  {points + " --lod paper", "polygons in a picture"},
                  {points + " --gl metal", "metal"},
                  {points + " --engine rasta", "rasta"},
                  {points + " --up x", "'x'"},
                  {points + " --scale 0", "--scale"},
                  {points + " --scale nan", "nan"},
                  {points + " --rotate inf", "--rotate"},
                  {points + " --crs EPSG:0", "EPSG:0"},
                  {points + " --ground low", "low"},
                  {points + " --grid walls", "either --sensors"},
                  {base, "either --sensors"},
                  {base + " --grid wals", "walls"},
                  {base + " --grid ,", "surfaces"},
                  {base + " --grid roofs --spacing 0", "spacing"},
                  {base + " --grid roofs --spacing -2", "spacing"},
                  {base + " --grid roofs --spacing nan", "spacing"},
                  {base + " --grid roofs --spacing 1e-9", "spacing"},
                  {base + " --grid water", "no surfaces"}},
                 folder);
  expect_only(folder, 2);
}

TEST(WrongInput, BrokenSensorFilesNameTheirLine) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "five.pts", "0 0 5 0 0 1\n0 0 5 0 0\n");
  write_text(folder / "zero.pts", "0 0 5 0 0 0\n");
  write_text(folder / "nan.pts", "0 0 5 0 0 1\n\n0 nan 5 0 0 1\n");
  write_text(folder / "word.pts", "x y z nx ny nz\n");
  write_text(folder / "none.pts", "# none\n");
  const std::string base = "illuminance box.obj --out o.csv" + kSky;
  expect_refused({{base + " --sensors five.pts", "five.pts, line 2: 5 numbers"},
                  {base + " --sensors zero.pts", "zero.pts, line 1: the normal"},
                  {base + " --sensors nan.pts", "nan.pts, line 3"},
                  {base + " --sensors word.pts", "word.pts, line 1"},
                  {base + " --sensors none.pts", "none.pts holds no sensors"}},
                 folder);
  expect_only(folder, 7);
}

TEST(WrongInput, ViewsThatCannotBeAreRefused) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const std::string base = "render box.obj --out o.png" + kSky;
  const std::string eye = base + " --eye 9,9,9 --target 0,0,0";
  expect_refused({{base + " --size 0x0", "--size 0x0"},
                  {base + " --size 100000x100000", "100000x100000"},
                  {base + " --size -5x5", "-5x5"},
                  {base + " --mirrors beam", "'beam'"},
                  {base + " --depth -1", "depth -1"},
                  {base + " --background sphere:x", "sphere:x"},
                  {base + " --background cube:/no/such/folder", "east"},
                  {base + " --background-white 0", "--background-white"},
                  {base + " --size 64", "--size 64"},
                  {base + " --size 99999999999999x9", "99999999999999x9"},
                  {eye + " --fov 0", "--fov 0"},
                  {eye + " --fov 180", "--fov 180"},
                  {eye + " --fov nan", "--fov nan"},
                  {base + " --eye 9,9,9", "--target"},
                  {base + " --target 9,9,9", "--eye"},
                  {base + " --eye 1,2,3 --target 1,2,3", "same point"},
                  {base + " --eye 1,2 --target 0,0,0", "1,2"},
                  {base + " --eye 1,2,nan --target 0,0,0", "1,2,nan"},
                  {base + " --show red", "'red'"},
                  {"render box.obj --out o.jpg" + kSky, "o.jpg"},
                  {"render box.obj --out -" + kSky, "'-'"}},
                 folder);
  expect_only(folder, 2);
}

// Before the views, which take long.
TEST(WrongInput, StudiesAreRefusedBeforeTheWork) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const std::string begin = "[scene]\nfile = \"box.obj\"\n" + kSun + "size = [9000, 9000]\n";
  write_text(folder / "maps.toml", begin + "[calculation]\nlod = \"none\"\n");
  write_text(folder / "points.toml", begin + "[[sensors]]\nfile = \"no.pts\"\n");
  write_text(folder / "key.toml", begin + "[calculation]\nbounce = 1\n");
  write_text(folder / "cut.toml", "[scene\n");
  expect_refused({{"run maps.toml --out results", "budget"},
                  {"run points.toml --out results", "no.pts"},
                  {"run key.toml --out results", "bounces"},
                  {"run cut.toml --out results", "cut.toml"}},
                 folder);
}

// The scene does not exist either: the output is looked at first, before any long work.
TEST(WrongInput, OutputsThatCannotBeWrittenAreFoundBeforeTheSceneIsRead) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  fs::create_directory(folder / "folder.csv");
  write_text(folder / "file", "");
  write_text(folder / "s.toml", "[scene]\nfile = \"no.obj\"\n" + kSun);
  expect_refused(
      {{"illuminance no.obj --sensors open.pts --out no/such/o.csv" + kSky, "folder no/such"},
       {"illuminance no.obj --sensors open.pts --out folder.csv" + kSky, "it is a folder"},
       {"illuminance no.obj --sensors open.pts --out o.txt" + kSky, "o.txt"},
       {"render no.obj --out no/such/o.png" + kSky, "folder no/such"},
       {"sky --sky uniform --sky-illuminance 1 --out no/such/o.vtp", "folder no/such"},
       {"sky --sky uniform --sky-illuminance 1 --out o.txt", "o.txt"},
       {"sun --lat 1 --lon 1 --time 2026-06-21T00:00Z --out no/such/o.csv", "folder no/such"},
       {"run s.toml --out file", "file"}},
      folder);
}

TEST(WrongInput, OptionsThatDoNotExistAreNamed) {
  const fs::path folder = test_folder();
  expect_refused({{"", "subcommand"},
                  {"paint", "no command 'paint'"},
                  {"rendr box.obj", "'render'"},
                  {"inspect", "SCENE"},
                  {"sun --colour red", "--colour"},
                  {"inspect box.obj --threads -1", "-1"}},
                 folder);
}

}  // namespace
}  // namespace tenku
