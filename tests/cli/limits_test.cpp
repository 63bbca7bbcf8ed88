// `illuminance --decide` and `run --time-limit`: what they write and say.
#include <gtest/gtest.h>

#include "cli/lit_scene_files.h"
#include "core/csv.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

// Under a uniform sky a sensor in the open that faces up receives all of 10,000 lx; below the box,
// 2 m across and 1 m above, much less than half.
TEST(DecideOption, AddsAColumnAndCounts) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "two.pts", "15 15 -1.9 0 0 1\n0 0 -1.9 0 0 1\n");
  const ProgramRun run = run_tenku(
      "illuminance box.obj --sensors two.pts --bounces 0 --decide 80%sky --out o.csv --json" + kSky,
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CsvInput table(contents_of(folder / "o.csv"), "o.csv");
  EXPECT_EQ(table.text(0, "decided"), "yes");
  EXPECT_EQ(table.text(1, "decided"), "no");
  EXPECT_NE(run.err.find("above 80%sky: 1 yes, 1 no, 0 undecided"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("\"undecided\": 0"), std::string::npos) << run.out;
}

TEST(DecideOption, IsAKeyOfStudies) {
  const fs::path folder = test_folder();
  write_box_scene(folder);
  write_text(folder / "s.toml",
             "[scene]\nfile = \"box.obj\"\n[sun]\naltitude_deg = 40\nazimuth_deg = 180\n[sky]\n"
             "model = \"uniform\"\nilluminance_lx = 10000\n[calculation]\nbounces = 0\ndecide = "
             "\"5000lx\"\n"
             "[[sensors]]\nfile = \"open.pts\"\n");
  const ProgramRun run = run_tenku("run s.toml --out r --time-limit 30s --json", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CsvInput table(contents_of(folder / "r/sensors.csv"), "sensors.csv");
  EXPECT_EQ(table.text(0, "decided"), "yes");
  EXPECT_NE(run.err.find("tolerance 0.1 %: expected to take"), std::string::npos)
      << "a study that takes no time is done as finely as can be: " << run.err;
  EXPECT_NE(run.out.find("\"is_in_time\": true"), std::string::npos) << run.out;
  EXPECT_NE(contents_of(folder / "r/manifest.json").find("\"tolerance_pct\": 0.1"),
            std::string::npos);
}

}  // namespace
}  // namespace tenku
