#include "output/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/units.h"
#include "output/map_furniture.h"
#include "output/stroke_font.h"

namespace tenku {
namespace {

double ink(const Image8& image) {
  double sum = 0.0;
  for (const Rgb8 c : image.pixels) sum += (255 - c.r) / 255.0;
  return sum;
}

TEST(Canvas, AFilledShapeHasTheInkOfItsArea) {
  Canvas canvas(40, 40);
  const PixelPosition triangle[] = {{3.3, 4.1}, {33.7, 9.2}, {12.4, 35.5}};
  canvas.fill(triangle, {0, 0, 0});
  const double area = 0.5 * std::abs(30.4 * 31.4 - 9.1 * 5.1);
  EXPECT_NEAR(ink(canvas.image()), area, 0.01 * area);  // five scan lines a pixel row
}

TEST(Canvas, ALineHasTheInkOfItsLengthAndWidth) {
  Canvas canvas(60, 60);
  const PixelPosition line[] = {{10, 12}, {50, 42}};
  canvas.line(line, {3.0, {0, 0, 0}});
  const double area = 50.0 * 3.0 + kPi * 1.5 * 1.5;  // with round ends
  EXPECT_NEAR(ink(canvas.image()), area, 0.02 * area);
}

TEST(Canvas, CutsOffWhatLiesOutside) {
  Canvas canvas(10, 10);
  const PixelPosition far[] = {{-1e6, -1e6}, {1e6, -1e6}, {1e6, 1e6}, {-1e6, 1e6}};
  canvas.fill(far, {0, 0, 0});
  EXPECT_NEAR(ink(canvas.image()), 100.0, 1e-6);
  canvas.text({-500, 5}, "outside", {20.0});
  canvas.paste(Image8(30, 30, {255, 255, 255}), -5, -5);
  EXPECT_NEAR(ink(canvas.image()), 0.0, 1e-6);
}

TEST(Canvas, TextStandsOnItsBaselineAndAligns) {
  Canvas canvas(200, 60);
  canvas.text({100, 40}, "HH", {30.0, {0, 0, 0}, false, TextAlign::Right});
  int top = 60, bottom = 0, right = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 200; ++x) {
      if (canvas.image().at(x, y).r > 128) continue;
      top = std::min(top, y), bottom = std::max(bottom, y), right = std::max(right, x);
    }
  }
  EXPECT_NEAR(bottom + 1, 40.0 + 1.2, 1.0);        // half a stroke below the line
  EXPECT_NEAR(top, 40.0 - 0.7 * 30.0 - 1.2, 1.0);  // capitals are 0.7 em high
  EXPECT_LE(right, 100);
}

TEST(StrokeFont, EveryCharacterHasStrokesOfItsOwn) {
  std::vector<std::vector<PenStroke>> seen;
  for (char c = 33; c < 127; ++c) {
    const PenText pen = pen_text(std::string(1, c));
    EXPECT_FALSE(pen.strokes.empty()) << c;
    EXPECT_GT(pen.width, 0.1) << c;
    for (const PenStroke& stroke : pen.strokes) {
      for (const PixelPosition p : stroke.points) {
        EXPECT_GE(p.x, -0.05) << c;
        EXPECT_LE(p.x, pen.width + 0.02) << c;
        EXPECT_GE(p.y, -0.85) << c;
        EXPECT_LE(p.y, 0.25) << c;
      }
    }
  }
}

TEST(StrokeFont, ReadsUtf8AndSurvivesWhatIsNot) {
  EXPECT_EQ(pen_text("°").strokes.size(), 1U);
  EXPECT_EQ(pen_text("ü").strokes.size(), pen_text("u").strokes.size() + 2);
  const double box = pen_text("東").width;
  EXPECT_NEAR(pen_text("\xff\xe6").width, 2.0 * box, 1e-12);
  EXPECT_EQ(pen_text("").width, 0.0);
}

TEST(Canvas, WrapsAtBlanks) {
  const TextStyle style{10.0};
  const auto lines = wrapped("one two three four", Canvas::width_of("one two ", style), style);
  ASSERT_GE(lines.size(), 2U);
  EXPECT_EQ(lines[0], "one two");
  for (const auto line : lines) EXPECT_FALSE(line.starts_with(' '));
  EXPECT_TRUE(wrapped("", 100.0, style).empty());
}

TEST(MapFurniture, ScaleBarHasARoundLengthThatFits) {
  Canvas canvas(400, 100);
  EXPECT_DOUBLE_EQ(draw_scale_bar(canvas, {20, 50}, 200.0, 0.7), 100.0);  // room for 140 m
  EXPECT_DOUBLE_EQ(draw_scale_bar(canvas, {20, 50}, 200.0, 0.25), 50.0);
  EXPECT_DOUBLE_EQ(draw_scale_bar(canvas, {20, 50}, 200.0, 12.0), 2000.0);
}

}  // namespace
}  // namespace tenku
