// Files that the fuzzers came upon (tests/robustness/fuzz), of which each went a way of its own
// through its reader: read or refused.
#include <gtest/gtest.h>

#include "tests/robustness/refusal.h"

namespace tenku {
namespace {

TEST(FuzzedFiles, AreReadOrRefused) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           TENKU_SOURCE_DIR "/tests/robustness/fuzz/found")) {
    if (!entry.is_regular_file()) continue;
    SCOPED_TRACE(entry.path());
    refusal_of(entry.path());
    ++count;
  }
  EXPECT_GE(count, 80U);
}

}  // namespace
}  // namespace tenku
