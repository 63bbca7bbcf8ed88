// Runs the cells of the stability matrix and sees that none is empty.
#include "stability/matrix.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>

#include "support/run_program.h"

namespace tenku::stability {
namespace {

namespace fs = std::filesystem;

std::vector<Cell> all_cells() {
  std::vector<Cell> all;
  for (auto part : {sky_cells, room_cells, exchange_cells, input_cells, other_cells}) {
    for (Cell& cell : part()) all.push_back(std::move(cell));
  }
  return all;
}

void tell(const Cell& cell, const Outcome& outcome) {
  fmt::print("[ CELL ] {}|{}|{}|{}\n", cell.method, cell.hazard, outcome.kind, outcome.note);
}

std::vector<Cell> cells_that_run() {
  std::vector<Cell> result;
  for (Cell& cell : all_cells()) {
    if (cell.run) result.push_back(std::move(cell));
  }
  return result;
}

class StabilityCell : public testing::TestWithParam<Cell> {};

TEST_P(StabilityCell, IsRightOrTold) {
  const Cell& cell = GetParam();
  if (cell.takes_minutes && std::getenv("TENKU_STABILITY_LONG") == nullptr) {
    GTEST_SKIP() << "make stability";
  }
  const fs::path folder =
      fs::path(testing::TempDir()) / ("stability." + cell.method + "." + cell.hazard);
  fs::remove_all(folder);
  fs::create_directories(folder);
  const Outcome outcome = cell.run(folder);
  tell(cell, HasFailure() ? Outcome{"WRONG", outcome.note} : outcome);
  EXPECT_FALSE(outcome.kind.empty());
}

INSTANTIATE_TEST_SUITE_P(Matrix, StabilityCell, testing::ValuesIn(cells_that_run()),
                         [](const testing::TestParamInfo<Cell>& of) {
                           return of.param.method + "_" + of.param.hazard;
                         });

/// "Suite.Name" of all tests below tests/.
std::set<std::string> tests_in_sources() {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(TENKU_SOURCE_DIR "/tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = testing_support::contents_of(entry.path());
    for (std::size_t at = text.find("\nTEST"); at != std::string::npos;
         at = text.find("\nTEST", at + 1)) {
      const std::size_t open = text.find('(', at), comma = text.find(',', open),
                        close = text.find(')', open);
      if (comma >= close) continue;
      names.insert(text.substr(open + 1, comma - open - 1) + "." +
                   text.substr(comma + 2, close - comma - 2));
    }
  }
  return names;
}

TEST(StabilityMatrix, HasNoEmptyCellAndNoneTwice) {
  std::map<std::string, int> count;
  for (const Cell& cell : all_cells()) {
    ++count[cell.method + "|" + cell.hazard];
    EXPECT_EQ(int{cell.run != nullptr} + !cell.tested_by.empty() + !cell.does_not_apply.empty(), 1)
        << cell.method << " " << cell.hazard;
  }
  for (const Heading& method : methods()) {
    for (const Heading& hazard : hazards()) {
      EXPECT_EQ(count[method.name + "|" + hazard.name], 1) << method.name << " " << hazard.name;
    }
  }
  EXPECT_EQ(count.size(), methods().size() * hazards().size());
}

TEST(StabilityMatrix, TestsItNamesExist) {
  const std::set<std::string> tests = tests_in_sources();
  for (const Cell& cell : all_cells()) {
    if (!cell.tested_by.empty()) {
      EXPECT_TRUE(tests.contains(cell.tested_by)) << cell.tested_by;
      tell(cell, {"tested", cell.tested_by});
    } else if (!cell.does_not_apply.empty()) {
      tell(cell, {"none", cell.does_not_apply});
    }
  }
  for (const Heading& method : methods())
    fmt::print("[ METHOD ] {}|{}\n", method.name, method.title);
  for (const Heading& hazard : hazards())
    fmt::print("[ HAZARD ] {}|{}\n", hazard.name, hazard.title);
}

}  // namespace
}  // namespace tenku::stability
