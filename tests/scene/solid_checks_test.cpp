// Solids among others, by val3dity's kinds.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

using nlohmann::json;

/// A box as the shell of a solid in CityJSON.
struct Box {
  Vec3 low, high;
};

class Model {
 public:
  /// @param shells  of one solid, the outer one first; each of one box or more
  void add(const std::string& id, const std::vector<std::vector<Box>>& shells,
           const std::string& type = "Building") {
    json solid = json::array();
    for (std::size_t k = 0; k < shells.size(); ++k) {
      json shell = json::array();
      for (const Box& box : shells[k]) add_faces(box, k > 0, shell);
      solid.push_back(shell);
    }
    objects_[id] = {{"type", type},
                    {"geometry", {{{"type", "Solid"}, {"lod", "2"}, {"boundaries", solid}}}}};
  }
  json& object(const std::string& id) { return objects_[id]; }

  Scene read() const {
    const json model{
        {"type", "CityJSON"},
        {"version", "2.0"},
        {"metadata", {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/7415"}}},
        {"transform", {{"scale", {0.01, 0.01, 0.01}}, {"translate", {85000, 447000, 0}}}},
        {"CityObjects", objects_},
        {"vertices", vertices_}};
    return read_text("a.city.json", model.dump());
  }

  std::size_t vertex(Vec3 p) {
    const json at{std::lround(100 * p.x), std::lround(100 * p.y), std::lround(100 * p.z)};
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      if (vertices_[k] == at) return k;
    }
    vertices_.push_back(at);
    return vertices_.size() - 1;
  }

 private:
  void add_faces(const Box& box, bool is_cavity, json& shell) {
    static constexpr std::array<std::array<int, 4>, 6> kFaces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
    for (const auto& face : kFaces) {
      json ring = json::array();
      for (const int k : face) {
        ring.push_back(vertex({(k & 1) ? box.high.x : box.low.x, (k & 2) ? box.high.y : box.low.y,
                               (k & 4) ? box.high.z : box.low.z}));
      }
      if (is_cavity) std::reverse(ring.begin(), ring.end());
      shell.push_back({ring});
    }
  }

  json objects_ = json::object(), vertices_ = json::array();
};

const Box kHouse{{0, 0, 0}, {10, 10, 6}};

Box moved(const Box& box, Vec3 by) { return {box.low + by, box.high + by}; }

TEST(SolidChecks, BuildingsInOneAnotherAreTold) {
  struct Case {
    const char* what;
    Box other;
    bool overlaps;
  };
  for (const Case& c : {Case{"apart", moved(kHouse, {20, 0, 0}), false},
                        {"wall to wall", moved(kHouse, {10, 0, 0}), false},
                        {"on the roof", {{2, 2, 6}, {8, 8, 9}}, false},
                        {"corner to corner", moved(kHouse, {10, 10, 0}), false},
                        {"walls 10 cm in one another", moved(kHouse, {9.9, 0, 0}), false},
                        {"half in it", moved(kHouse, {5, 3, 0}), true},
                        {"half a metre in it", moved(kHouse, {9.5, 0, 0}), true},
                        {"inside", {{4, 4, 1}, {6, 6, 3}}, true},
                        {"through it", {{-5, 4, 2}, {15, 6, 4}}, true},
                        {"a mast through its roof", {{4, 4, 5}, {5, 5, 20}}, true},
                        {"the same", kHouse, true}}) {
    for (const bool is_part : {false, true}) {
      Model model;
      model.add("a", {{kHouse}});
      model.add("b", {{c.other}}, is_part ? "BuildingPart" : "Building");
      const Scene scene = model.read();
      EXPECT_EQ(count_of(scene, "overlapping_buildings"), c.overlaps ? 1U : 0U) << c.what;
    }
  }
}

TEST(SolidChecks, WhatBelongsInABuildingIsNoOverlap) {
  Model model;
  model.add("a", {{kHouse}});
  model.add("chimney", {{{{4, 4, 5}, {5, 5, 8}}}}, "BuildingInstallation");
  EXPECT_EQ(count_of(model.read(), "overlapping_buildings"), 0U);
}

TEST(SolidChecks, ShellsInPartsAreTold) {
  Model one;
  one.add("a", {{kHouse}});
  EXPECT_EQ(count_of(one.read(), "shell_in_parts"), 0U);
  Model two;
  two.add("a", {{kHouse, moved(kHouse, {30, 0, 0})}});
  EXPECT_EQ(count_of(two.read(), "shell_in_parts"), 1U);
}

TEST(SolidChecks, CavitiesOutsideAreTold) {
  Model inside;
  inside.add("a", {{kHouse}, {{{3, 3, 1}, {6, 6, 4}}}});
  EXPECT_EQ(count_of(inside.read(), "inner_shell_outside"), 0U);
  Model outside;
  outside.add("a", {{kHouse}, {{{13, 3, 1}, {16, 6, 4}}}});
  EXPECT_EQ(count_of(outside.read(), "inner_shell_outside"), 1U);
  Model through;
  through.add("a", {{kHouse}, {{{8, 3, 1}, {12, 6, 4}}}});
  EXPECT_EQ(count_of(through.read(), "inner_shell_outside"), 1U);
}

TEST(SolidChecks, ObjectsWithoutSurfacesAreTold) {
  Model model;
  model.add("a", {{kHouse}});
  model.object("parent") = {{"type", "Building"}, {"children", {"part"}}};
  model.add("part", {{moved(kHouse, {30, 0, 0})}}, "BuildingPart");
  model.object("part")["parents"] = {"parent"};
  EXPECT_EQ(count_of(model.read(), "no_geometry"), 0U);
  model.object("empty") = {{"type", "Building"}, {"geometry", json::array()}};
  const Scene scene = model.read();
  ASSERT_EQ(count_of(scene, "no_geometry"), 1U);
  for (const Finding& f : scene.findings) {
    if (f.code == "no_geometry") {
      EXPECT_EQ(f.object, "empty");
    }
  }
}

/// A roof with holes, by their corners.
Scene roof_with(const std::vector<std::array<double, 4>>& holes) {
  Model model;
  model.add("a", {{kHouse}});
  json rings = json::array();
  const auto ring = [&](double x0, double y0, double x1, double y1) {
    rings.push_back({model.vertex({x0, y0, 6}), model.vertex({x1, y0, 6}),
                     model.vertex({x1, y1, 6}), model.vertex({x0, y1, 6})});
  };
  ring(0, 0, 10, 10);
  for (const auto& h : holes) ring(h[0], h[1], h[2], h[3]);
  model.object("a")["geometry"][0]["boundaries"][0][1] = rings;
  return model.read();
}

TEST(SolidChecks, HolesOutsideTheirRingAreTold) {
  EXPECT_EQ(count_of(roof_with({{2, 2, 4, 4}, {6, 6, 8, 8}}), "stray_hole"), 0U);
  EXPECT_EQ(count_of(roof_with({{0, 2, 4, 4}}), "stray_hole"), 0U);  // touches it
  EXPECT_EQ(count_of(roof_with({{12, 2, 14, 4}}), "stray_hole"), 1U);
  EXPECT_EQ(count_of(roof_with({{8, 2, 12, 4}}), "stray_hole"), 1U);
  EXPECT_EQ(count_of(roof_with({{2, 2, 8, 8}, {4, 4, 6, 6}}), "stray_hole"), 1U);
}

}  // namespace
}  // namespace tenku
