// Findings about geometry that methods bear badly, and no finding where there is none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "stability/scene_texts.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

using testing_support::city_of;
using testing_support::ObjText;

Scene read_obj(const ObjText& text) { return read_text("scene.obj", text.text()); }

const Finding* finding(const Scene& scene, const std::string& code) {
  for (const Finding& f : scene.findings) {
    if (f.code == code) return &f;
  }
  return nullptr;
}

constexpr const char* kCodes[] = {"coincident_faces", "far_from_origin", "flat_city",
                                  "huge_triangle"};

TEST(GeometryChecks, GoodScenesHaveNoFindings) {
  ObjText two;  // beside each other, sharing a part of a wall but no whole face
  two.box("low", {0, 0, 0}, {10, 10, 6});
  two.box("high", {10, 0, 0}, {10, 10, 9});
  for (const char* code : kCodes) EXPECT_EQ(finding(read_obj(two), code), nullptr) << code;
  const Scene town = read(TENKU_SOURCE_DIR "/scenes/examples/sapporo_town.city.json");
  for (const char* code : kCodes) EXPECT_EQ(finding(town, code), nullptr) << code;
}

TEST(GeometryChecks, ACommonWallIsToldWithBothItsHouses) {
  for (const double size : {10.0, -10.0}) {  // the second turned inside out: the same normals
    ObjText text;
    text.box("left", {0, 0, 0}, {10, 10, 6});
    text.box("right", {size > 0 ? 10.0 : 20.0, 0, 0}, {size, 10, 6});
    const Scene scene = read_obj(text);
    const Finding* found = finding(scene, "coincident_faces");
    ASSERT_NE(found, nullptr) << size;
    EXPECT_EQ(found->count, 1u);
    EXPECT_EQ(found->object, "left");
    EXPECT_NE(found->what.find("right"), std::string::npos);
    EXPECT_EQ(found->where.substr(0, 5), "10.00") << found->where;
  }
}

TEST(GeometryChecks, AStrayObjectIsNamedAndTheRestIsNot) {
  ObjText text;
  for (int k = 0; k < 5; ++k) text.box(fmt::format("house{}", k), {20.0 * k, 0, 0}, {9, 9, 9});
  text.box("stray", {1e6, 0, 0}, {9, 9, 9});
  const Scene scene = read_obj(text);
  const Finding* found = finding(scene, "far_from_origin");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->object, "stray");
  EXPECT_EQ(found->severity, Severity::Warning);
  EXPECT_EQ(found->where.substr(0, 7), "1000009") << found->where;
  // 2^18 <= 500,000 < 2^19: floats there lie 2^(18 - 23) m = 31.25 mm apart.
  EXPECT_NE(found->what.find("31.2 mm apart"), std::string::npos) << found->what;
}

TEST(GeometryChecks, ACityThatIsFarFromItsFilesOriginIsMovedAndNotTold) {
  ObjText text;
  text.box("a", {500'000, 300'000, 0}, {10, 10, 9});
  text.box("b", {500'100, 300'000, 0}, {10, 10, 9});
  const Scene scene = read_obj(text);
  EXPECT_EQ(finding(scene, "far_from_origin"), nullptr);
  for (const Vec3& v : scene.vertices) EXPECT_LT(length(v), 100.0);
}

TEST(GeometryChecks, ATriangleOfTenKilometresAmongHousesIsTold) {
  ObjText text;
  for (int k = 0; k < 5; ++k) text.box(fmt::format("house{}", k), {20.0 * k, 0, 0}, {9, 9, 9});
  text.triangle("plain", {0, 0, -1}, {10'000, 0, -1}, {0, 4'000, -1});
  const Scene scene = read_obj(text);
  const Finding* found = finding(scene, "huge_triangle");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->object, "plain");
  EXPECT_EQ(found->count, 1u);
  EXPECT_NE(found->what.find("10.8 km"), std::string::npos) << found->what;  // hypot(10, 4)
  ObjText alone;  // nothing to compare with
  alone.triangle("plain", {0, 0, -1}, {10'000, 0, -1}, {0, 4'000, -1});
  EXPECT_EQ(finding(read_obj(alone), "huge_triangle"), nullptr);
}

TEST(GeometryChecks, BuildingsWithoutHeightAreCounted) {
  for (const int flat : {1, 4}) {
    const Scene scene = read_text("flat.city.json", city_of(4, flat));
    const Finding* found = finding(scene, "flat_city");
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->count, static_cast<std::size_t>(flat));
    EXPECT_EQ(found->object, "house0");
  }
  EXPECT_EQ(finding(read_text("good.city.json", city_of(4, 0)), "flat_city"), nullptr);
}

}  // namespace
}  // namespace tenku
