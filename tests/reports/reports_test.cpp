#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "output/image_writer.h"
#include "reports/histogram.h"
#include "reports/html.h"
#include "reports/plan_map.h"
#include "reports/report.h"
#include "reports/sun_path_diagram.h"

namespace tenku {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Html, EscapesMarkupAndReplacesWhatIsNoText) {
  EXPECT_EQ(escaped("<script>\"&'"), "&lt;script&gt;&quot;&amp;&#39;");
  EXPECT_EQ(escaped("建物 °"), "建物 °");
  EXPECT_EQ(escaped(std::string("a\0b\x1b", 4)),
            "a\xef\xbf\xbd"
            "b\xef\xbf\xbd");
  EXPECT_EQ(
      escaped("\xff|\xc0\xaf|\xed\xa0\x80|\xe5"),
      "\xef\xbf\xbd|\xef\xbf\xbd\xef\xbf\xbd|\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd|\xef\xbf\xbd");
}

// Test vectors of RFC 4648, section 10.
TEST(Html, Base64MeetsTheStandardsExamples) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

ReportContent hostile_content() {
  const std::string evil = "</style><script>alert(1)</script>\" onload=\"x";
  ReportContent c;
  c.title = c.place = c.time_in_words = c.sky_in_words = c.summary = c.error_statement = evil;
  c.sun_altitude = Angle::degrees(40.0);
  c.figures = {{evil, evil, evil, evil, evil}};
  c.view = ReportPicture{png_bytes(Image8(2, 2)), evil, evil};
  c.plan = c.view;
  c.band_limits = {100.0};
  c.surfaces = {{evil, 1, 2, 3, 4, 5, {0.25, 0.75}}};
  c.findings = {{evil, Severity::Warning, "建物" + evil, evil, evil, evil, 3}};
  c.method = {evil};
  c.settings = c.versions = {{evil, evil}};
  return c;
}

TEST(Report, NoTextOfTheUserBecomesMarkup) {
  const std::string html = report_html(hostile_content());
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("\" onload"), std::string::npos);
  EXPECT_EQ(count_of(html, "</style>"), 1U);
  EXPECT_NE(html.find("建物&lt;/style&gt;"), std::string::npos);
}

TEST(Report, LoadsNothingFromElsewhere) {
  const std::string html = report_html(hostile_content());
  EXPECT_EQ(html.find("http:"), std::string::npos);
  EXPECT_EQ(html.find("https:"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
  EXPECT_EQ(count_of(html, "src=\"data:image/png;base64,iVBORw0KGgo"), 2U);
  EXPECT_EQ(count_of(html, "<img alt="), 2U);
}

TEST(Report, LeavesOutWhatIsNotThere) {
  const std::string html = report_html({});
  EXPECT_EQ(html.find("Key figures"), std::string::npos);
  EXPECT_EQ(html.find("<img"), std::string::npos);
  EXPECT_NE(html.find("Nothing wrong was found"), std::string::npos);
}

TEST(Report, SaysHowManyFindingsItDoesNotShow) {
  ReportContent c;
  c.findings.assign(100, {"x", Severity::Note, "o", "", "w", "", 2});
  const std::string html = report_html(c);
  EXPECT_NE(html.find("200 in all, in 100 entries"), std::string::npos);
  EXPECT_NE(html.find("And 40 more"), std::string::npos);
}

TEST(Report, NamesTheSunsPlace) {
  EXPECT_EQ(compass_word(Angle::degrees(0.0)), "north");
  EXPECT_EQ(compass_word(Angle::degrees(355.0)), "north");
  EXPECT_EQ(compass_word(Angle::degrees(112.5)), "east-southeast");
  EXPECT_EQ(compass_word(Angle::degrees(270.0)), "west");
  EXPECT_NE(sun_sentence({}, Angle::degrees(-5.0)).find("below the horizon"), std::string::npos);
}

PlanMap ground_of_two_halves() {
  PlanMap map;
  map.scale = ValueScale{0.0, 100.0};
  map.title = "t";
  map.caption = "c";
  map.width = 600;
  map.extent = PlanExtent{-100, -100, 100, 100};
  const auto quad = [&](double west, double south, double value) {
    const Vec3 a{west, south, 0}, b{west + 100, south, 0}, c{west + 100, south + 100, 0},
        d{west, south + 100, 0};
    map.ground.push_back({{a, b, c}, {value, value, value}});
    map.ground.push_back({{a, c, d}, {value, value, value}});
  };
  quad(-100, -100, 0.0);  // south-west
  quad(0, -100, 25.0);    // south-east
  quad(-100, 0, 50.0);    // north-west
  quad(0, 0, 100.0);      // north-east
  return map;
}

// The map lies between the margins of 36 pixels, its top at 74.
Rgb8 at_share(const Image8& sheet, double across, double down) {
  const double side = sheet.width - 72.0;
  return sheet.at(static_cast<int>(36 + across * side), static_cast<int>(74 + down * side));
}

TEST(PlanMap, HasNorthAtTheTopAndEastToTheRight) {
  const Image8 sheet = plan_map(ground_of_two_halves());
  EXPECT_EQ(at_share(sheet, 0.25, 0.25), colour_at(ColourMap::Viridis, 0.5));
  EXPECT_EQ(at_share(sheet, 0.75, 0.25), colour_at(ColourMap::Viridis, 1.0));
  EXPECT_EQ(at_share(sheet, 0.25, 0.75), colour_at(ColourMap::Viridis, 0.0));
  EXPECT_EQ(at_share(sheet, 0.75, 0.75), colour_at(ColourMap::Viridis, 0.25));
}

TEST(PlanMap, GridHasItsFirstRowInTheNorth) {
  PlanMap map;
  map.width = 600;
  map.title = "t";
  map.scale = ValueScale{0.0, 100.0};
  map.extent = PlanExtent{0, 0, 20, 20};
  map.grid = PlanGrid{0, 20, 10, 2, 2, {0, 100, 50, std::nan("")}};
  const Image8 sheet = plan_map(map);
  EXPECT_EQ(at_share(sheet, 0.02, 0.02), colour_at(ColourMap::Viridis, 0.0));
  EXPECT_EQ(at_share(sheet, 0.98, 0.02), colour_at(ColourMap::Viridis, 1.0));
  EXPECT_EQ(at_share(sheet, 0.02, 0.98), colour_at(ColourMap::Viridis, 0.5));
  EXPECT_EQ(at_share(sheet, 0.75, 0.75), (Rgb8{243, 243, 240}));
}

TEST(PlanMap, BuildingsCoverTheGroundInGrey) {
  PlanMap map = ground_of_two_halves();
  map.buildings.push_back({{Vec3{-90, 20, 9}, Vec3{-10, 20, 9}, Vec3{-50, 90, 9}}, 0});
  const Rgb8 c = at_share(plan_map(map), 0.25, 0.25);
  EXPECT_EQ(c.r, c.g);
  EXPECT_EQ(c.g, c.b);
}

TEST(PlanMap, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(plan_map({}), InputError);
  PlanMap map = ground_of_two_halves();
  map.width = 10;
  EXPECT_THROW(plan_map(map), InputError);
  map = ground_of_two_halves();
  map.ground[0].corners[0].x = std::numeric_limits<double>::infinity();
  EXPECT_THROW(plan_map(map), InputError);
}

TEST(SunPath, NorthIsUpAndEastToTheRight) {
  for (const auto p : {SunPathProjection::Stereographic, SunPathProjection::Equidistant}) {
    const SunPathPlace east = sun_path_place({Angle::degrees(90.0), {}}, p);
    EXPECT_NEAR(east.x, 1.0, 1e-12);
    EXPECT_NEAR(east.y, 0.0, 1e-12);
    EXPECT_NEAR(sun_path_place({Angle::degrees(180.0), {}}, p).y, -1.0, 1e-12);
    EXPECT_NEAR(sun_path_place({{}, Angle::degrees(90.0)}, p).y, 0.0, 1e-12);
  }
}

// tan 22.5 degrees = sqrt 2 - 1; a third of the way from the zenith at 60 degrees.
TEST(SunPath, ProjectionsPlaceTheAltitudes) {
  EXPECT_NEAR(sun_path_place({{}, Angle::degrees(45.0)}, SunPathProjection::Stereographic).y,
              std::sqrt(2.0) - 1.0, 1e-12);
  EXPECT_NEAR(sun_path_place({{}, Angle::degrees(60.0)}, SunPathProjection::Equidistant).y,
              1.0 / 3.0, 1e-12);
}

/// Where a text of an SVG picture is drawn.
struct DrawnText {
  double x, y;
};

DrawnText drawn(const std::string& svg, const std::string& text) {
  const auto end = svg.find(">" + text + "</text>");
  EXPECT_NE(end, std::string::npos) << text;
  const std::string tag = svg.substr(svg.rfind('<', end), end - svg.rfind('<', end));
  const auto number = [&](const std::string& name) {
    return std::stod(tag.substr(tag.find(" " + name + "=\"") + name.size() + 3));
  };
  return {number("x"), number("y")};
}

// At the equinox the sun rises in the east, where the letter stands.
TEST(SunPath, KeepsTheLettersOfTheCompassClearOfTheDays) {
  SunPathDiagram d;
  d.days = {{"21 Sep",
             {{Angle::degrees(90.0), Angle::degrees(0.3)},
              {Angle::degrees(180.0), Angle::degrees(47.0)},
              {Angle::degrees(270.0), Angle::degrees(0.3)}}}};
  const std::string svg = sun_path_svg(d);
  const DrawnText day = drawn(svg, "21 Sep"), east = drawn(svg, "E");
  // Six letters of 12 units, none wider than high; E, 17 units, is drawn about its middle.
  EXPECT_GT(east.x - 8.5, day.x + 6 * 0.6 * 12.0);
  EXPECT_LT(east.x + 8.5, 700.0);
}

TEST(SunPath, KeepsTheHoursClearOfTheSun) {
  SunPathDiagram d;
  d.instant = DiagramPoint{Angle::degrees(127.0), Angle::degrees(62.0)};
  d.hours = {{"10", {*d.instant}}};
  const std::string svg = sun_path_svg(d);
  const auto disc = svg.find("class=\"sun\" cx=\"");
  const double x = std::stod(svg.substr(disc + 16));
  const double y = std::stod(svg.substr(svg.find("cy=\"", disc) + 4));
  const DrawnText hour = drawn(svg, "10");  // 12 units high, its baseline 4.5 below its middle
  EXPECT_GT(std::hypot(hour.x - x, hour.y - 4.5 - y), 9.0 + 6.0);
}

TEST(SunPath, NamesItsProjection) {
  SunPathDiagram d;
  EXPECT_NE(sun_path_svg(d).find("stereographic projection"), std::string::npos);
  d.projection = SunPathProjection::Equidistant;
  EXPECT_NE(sun_path_svg(d).find("equidistant projection"), std::string::npos);
}

TEST(SunPath, DrawsOnlyWhatIsAboveTheHorizonAndEscapesLabels) {
  const auto deg = [](double v) { return Angle::degrees(v); };
  SunPathDiagram d;
  d.title = "<b>";
  d.days = {{"<21>", {{deg(80), deg(-10)}, {deg(100), deg(10)}, {deg(120), deg(-10)}}},
            {"night", {{deg(80), deg(-10)}, {deg(100), deg(-5)}}}};
  d.instant = DiagramPoint{deg(100), deg(-1)};
  d.instant_label = "now";
  const std::string svg = sun_path_svg(d);
  EXPECT_EQ(count_of(svg, "class=\"day\""), 1U);
  EXPECT_NE(svg.find("&lt;21&gt;"), std::string::npos);
  EXPECT_EQ(svg.find("night"), std::string::npos);
  EXPECT_EQ(svg.find("class=\"sun\""), std::string::npos);
  EXPECT_NE(svg.find("d=\"M560 310L"), std::string::npos) << "cut at the horizon, due east";
}

TEST(Histogram, BarsHaveTheSharesOfTheirWeights) {
  const std::vector<double> values{10.0, 90.0, std::nan("")}, weights{3.0, 1.0, 5.0};
  const std::string svg = histogram_svg({"t", "Illuminance", "lx", values, weights, false, 10});
  EXPECT_EQ(count_of(svg, "<rect"), 2U);
  EXPECT_NE(svg.find("height=\"206.25\""), std::string::npos) << "75 of 80 %, 220 high";
  EXPECT_NE(svg.find("height=\"68.75\""), std::string::npos) << "25 of 80 %";
  EXPECT_NE(histogram_svg({"t", "q", "u", {}, {}}).find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace tenku
