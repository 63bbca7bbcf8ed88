#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/low_discrepancy.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/vec3.h"

namespace tenku {
namespace {

TEST(Vec3, AzimuthIsClockwiseFromNorth) {
  EXPECT_NEAR(azimuth_of({1, 0, 0}).in_degrees(), 90.0, 1e-12);
  EXPECT_NEAR(azimuth_of({0, -1, 0}).in_degrees(), 180.0, 1e-12);
  EXPECT_NEAR(azimuth_of({-1, 0, 0}).in_degrees(), 270.0, 1e-12);
}

TEST(Vec3, TangentFrameIsRightHandedEverywhere) {
  SampleRandom random(1, 2, 3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 n =
        normalized({random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5});
    const auto [t, b] = tangent_frame(n);
    EXPECT_NEAR(length(cross(t, b) - n), 0.0, 1e-12);
  }
}

// Each elementary interval of a (0,2)-sequence in base 2 holds exactly one point.
TEST(Sobol, FirstTwoDimensionsAreA02Net) {
  for (unsigned bits = 0; bits <= 6; ++bits) {
    std::set<std::pair<int, int>> cells;
    for (std::uint32_t i = 0; i < 64; ++i) {
      cells.insert({static_cast<int>(std::ldexp(sobol_owen(i, 0, 7), static_cast<int>(bits))),
                    static_cast<int>(std::ldexp(sobol_owen(i, 1, 7), static_cast<int>(6 - bits)))});
    }
    EXPECT_EQ(cells.size(), 64U) << bits;
  }
}

TEST(Sobol, IntegratesASmoothProductBetterThanChance) {
  double worst = 0.0;
  for (std::uint64_t scramble = 0; scramble < 20; ++scramble) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < 1024; ++i) {
      double product = 1.0;
      for (unsigned d = 0; d < 4; ++d) product *= 2.0 * sobol_owen(i, d, scramble);
      sum += product;
    }
    worst = std::max(worst, std::abs(sum / 1024.0 - 1.0));
  }
  EXPECT_LT(worst, 0.02);  // plain random numbers: standard error 0.046
}

TEST(Parallel, SumsHaveTheSameBitsForAnyNumberOfThreads) {
  const auto sum = [](unsigned threads) {
    const ThreadLimit limit(threads);
    return parallel_sum(100000, 64, [](IndexRange r) {
      double s = 0.0;
      for (std::size_t i = r.begin; i < r.end; ++i) s += std::sin(static_cast<double>(i));
      return s;
    });
  };
  EXPECT_EQ(sum(1), sum(2));
}

TEST(AtomicFile, LeavesNothingBehindWithoutCommit) {
  const auto folder = std::filesystem::temp_directory_path() / "tenku_atomic";
  std::filesystem::create_directories(folder);
  {
    AtomicFile file(folder / "a.txt");
    std::ofstream(file.path()) << "half";
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  write_whole_file(folder / "a.txt", "whole");
  EXPECT_EQ(std::filesystem::file_size(folder / "a.txt"), 5U);
  EXPECT_THROW(write_whole_file(folder / "no" / "a.txt", "x"), InputError);
  EXPECT_THROW(write_whole_file(folder, "x"), InputError);
  std::filesystem::remove_all(folder);
}

TEST(AtomicFile, FullDiskIsAResourceError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const auto folder = std::filesystem::temp_directory_path() / "tenku_full";
  std::filesystem::create_directories(folder);
  AtomicFile file(folder / "a.txt");
  std::filesystem::create_symlink("/dev/full", file.path());
  std::FILE* out = std::fopen(file.path().c_str(), "wb");
  std::fputs("x", out);
  EXPECT_NE(std::fclose(out), 0);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace tenku
