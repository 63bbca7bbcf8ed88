// `tenku chart`: what it writes, and how it refuses.
#include <gtest/gtest.h>

#include <set>

#include "cli/lit_scene_files.h"
#include "core/csv.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

const char* const kBlocks =
    "o ground\nv -60 -60 0\nv 60 -60 0\nv 60 60 0\nv -60 60 0\nf 1 2 3 4\n"
    "o wall\nv -20 5 0\nv 20 5 0\nv 20 5 15\nv -20 5 15\nf 5 6 7 8\n"
    "o roof\nv -10 -30 9\nv 10 -30 9\nv 10 -10 9\nv -10 -10 9\nf 9 10 11 12\n";

TEST(ChartCommand, WritesTableAndPageWithAReferenceOfKnownError) {
  const fs::path folder = test_folder();
  write_text(folder / "b.obj", kBlocks);
  const ProgramRun run = run_tenku(
      "chart b.obj --sky cie-overcast --sky-illuminance 10000 --stage sky,lod --grid ground "
      "--spacing 12 --budget 8s --out "
      "c",
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CsvInput table(contents_of(folder / "c/chart.csv"), "chart.csv");
  EXPECT_GE(table.size(), 25U);
  std::set<std::string> stages;
  std::size_t front = 0, inside = 0;
  for (std::size_t row = 0; row < table.size(); ++row) {
    stages.insert(table.text(row, "stage"));
    front += table.text(row, "on_front") == "yes";
    EXPECT_GT(table.number(row, "time_s"), 0.0);
    EXPECT_GE(table.number(row, "max_error"), table.number(row, "p95_error"));
    inside += table.number(row, "rms_error") <= table.number(row, "predicted_error");
  }
  EXPECT_EQ(stages, (std::set<std::string>{"lod", "sky"}));
  EXPECT_GE(front, 2U);
  EXPECT_GE(10 * inside, 9 * table.size());  // what is foretold holds for nine in ten
  const std::string page = contents_of(folder / "c/chart.html");
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("<img src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("<script src"), std::string::npos);
  EXPECT_GT(fs::file_size(folder / "c/chart.png"), 10000U);
  EXPECT_NE(contents_of(folder / "c/recommended.toml").find("[calculation]"), std::string::npos);
}

TEST(ChartCommand, ComparesPicturesAsTheyAreSeen) {
  const fs::path folder = test_folder();
  write_text(folder / "b.obj", kBlocks);
  const ProgramRun run = run_tenku(
      "chart b.obj --sky cie:12 --sun-altitude 40 --sun-azimuth 200 --stage picture,fly-through "
      "--eye=-50,-50,30 --target=0,0,0 --size 96x64 --budget 15s --out c",
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CsvInput table(contents_of(folder / "c/chart.csv"), "chart.csv");
  std::set<std::string> methods;
  for (std::size_t row = 0; row < table.size(); ++row) {
    methods.insert(table.text(row, "method"));
    EXPECT_EQ(table.text(row, "worst_x"), "");
    // Of white: a picture of these blocks is not far off by any method.
    EXPECT_LE(table.number(row, "mean_255"), 2.0) << table.text(row, "method");
    EXPECT_GE(table.number(row, "similarity"), 0.9) << table.text(row, "method");
    EXPECT_LE(table.number(row, "similarity"), 1.0);
  }
  EXPECT_EQ(methods, (std::set<std::string>{"budget", "frame by frame", "off", "paper", "points"}));
}

TEST(ChartCommand, ComparesReflectionsAndMirrorsWhereThereAreAny) {
  const fs::path folder = test_folder();
  write_text(folder / "b.obj", kBlocks);
  const std::string sky = "chart b.obj --sky cie-overcast --sky-illuminance 10000 --out c ";
  const ProgramRun none = run_tenku(sky + "--stage mirrors", folder);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("none to compare"), std::string::npos) << none.err;
  write_text(folder / "m.toml", "[wall]\nmirror = 0.8\nreflectance = 0.1\n");
  const ProgramRun run =
      run_tenku(sky +
                    "--materials m.toml --stage mirrors,reflections --size 64x48 --grid ground "
                    "--spacing 12 --budget 15s",
                folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CsvInput table(contents_of(folder / "c/chart.csv"), "chart.csv");
  std::set<std::string> methods;
  for (std::size_t row = 0; row < table.size(); ++row) methods.insert(table.text(row, "method"));
  EXPECT_EQ(methods, (std::set<std::string>{"beams", "bounces", "off", "paths", "rays"}));
}

TEST(ChartCommand, RefusesWhatIsWrong) {
  const fs::path folder = test_folder();
  write_text(folder / "b.obj", kBlocks);
  const auto refuses = [&](const std::string& options, const std::string& word) {
    const ProgramRun run = run_tenku("chart b.obj " + options, folder);
    EXPECT_EQ(run.exit_code, 2) << options;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  };
  refuses("--sky cie-overcast --sky-illuminance 10000 --stage skie --out c", "sky");
  refuses("--sky cie-overcast --sky-illuminance 10000 --budget soon --out c", "budget");
  refuses("--sky none --stage sky --out c", "without a sky");
  refuses("--sky cie-overcast --sky-illuminance 10000 --out b.obj", "folder");
  refuses("--sky cie-overcast --sky-illuminance 10000 --out -", "folder");
}

}  // namespace
}  // namespace tenku
