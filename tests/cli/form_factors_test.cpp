// tenku form-factors, as its users see it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/lit_scene_files.h"
#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

using namespace testing_support;

/// Two unit squares at a distance of 1, which look at each other.
const char* const kSquares =
    "o low\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
    "o high\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 8 7 6 5\n";

TEST(FormFactorsCommand, WritesTheMatrixWithRowSums) {
  const auto folder = test_folder();
  write_text(folder / "s.obj", kSquares);
  const auto run = run_tenku("form-factors s.obj --up z --out F.csv --json --quiet", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const ReferenceTable table((folder / "F.csv").string());
  ASSERT_EQ(table.size(), 4U);
  EXPECT_EQ(table.text(1, "from"), "low");
  EXPECT_EQ(table.text(1, "to"), "high");
  // Howell's catalogue, C-11.
  EXPECT_NEAR(table.number(1, "form_factor"), 0.199824895698387, 1e-9);
  EXPECT_GE(table.number(1, "error"), 0.0);
  const auto summary = nlohmann::json::parse(run.out);
  EXPECT_NEAR(summary["row_sums"]["low"].get<double>(), 0.199824895698387, 1e-9);
  EXPECT_LT(summary["reciprocity_defect"].get<double>(), 1e-9);
}

TEST(FormFactorsCommand, TellsWhatMeetsBacksFromWhatEscapes) {
  const auto folder = test_folder();
  std::string turned = kSquares;
  turned.replace(turned.find("f 8 7 6 5"), 9, "f 5 6 7 8");
  write_text(folder / "s.obj", turned);
  for (const std::string method : {"analytic", "hemisphere-scanline"}) {
    const auto run = run_tenku(
        "form-factors s.obj --up z --out F.csv --json --resolution 64 --method " + method, folder);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto summary = nlohmann::json::parse(run.out);
    EXPECT_EQ(summary["row_sums"]["low"].get<double>(), 0.0);
    EXPECT_NEAR(summary["to_backs"]["low"].get<double>(), 0.199824895698387, 0.002) << method;
    EXPECT_EQ(summary["to_backs"]["high"].get<double>(), 0.0);  // looks away
    EXPECT_NE(run.err.find("meets backs"), std::string::npos) << run.err;
  }
}

TEST(FormFactorsCommand, TakesEveryMethod) {
  const auto folder = test_folder();
  write_text(folder / "s.obj", kSquares);
  for (const std::string method :
       {"hemisphere-scanline", "hemisphere-zbuffer", "hemisphere-rays", "hemicube"}) {
    const auto run = run_tenku(
        "form-factors s.obj --up z --resolution 64 --quiet --out F.csv --method " + method, folder);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const ReferenceTable table((folder / "F.csv").string());
    EXPECT_NEAR(table.number(1, "form_factor"), 0.199824895698387, 0.002) << method;
  }
}

TEST(FormFactorsCommand, RefusesWhatIsWrong) {
  const auto folder = test_folder();
  write_text(folder / "s.obj", kSquares);
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"--method hemisphere-scanlines", "'hemisphere-scanline'"},
      {"--resolution 0", "resolution"},
      {"--polyline 90", "45"},
      {"--by materal", "'material'"},
      {"--tolerance 0", "--tolerance"},
      {"--out nowhere/F.csv", "nowhere"}};
  for (const auto& [options, word] : wrong) {
    const auto run = run_tenku(
        "form-factors s.obj " + options + (options.starts_with("--out") ? "" : " --out F.csv"),
        folder);
    EXPECT_EQ(run.exit_code, 2) << options << run.err;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "F.csv"));
  }
  const auto help = run_tenku("form-factors --help", folder);
  EXPECT_NE(help.out.find("Example:\n  tenku form-factors"), std::string::npos);
}

}  // namespace
}  // namespace tenku
