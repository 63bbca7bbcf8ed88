// The contract of the command line: what is printed where, and what happens when the world fails.
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "cli/lit_scene_files.h"
#include "core/units.h"
#include "core/version.h"
#include "output/field_writer.h"
#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;
using nlohmann::json;

const std::string kColumns =
    "x,y,z,nx,ny,nz,sun_lux,sky_lux,reflected_lux,total_lux,error_lux,sky_view";

void expect_keys(const std::string& text, const std::vector<std::string>& keys) {
  const json summary = json::parse(text);
  for (const std::string& key : keys) EXPECT_TRUE(summary.contains(key)) << key << "\n" << text;
}

/// Set for this process and those that it starts, until the end of the scope.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const std::string& value) : name_(name) {
    setenv(name, value.c_str(), 1);
  }
  ~EnvironmentVariable() { unsetenv(name_); }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

 private:
  const char* name_;
};

bool has_partial_file(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().filename().string().find(".partial") != std::string::npos) return true;
  }
  return false;
}

TEST(Contract, StandardOutputHoldsTheTableAndNothingElse) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const auto run = run_tenku("illuminance box.obj --sensors open.pts --out -" + kSky, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::istringstream lines(run.out);
  std::string header, row, rest;
  std::getline(lines, header);
  std::getline(lines, row);
  EXPECT_EQ(header, kColumns);
  EXPECT_EQ(row.substr(0, 12), "10,10,0,0,0,") << row;
  EXPECT_FALSE(std::getline(lines, rest)) << rest;
}

// With libraries that cannot be loaded, all goes well that needs none of them.
TEST(LibrariesOnDemand, AreAskedForByPicturesAndFieldsAlone) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const std::string version(software_name().substr(software_name().find(' ') + 1));
  write_text(folder / ("pictures-" + version + ".so"), "broken");
  write_text(folder / ("fields-" + version + ".so"), "broken");
  const EnvironmentVariable plugins("TENKU_PLUGINS", folder);
  EXPECT_EQ(run_tenku("--version", folder).exit_code, 0);
  EXPECT_EQ(run_tenku("sky --out sky.hdr" + kSky, folder).exit_code, 0);
  EXPECT_EQ(
      run_tenku("illuminance box.obj --sensors open.pts --out o.csv" + kSky, folder).exit_code, 0);
  for (const std::string out : {"sky.png", "sky.exr", "sky.vtp"}) {
    const auto run = run_tenku("sky --out " + out + kSky, folder);
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_NE(run.err.find("cannot load " + folder.string()), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(folder / out));
  }
  EXPECT_FALSE(has_partial_file(folder));
}

TEST(Contract, SummariesHaveTheirKeys) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const auto lux =
      run_tenku("illuminance box.obj --sensors open.pts --out o.csv --json --quiet" + kSky, folder);
  ASSERT_EQ(lux.exit_code, 0) << lux.err;
  EXPECT_EQ(lux.err, "");
  expect_keys(lux.out, {"seconds", "rays", "depth_maps", "elements", "sensors", "error_mean"});
  const auto view = run_tenku(
      "render box.obj --size 16x16 --tolerance 20 --out o.png --json --quiet" + kSky, folder);
  ASSERT_EQ(view.exit_code, 0) << view.err;
  EXPECT_EQ(view.err, "");
  expect_keys(view.out, {"seconds", "rays", "depth_maps", "elements", "pixels", "error_mean"});
  const auto scene = run_tenku("inspect box.obj --json --quiet", folder);
  ASSERT_EQ(scene.exit_code, 0) << scene.err;
  expect_keys(scene.out, {"format", "crs", "objects", "triangles", "lods", "extent",
                          "surface_types", "findings"});
  EXPECT_EQ(json::parse(scene.out)["triangles"], 14);
}

TEST(Contract, EveryCommandHasHelpWithAnExample) {
  const fs::path folder = test_folder();
  const auto all = run_tenku("--help", folder);
  EXPECT_EQ(all.exit_code, 0);
  for (const std::string name : {"inspect", "sun", "sky", "plan", "illuminance", "render", "run"}) {
    EXPECT_NE(all.out.find(name), std::string::npos) << name;
    const auto help = run_tenku(name + " --help", folder);
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("Example:\n  tenku " + name), std::string::npos) << help.out;
    for (const std::string option : {"--threads", "--seed", "--quiet", "--verbose", "--json"}) {
      EXPECT_NE(help.out.find(option), std::string::npos) << name << " " << option;
    }
  }
  EXPECT_EQ(run_tenku("--version", folder).out.substr(0, 5), "tenku");
}

TEST(Contract, AFullDeviceIsExitOne) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const std::string command = "cd '" + folder.string() +
                              "' && '" TENKU_PROGRAM
                              "' illuminance box.obj --sensors open.pts --quiet --out -" +
                              kSky + " > /dev/full 2> said.err";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(contents_of(folder / "said.err").find("standard output"), std::string::npos);
}

// A limit on the size of files stands for a full disk.
TEST(Contract, AFileThatDoesNotFitLeavesNothing) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "try.sh",
             "trap '' XFSZ\nulimit -f 2\n\"$1\" sky --sky uniform --sky-illuminance 1 --quiet "
             "--elements 20000 --out \"$2\"\n");
  for (const std::string out : {"big.csv", "big.vtp", "big.exr", "big.hdr", "big.png"}) {
    const std::string command = "cd '" + folder.string() + "' && sh try.sh '" TENKU_PROGRAM "' " +
                                out + " > said.out 2> said.err";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << out << ": " << contents_of(folder / "said.err");
    EXPECT_NE(contents_of(folder / "said.err").find("cannot write"), std::string::npos)
        << out << ": " << contents_of(folder / "said.err");
    EXPECT_FALSE(fs::exists(folder / out));
    EXPECT_FALSE(has_partial_file(folder)) << out;
  }
}

// A sensor in the box and one in the open: the first is dark, and the program says so.
TEST(Contract, ASensorInAWallIsDarkAndSaysSo) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "two.pts", "10 10 0 0 0 1\n0 0 0 0 0 1\n0.1 0 0 1 0 0\n");
  const auto run = run_tenku("illuminance box.obj --sensors two.pts --out o.csv" + kSky, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const ReferenceTable table((folder / "o.csv").string());
  EXPECT_GT(table.number(0, "total_lux"), 5000.0);
  EXPECT_EQ(table.number(1, "total_lux"), 0.0);
  EXPECT_EQ(table.number(1, "sky_view"), 0.0);
  EXPECT_NE(run.err.find("2 x no_light"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("sensor 2"), std::string::npos) << run.err;
}

TEST(Contract, LightedSensorsGiveNoSuchFinding) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const auto run = run_tenku("illuminance box.obj --sensors open.pts --out o.csv" + kSky, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err.find("no_light"), std::string::npos) << run.err;
}

// docs/study.md, each table once.
const char* const kEveryTable = R"([scene]
file = "box.obj"
crs = "EPSG:6680"
ground = "none"
up = "z"
rotate_deg = 10.0
[site]
latitude_deg = 43.06
longitude_deg = 141.35
[time]
at = "2026-06-21T10:00"
zone = "Asia/Tokyo"
[sky]
model = "cie:12"
illuminance_lx = 15000
[calculation]
tolerance_percent = 20
bounces = 1
[[view]]
name = "view"
size = [32, 24]
show = "falsecolor"
files = ["png", "exr", "hdr"]
[[illuminance]]
name = "field"
surfaces = ["roofs"]
[[sensors]]
name = "points"
file = "open.pts"
[plan]
spacing_m = 4
lowest_lx = 0
highest_lx = 90000
[report]
title = "Every table"
)";

TEST(Contract, AStudyWithEveryTableWritesEveryOutput) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "s.toml", kEveryTable);
  const auto run = run_tenku("run s.toml --out results --json --quiet", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string name : {"view.png", "view.exr", "view.hdr", "field.vtp", "points.csv",
                                 "plan.png", "sun_path.svg", "report.html", "manifest.json"}) {
    EXPECT_TRUE(fs::exists(folder / "results" / name)) << name;
  }
  EXPECT_EQ(contents_of(folder / "results/points.csv").substr(0, kColumns.size()), kColumns);
  EXPECT_EQ(json::parse(run.out)["files"].size(), 9u);
}

// Two tables with a sensor in the box each, and in the second one too near to it for the tolerance.
TEST(Contract, AReportTellsEachFindingOnceAndHowManyPointsAreLessExact) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "dark.pts", "10 10 0 0 0 1\n0 0.5 0.25 0 0 1\n");
  write_text(folder / "near.pts", "1.2 0.1 0 1 0 1\n0 0.5 0.25 0 0 1\n");
  write_text(folder / "s.toml",
             "[scene]\nfile = \"box.obj\"\nup = \"z\"\n[calculation]\ntolerance_percent = 1e-7\n"
             "bounces = 0\n[[sensors]]\nname = \"a\"\nfile = \"dark.pts\"\n"
             "[[sensors]]\nname = \"b\"\nfile = \"near.pts\"\n[report]\n"
             "[sun]\naltitude_deg = 40\nazimuth_deg = 180\nilluminance_lx = 0\n");
  const auto run = run_tenku("run s.toml --out results --json", folder);
  EXPECT_EQ(run.exit_code, 3) << run.err;
  const std::string report = contents_of(folder / "results/report.html");
  const std::string dark = "sensors see no sky";
  const auto first = report.find(dark);
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(report.find(dark, first + 1), std::string::npos);
  EXPECT_NE(report.find("sensor 2, 0.0 m east, 0.5 m north, 0.2 m up"), std::string::npos)
      << report.substr(first, 400);
  const auto missed = json::parse(run.out)["out_of_tolerance"].get<int>();
  EXPECT_NE(report.find("wider at " + std::to_string(missed) + " of 4 points"), std::string::npos);
}

// The grid of EPSG:6680 is turned by a degree and more at its rim.
TEST(Contract, AFieldLeadsBackToTheCoordinatesOfTheFile) {
  const fs::path folder = test_folder();
  write_text(folder / "far.obj",
             "v -73300 -104100 5\nv -73200 -104100 5\nv -73200 -104000 5\nv -73300 -104000 5\n"
             "f 1 2 3 4\n");
  write_text(folder / "far.pts", "-73290.5 -104090.25 6 0 0 1\n-73210.125 -104001 30.5 0 0 1\n");
  const auto run = run_tenku(
      "illuminance far.obj --up z --crs EPSG:6680 --sensors far.pts --bounces 0 --out o.vtp" + kSky,
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const FieldMesh mesh = read_vtp(folder / "o.vtp");
  const auto numbers = [&](const std::string& name) {
    std::vector<double> values;
    for (const FieldText& text : mesh.texts) {
      std::istringstream words(text.name == name ? text.values.at(0) : "");
      for (double value; words >> value;) values.push_back(value);
    }
    return values;
  };
  const auto origin = numbers("origin"), m = numbers("to_file"),
             turn = numbers("grid_convergence_deg");
  ASSERT_EQ(origin.size(), 3u);
  ASSERT_EQ(m.size(), 9u);
  ASSERT_EQ(turn.size(), 1u);
  EXPECT_GT(std::abs(turn[0]), 0.5);
  // To turn back by the convergence is the same, but for the scale of the projection.
  EXPECT_NEAR(std::atan2(m[3], m[0]) * 180.0 / kPi, turn[0], 1e-6);
  const double in_file[2][3] = {{-73290.5, -104090.25, 6.0}, {-73210.125, -104001.0, 30.5}};
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 p = mesh.points.at(i);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(origin[k] + m[3 * k] * p.x + m[3 * k + 1] * p.y + m[3 * k + 2] * p.z,
                  in_file[i][k], 1e-3);
    }
  }
}

struct Interrupted {
  int exit_code;
  double seconds_after;  ///< from the signal to the end
  std::string err;
};

/// Ctrl-C a moment after the scene has been read, when the long work is under way.
Interrupted interrupt(const std::string& arguments, const fs::path& folder) {
  write_text(folder / "stop.sh",
             ": > said.err\n\"$@\" > said.out 2> said.err < /dev/null &\n"
             "for i in $(seq 200); do grep -q boxes said.err && break; sleep 0.05; done\n"
             "sleep 0.3\ndate +%s.%N > began\nkill -INT $!\nwait $!\ncode=$?\n"
             "date +%s.%N > ended\nexit $code\n");
  const std::string command =
      "cd '" + folder.string() + "' && sh stop.sh '" TENKU_PROGRAM "' " + arguments;
  const int status = std::system(command.c_str());
  const auto seconds = [&](const char* file) { return std::stod(contents_of(folder / file)); };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, seconds("ended") - seconds("began"),
          contents_of(folder / "said.err")};
}

// "Stops within a second" is the contract; machines that run much else meanwhile get longer, and
// all of these would take many minutes.
TEST(Contract, CtrlCStopsAtOnceAndLeavesNothing) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "s.toml",
             "[scene]\nfile = \"box.obj\"\n[sky]\nmodel = \"cie:12\"\n"
             "[sun]\naltitude_deg = 40\nazimuth_deg = 180\n"
             "[calculation]\ntolerance_percent = 0.01\n[[illuminance]]\nspacing_m = 0.05\n");
  for (const std::string& arguments : std::vector<std::string>{
           "illuminance box.obj --grid ground,walls --spacing 0.05 --tolerance 0.01 --out o.csv" +
               kSky,
           "render box.obj --size 2000x2000 --tolerance 0.01 --out o.png" + kSky,
           "run s.toml --out results"}) {
    const Interrupted stopped = interrupt(arguments, folder);
    EXPECT_EQ(stopped.exit_code, 1) << arguments << stopped.err;
    EXPECT_NE(stopped.err.find("stopped by the user"), std::string::npos) << stopped.err;
    EXPECT_LT(stopped.seconds_after, 20.0) << arguments;
    EXPECT_FALSE(fs::exists(folder / "o.csv") || fs::exists(folder / "o.png"));
    EXPECT_FALSE(has_partial_file(folder)) << arguments;
  }
}

TEST(Contract, AToleranceThatIsNotReachedIsExitThreeWithAResult) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "near.pts", "1.2 0.1 0 1 0 1\n");
  const auto run = run_tenku(
      "illuminance box.obj --sensors near.pts --tolerance 1e-7 --out o.csv --json" + kSky, folder);
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_NE(run.err.find("tolerance_not_reached"), std::string::npos) << run.err;
  EXPECT_TRUE(fs::exists(folder / "o.csv"));
  EXPECT_GT(json::parse(run.out)["out_of_tolerance"].get<int>(), 0);
}

TEST(Contract, AViewThatMissesItsToleranceIsExitThreeAndTellsHowManyPixels) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const auto run = run_tenku(
      "render box.obj --size 6x4 --bounces 0 --tolerance 1e-7 --out o.png --json" + kSky, folder);
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_TRUE(fs::exists(folder / "o.png"));
  const auto missed = json::parse(run.out)["out_of_tolerance"].get<std::size_t>();
  EXPECT_GT(missed, 0u);
  EXPECT_LE(missed, 24u);
  EXPECT_NE(run.err.find(std::to_string(missed) + " x tolerance_not_reached: pixels"),
            std::string::npos)
      << run.err;
}

TEST(Contract, AStudyOfSurfacesThatAreNotThereFailsBeforeTheViews) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "s.toml", "[scene]\nfile = \"box.obj\"\n" + kSun +
                                    "[[illuminance]]\nsurfaces = [\"windows\"]\n");
  const auto run = run_tenku("run s.toml --out results", folder);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_NE(run.err.find("no surfaces"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(folder / "results/view.png"));
}

TEST(Elements, OfTheSkyAreTakenByEveryCommandThatLights) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  const auto lux = run_tenku(
      "illuminance box.obj --sensors open.pts --bounces 0 --elements 300 --out o.csv --json" + kSky,
      folder);
  ASSERT_EQ(lux.exit_code, 0) << lux.err;
  EXPECT_EQ(json::parse(lux.out)["elements"], 300);
  // A box of 2 m, 10 m away, hides little of a sky of 10,000 lx.
  EXPECT_NEAR(ReferenceTable((folder / "o.csv").string()).number(0, "sky_lux"), 10000.0, 100.0);
  const auto view = run_tenku(
      "render box.obj --size 16x16 --tolerance 100 --partition tregenza --out o.png --json" + kSky,
      folder);
  EXPECT_EQ(json::parse(view.out)["elements"], 145) << view.err;
  write_text(folder / "s.toml",
             "[scene]\nfile = \"box.obj\"\n[calculation]\nelements = 64\n"
             "tolerance_percent = 100\n[[sensors]]\nfile = \"open.pts\"\n"
             "[report]\n[sun]\naltitude_deg = 40\nazimuth_deg = 180\n");
  const auto study = run_tenku("run s.toml --out results", folder);
  ASSERT_EQ(study.exit_code, 0) << study.err;
  const json manifest = json::parse(contents_of(folder / "results/manifest.json"));
  EXPECT_EQ(manifest["results"]["elements"], 64);
  EXPECT_EQ(manifest["settings"]["partition"], "adaptive, 64 elements");
  EXPECT_NE(contents_of(folder / "results/report.html").find("adaptive, 64 elements"),
            std::string::npos);
}

TEST(Elements, TooFewForTheToleranceAreExitThree) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "near.pts", "1.2 0.1 0 0 0 1\n");
  const auto run = run_tenku(
      "illuminance box.obj --sensors near.pts --elements 20 --out o.csv --json" + kSky, folder);
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_EQ(json::parse(run.out)["out_of_tolerance"], 1);
  EXPECT_TRUE(fs::exists(folder / "o.csv"));
}

}  // namespace
}  // namespace tenku
