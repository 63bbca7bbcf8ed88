// Grids of heights as triangles: each point against the triangle that covers it, edges against
// corners on them.
#include "scene/thin_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

namespace tenku {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct Heights {
  std::size_t rows, columns;
  std::vector<Vec3> points;

  HeightGrid grid() const { return {rows, columns, points}; }
};

/// x = column, y = -row, as in a raster from north to south.
template <class Height>
Heights heights_of(std::size_t rows, std::size_t columns, const Height& height) {
  Heights made{rows, columns, {}};
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const auto px = static_cast<double>(x), py = -static_cast<double>(y);
      made.points.push_back({px, py, height(px, py)});
    }
  }
  return made;
}

double twice_area(Vec3 a, Vec3 b, Vec3 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// [point] how far its height is from the triangles over it; absent where there are none.
std::map<std::size_t, double> misses(const Heights& heights, const Triangles& triangles) {
  std::map<std::size_t, double> found;
  for (const auto& t : triangles) {
    const Vec3 a = heights.points[t[0]], b = heights.points[t[1]], c = heights.points[t[2]];
    const double whole = twice_area(a, b, c);
    for (double y = std::min({a.y, b.y, c.y}); y <= std::max({a.y, b.y, c.y}); ++y) {
      for (double x = std::min({a.x, b.x, c.x}); x <= std::max({a.x, b.x, c.x}); ++x) {
        const Vec3 p{x, y, 0.0};
        const double u = twice_area(p, b, c) / whole, v = twice_area(a, p, c) / whole,
                     w = twice_area(a, b, p) / whole;
        if (std::min({u, v, w}) < -1e-12) continue;
        const std::size_t k =
            static_cast<std::size_t>(-y) * heights.columns + static_cast<std::size_t>(x);
        const double miss = std::abs(heights.points[k].z - (u * a.z + v * b.z + w * c.z));
        found[k] = std::max(found[k], std::isnan(miss) ? 1e9 : miss);
      }
    }
  }
  return found;
}

/// Corners that lie within edges of other triangles.
std::size_t hanging_corners(const Heights& heights, const Triangles& triangles) {
  std::set<std::uint32_t> used;
  for (const auto& t : triangles) used.insert(t.begin(), t.end());
  std::size_t count = 0;
  for (const auto& t : triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      const Vec3 a = heights.points[t[e]], b = heights.points[t[(e + 1) % 3]];
      const double steps = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
      for (double s = 1.0; s < steps; ++s) {
        const double x = a.x + s / steps * (b.x - a.x), y = a.y + s / steps * (b.y - a.y);
        const auto k = static_cast<std::uint32_t>(static_cast<std::size_t>(-y) * heights.columns +
                                                  static_cast<std::size_t>(x));
        count += used.count(k);
      }
    }
  }
  return count;
}

double area_of(const Heights& heights, const Triangles& triangles) {
  double sum = 0.0;
  for (const auto& t : triangles) {
    const double area =
        twice_area(heights.points[t[0]], heights.points[t[1]], heights.points[t[2]]);
    EXPECT_GT(area, 0.0);
    sum += 0.5 * area;
  }
  return sum;
}

double hills(double x, double y) {
  return 9.0 * std::sin(x / 7.0) * std::cos(y / 11.0) + 0.02 * x * std::sin(y);
}

TEST(ThinGrid, APlaneIsAFewTriangles) {
  const Heights plane = heights_of(33, 65, [](double x, double y) { return 0.5 * x - y; });
  const Triangles triangles = thin_grid(plane.grid(), [](Vec3, std::size_t) { return 1e-9; });
  EXPECT_EQ(triangles.size(), 4U);
  EXPECT_DOUBLE_EQ(area_of(plane, triangles), 32.0 * 64.0);
}

TEST(ThinGrid, NothingAllowedKeepsAllPoints) {
  const Heights rough =
      heights_of(20, 31, [](double x, double y) { return hills(x + 0.37, y - 0.21); });
  const Triangles triangles = thin_grid(rough.grid(), [](Vec3, std::size_t) { return 0.0; });
  EXPECT_EQ(triangles.size(), 2U * 19U * 30U);
}

TEST(ThinGrid, NoPointIsFartherThanAllowed) {
  for (const auto& [rows, columns] : {std::pair{50, 50}, {17, 200}, {129, 40}, {2, 90}, {65, 65}}) {
    SCOPED_TRACE(std::to_string(rows) + " by " + std::to_string(columns));
    const Heights rough =
        heights_of(static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), hills);
    const double cells = (rows - 1.0) * (columns - 1.0);
    std::size_t before = 0;
    for (const double allowed : {3.0, 0.7, 0.1}) {
      const Triangles triangles =
          thin_grid(rough.grid(), [&](Vec3, std::size_t) { return allowed; });
      const auto found = misses(rough, triangles);
      EXPECT_EQ(found.size(), rough.points.size());
      for (const auto& [k, miss] : found) EXPECT_LE(miss, allowed + 1e-5) << k;
      EXPECT_NEAR(area_of(rough, triangles), cells, 1e-9 * cells);
      EXPECT_EQ(hanging_corners(rough, triangles), 0U);
      EXPECT_GE(triangles.size(), before);
      EXPECT_LE(triangles.size(), static_cast<std::size_t>(2.0 * cells));
      before = triangles.size();
      if (allowed == 3.0 && std::min(rows, columns) > 2) {
        EXPECT_LT(static_cast<double>(triangles.size()), 0.5 * cells);
      }
    }
  }
}

TEST(ThinGrid, WhatIsAllowedGrowsWithTheDistance) {
  const Heights rough = heights_of(129, 129, hills);
  const auto allowed = [](Vec3 p, std::size_t reach) {
    return 0.05 * std::max(0.0, p.x - static_cast<double>(reach));
  };
  const Triangles triangles = thin_grid(rough.grid(), allowed);
  for (const auto& [k, miss] : misses(rough, triangles)) {
    EXPECT_LE(miss, 0.05 * rough.points[k].x + 1e-5);
  }
  EXPECT_EQ(hanging_corners(rough, triangles), 0U);
  EXPECT_LT(triangles.size(), 8000U);  // of 32,768
}

TEST(ThinGrid, NoTriangleCoversAHole) {
  std::mt19937 random(7);
  Heights holed = heights_of(70, 90, hills);
  for (int hole = 0; hole < 12; ++hole) {
    const std::size_t x = random() % 80, y = random() % 60, size = 1 + random() % 9;
    for (std::size_t k = 0; k < size * size; ++k) {
      holed.points[(y + k / size) * 90 + x + k % size].z = std::nan("");
    }
  }
  const Triangles triangles = thin_grid(holed.grid(), [](Vec3, std::size_t) { return 1.0; });
  const auto found = misses(holed, triangles);
  for (const auto& [k, miss] : found) EXPECT_LE(miss, 1.0 + 1e-5) << k;
  EXPECT_EQ(hanging_corners(holed, triangles), 0U);
  // All full cells are covered; of those with a hole at one corner, half may be.
  double full = 0.0, one_missing = 0.0;
  for (std::size_t y = 0; y + 1 < 70; ++y) {
    for (std::size_t x = 0; x + 1 < 90; ++x) {
      int missing = 0;
      for (const std::size_t k : {y * 90 + x, y * 90 + x + 1, y * 90 + x + 90, y * 90 + x + 91}) {
        missing += std::isnan(holed.points[k].z) ? 1 : 0;
      }
      full += missing == 0 ? 1.0 : 0.0;
      one_missing += missing == 1 ? 1.0 : 0.0;
    }
  }
  EXPECT_GE(area_of(holed, triangles), full);
  EXPECT_LE(area_of(holed, triangles), full + 0.5 * one_missing);
}

}  // namespace
}  // namespace tenku
