#include "core/suggest.h"

#include <gtest/gtest.h>

#include <array>

namespace tenku {
namespace {

// Published examples of the distance: Wagner and Fischer 1974, Damerau 1964.
TEST(Suggest, EditDistanceCountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("saturday", "sunday"), 3U);
  EXPECT_EQ(edit_distance("ca", "ac"), 1U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("same", "same"), 0U);
}

TEST(Suggest, NamesTheNearestAndOnlyIfItIsNear) {
  constexpr std::array<std::string_view, 3> kWords{"tolerance_percent", "bounces", "seed"};
  EXPECT_EQ(closest_name("tolerence_percent", kWords), "tolerance_percent");
  EXPECT_EQ(closest_name("Bounce", kWords), "bounces");
  EXPECT_EQ(closest_name("sede", kWords), "seed");
  EXPECT_EQ(closest_name("material", kWords), std::nullopt);
  EXPECT_EQ(closest_name(std::string(100000, 's'), kWords), std::nullopt);
  EXPECT_EQ(suggestion("sed", kWords), "; did you mean 'seed'?");
  EXPECT_EQ(suggestion("xyz", kWords), "");
}

}  // namespace
}  // namespace tenku
