// CityGML: the words of three versions, links, reference systems, levels of detail.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "tests/scene/citygml_texts.h"

namespace tenku {
namespace {

std::string message_of(const std::string& text, const ReadOptions& options = {}) {
  try {
    read_text("a.gml", text, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::size_t surfaces_of(const Scene& scene, SurfaceType type) {
  const auto& types = scene.surfaces.type;
  return static_cast<std::size_t>(std::count(types.begin(), types.end(), type));
}

TEST(CityGml, BoxIsReadWithItsIdTypesAndVolume) {
  for (const char* version : {"1.0", "2.0", "3.0"}) {
    const Scene scene = read_text("a.gml", city_model(box_building(), version), without_ground());
    EXPECT_EQ(scene.format, std::string("CityGML ") + version);
    ASSERT_EQ(scene.objects.size(), 1U);
    EXPECT_EQ(scene.objects[0].id, "b1");
    EXPECT_EQ(scene.objects[0].type, "Building");
    EXPECT_EQ(scene.georeference->crs, "EPSG:28992");
    EXPECT_EQ(surfaces_of(scene, SurfaceType::Roof), 1U);
    EXPECT_EQ(surfaces_of(scene, SurfaceType::Ground), 1U);
    EXPECT_EQ(surfaces_of(scene, SurfaceType::Wall), 4U);
    EXPECT_EQ(scene.lod_triangles.at("2"), 12U);
    // 4 x 3 x 5 m on the map; the map's scale there is 1 - 9e-5.
    EXPECT_NEAR(measures(flatten(scene)).volume, 60.0, 0.03);
    EXPECT_EQ(count_of(scene, "open_shell") + count_of(scene, "inverted_shell"), 0U);
    EXPECT_EQ(count_of(scene, "duplicate_vertices"), 0U);
  }
}

TEST(CityGml, SolidMayNameTheFacesOfItsSurfacesOrTheOtherWayRound) {
  const Scene inline_solid =
      read_text("a.gml",
                city_model(building(
                    "b", solid(faces_of_box(""), "2") + surface("RoofSurface", "", link_to("f5")))),
                without_ground());
  const Scene named = read_text("a.gml",
                                city_model(building("b", surface("RoofSurface", faces_of_box("")) +
                                                             solid(links_to_box(), "2"))),
                                without_ground());
  for (const Scene* scene : {&inline_solid, &named}) {
    EXPECT_EQ(scene->surfaces.size(), 6U);
    EXPECT_TRUE(std::none_of(scene->surfaces.shell.begin(), scene->surfaces.shell.end(),
                             [](std::uint32_t shell) { return shell == kNone; }));
    EXPECT_EQ(count_of(*scene, "unresolved_xlink"), 0U);
  }
  EXPECT_EQ(surfaces_of(inline_solid, SurfaceType::Roof), 1U);
  EXPECT_EQ(surfaces_of(named, SurfaceType::Roof), 6U);
}

TEST(CityGml, InsideOutSolidIsTurnedAndOpenOneIsTold) {
  std::string inside_out = solid(faces_of_box(""), "2");
  for (std::string::size_type at = 0;
       (at = inside_out.find("<gml:Polygon", at)) != std::string::npos;) {
    const std::string turned = "<gml:OrientableSurface orientation=\"-\"><gml:baseSurface>";
    inside_out.insert(at, turned);
    const auto end = inside_out.find("</gml:Polygon>", at) + 14;
    inside_out.insert(end, "</gml:baseSurface></gml:OrientableSurface>");
    at = end;
  }
  const Scene turned = read_text("a.gml", city_model(building("b", inside_out)), without_ground());
  EXPECT_EQ(count_of(turned, "inverted_shell"), 1U);
  EXPECT_NEAR(measures(flatten(turned)).volume, 60.0, 0.03);

  std::string five = faces_of_box("");
  five.erase(five.rfind("<gml:surfaceMember>"));
  const Scene open = read_text("a.gml", city_model(building("b", solid(five, "2"))));
  EXPECT_EQ(count_of(open, "open_shell"), 1U);
}

TEST(CityGml, NamesOfReferenceSystemsAreLookedUpAFewTimesOnly) {
  // PROJ takes a tenth of a second for each name that is none.
  std::string faces;
  for (int k = 0; k < 2000; ++k) {
    const std::string name = "urn:ogc:def:crs:EPSG::none" + std::to_string(k);
    std::string one = face("f" + std::to_string(k), kTop);
    one.insert(one.find("<gml:Polygon") + 12, " srsName=\"" + name + "\"");
    faces += one;
  }
  const Scene scene = read_text("a.gml", city_model(building("b", surface("RoofSurface", faces))));
  EXPECT_EQ(count_of(scene, "mixed_crs"), 8U);
}

TEST(CityGml, HighestLevelIsReadUnlessAnotherIsAskedFor) {
  const std::string text = city_model(
      building("b", "<bldg:lod0RoofEdge><gml:MultiSurface>" + face("r", kTop) +
                        "</gml:MultiSurface></bldg:lod0RoofEdge>" + solid(faces_of_box(""), "1") +
                        surface("RoofSurface", face("x", kTop)) +
                        surface("WallSurface", face("y", kSouth))));
  const Scene highest = read_text("a.gml", text, without_ground());
  EXPECT_EQ(highest.surfaces.size(), 2U);
  EXPECT_EQ(highest.lod_triangles,
            (std::map<std::string, std::size_t>{{"0", 2}, {"1", 12}, {"2", 4}}));
  ReadOptions options = without_ground();
  options.building_lod = "1";
  EXPECT_EQ(read_text("a.gml", text, options).surfaces.size(), 6U);
  options.building_lod = "0";
  const Scene footprint = read_text("a.gml", text, options);
  EXPECT_EQ(footprint.surfaces.size(), 1U);
  EXPECT_EQ(count_of(footprint, "footprint_only"), 1U);
  options.building_lod = "3";
  const Scene other = read_text("a.gml", text, options);
  EXPECT_EQ(other.surfaces.size(), 2U);
  EXPECT_EQ(count_of(other, "missing_lod"), 1U);
}

TEST(CityGml, PartsReplaceABlockOfLessDetail) {
  const std::string part = "<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id=\"p\">" +
                           solid(faces_of_box(""), "2") +
                           "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
  const Scene scene =
      read_text("a.gml", city_model(building("b", solid(faces_of_box("x"), "1") + part)));
  ASSERT_GE(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[1].id, "p");
  EXPECT_EQ(scene.objects[1].parent, 0U);
  for (std::size_t s = 0; s < 6; ++s) EXPECT_EQ(scene.surfaces.object[s], 1U);
}

TEST(CityGml, ClosureSurfacesAndLogicalSpacesLetLightPass) {
  const Scene scene =
      read_text("a.gml",
                city_model(building("b", surface("RoofSurface", face("x", kTop)) +
                                             surface("ClosureSurface", face("y", kSouth)) +
                                             "<bldg:buildingSubdivision><bldg:Storey>" +
                                             solid(faces_of_box("s"), "2") +
                                             "</bldg:Storey></bldg:buildingSubdivision>")),
                without_ground());
  EXPECT_EQ(scene.surfaces.size(), 1U);
  EXPECT_EQ(count_of(scene, "closure_surface"), 1U);
  EXPECT_EQ(count_of(scene, "logical_space"), 1U);
}

TEST(CityGml, RoadsPlantsAndReliefHaveTheirTypes) {
  const std::string multi = "<gml:MultiSurface>" + face("", kBottom) + "</gml:MultiSurface>";
  const std::string text = city_model(
      member("tran:Road", "r",
             "<tran:trafficArea><tran:TrafficArea><tran:lod2MultiSurface>" + multi +
                 "</tran:lod2MultiSurface></tran:TrafficArea>"
                 "</tran:trafficArea>") +
      member("veg:PlantCover", "v", "<veg:lod1MultiSurface>" + multi + "</veg:lod1MultiSurface>") +
      member("dem:ReliefFeature", "f",
             "<dem:lod>3</dem:lod><dem:reliefComponent><dem:TINRelief gml:id=\"t\"><dem:lod>1"
             "</dem:lod><dem:tin><gml:TriangulatedSurface><gml:trianglePatches><gml:Triangle>"
             "<gml:exterior><gml:LinearRing><gml:posList>100000 450000 1 100009 450000 2 "
             "100000 450009 3 100000 450000 1</gml:posList></gml:LinearRing></gml:exterior>"
             "</gml:Triangle></gml:trianglePatches></gml:TriangulatedSurface></dem:tin>"
             "</dem:TINRelief></dem:reliefComponent>"));
  const Scene scene = read_text("a.gml", text, without_ground());
  ASSERT_EQ(scene.objects.size(), 3U);
  EXPECT_EQ(scene.objects[2].type, "TINRelief");
  EXPECT_EQ(scene.surfaces.type,
            (std::vector{SurfaceType::Road, SurfaceType::Vegetation, SurfaceType::Ground}));
  EXPECT_TRUE(scene.has_terrain);
  EXPECT_EQ(scene.lod_triangles.at("1"), 3U);
}

TEST(CityGml, TemplatesStandWhereTheyAreReferredTo) {
  const auto tree = [](const std::string& id, const std::string& shape, const std::string& at) {
    return member("veg:SolitaryVegetationObject", id,
                  "<veg:lod1ImplicitRepresentation><core:ImplicitGeometry>"
                  "<core:transformationMatrix>2 0 0 0 0 2 0 0 0 0 3 0 0 0 0 1"
                  "</core:transformationMatrix>" +
                      shape + "<core:referencePoint><gml:Point><gml:pos>" + at +
                      "</gml:pos></gml:Point></core:referencePoint></core:ImplicitGeometry>"
                      "</veg:lod1ImplicitRepresentation>");
  };
  const std::string shape =
      "<core:relativeGMLGeometry><gml:MultiSurface gml:id=\"shape\"><gml:surfaceMember>"
      "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>0 0 0 1 0 0 0 0 1 0 0 0"
      "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>"
      "</gml:MultiSurface></core:relativeGMLGeometry>";
  const std::string text = city_model(
      tree("t1", shape, "100000 450000 10") +
      tree("t2", "<core:relativeGMLGeometry xlink:href=\"#shape\"/>", "100050 450000 20") +
      tree("t3", "<core:relativeGMLGeometry xlink:href=\"#nobody\"/>", "100000 450000 0"));
  const Scene scene = read_text("a.gml", text, without_ground());
  EXPECT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(count_of(scene, "unresolved_template"), 1U);
  EXPECT_EQ(scene.extent.min, (Vec3{100000, 450000, 10}));
  EXPECT_EQ(scene.extent.max, (Vec3{100052, 450000, 23}));
}

// A square of 0.001 degrees at 35.68 N, 139.7 E: on GRS 80 a second of latitude is 30.82 m there
// and one of longitude 25.15 m, so the sides are 110.95 and 90.53 m (closed forms of the meridian's
// and the parallel's radius of curvature).
TEST(CityGml, LatitudeComesFirstWhereTheRegistryHasItFirst) {
  const auto square = [](const std::string& crs, bool latitude_first) {
    std::string text;
    for (const auto& [north, east] :
         std::array<std::array<const char*, 2>, 5>{{{"35.680", "139.700"},
                                                    {"35.680", "139.701"},
                                                    {"35.681", "139.701"},
                                                    {"35.681", "139.700"},
                                                    {"35.680", "139.700"}}}) {
      text += std::string(latitude_first ? north : east) + " " + (latitude_first ? east : north) +
              " 5 ";
    }
    return city_model(member("luse:LandUse", "l",
                             "<luse:lod1MultiSurface><gml:MultiSurface>" + face("", text) +
                                 "</gml:MultiSurface></luse:lod1MultiSurface>"),
                      "2.0", crs);
  };
  const Scene first =
      read_text("a.gml", square("http://www.opengis.net/def/crs/EPSG/0/6697", true));
  const Extent box = extent_of(first.vertices);
  EXPECT_NEAR(box.max.y - box.min.y, 110.95, 0.01);
  EXPECT_NEAR(box.max.x - box.min.x, 90.53, 0.01);
  EXPECT_NEAR(first.georeference->origin.latitude.in_degrees(), 35.6805, 1e-5);
  // Everywhere on Earth both orders are possible: the manner of naming decides.
  const Scene urn = read_text(
      "a.gml",
      city_model(member("luse:LandUse", "l",
                        "<luse:lod1MultiSurface><gml:MultiSurface>" +
                            face("", "48.1 11.5 500 48.1 11.6 500 48.2 11.6 500 48.1 11.5 500") +
                            "</gml:MultiSurface></luse:lod1MultiSurface>"),
                 "2.0", "urn:ogc:def:crs:EPSG::4979"));
  EXPECT_NEAR(urn.georeference->origin.latitude.in_degrees(), 48.15, 1e-5);
  const Scene plain = read_text(
      "a.gml",
      city_model(member("luse:LandUse", "l",
                        "<luse:lod1MultiSurface><gml:MultiSurface>" +
                            face("", "11.5 48.1 500 11.6 48.1 500 11.6 48.2 500 11.5 48.1 500") +
                            "</gml:MultiSurface></luse:lod1MultiSurface>"),
                 "2.0", "EPSG:4979"));
  EXPECT_NEAR(plain.georeference->origin.latitude.in_degrees(), 48.15, 1e-5);
}

// Japan's plane rectangular system IX has its origin at 36 N, 139 50' E, with x to the north.
TEST(CityGml, PlaneRectangularCoordinatesHaveNorthingFirst) {
  const std::string triangle = "-10000 3000 5 -10000 3020 5 -9990 3020 5 -10000 3000 5";
  const auto land = [&](const std::string& crs) {
    return city_model(member("luse:LandUse", "l",
                             "<luse:lod1MultiSurface><gml:MultiSurface>" + face("", triangle) +
                                 "</gml:MultiSurface></luse:lod1MultiSurface>"),
                      "2.0", crs);
  };
  const Scene registry = read_text("a.gml", land("http://www.opengis.net/def/crs/EPSG/0/6677"));
  ASSERT_TRUE(registry.georeference);
  const Location north = registry.georeference->origin;
  EXPECT_EQ(count_of(registry, "axis_order"), 1U);
  // 9995 m south and 3010 m east of the origin; a degree of latitude has 110.96 km there.
  EXPECT_NEAR(north.latitude.in_degrees(), 36.0 - 9.995 / 110.96, 1e-4);
  EXPECT_GT(north.longitude.in_degrees(), 139.8333);
  const Scene plain = read_text("a.gml", land("EPSG:6677"));
  EXPECT_GT(plain.georeference->origin.latitude.in_degrees(), 36.0);
  EXPECT_LT(plain.georeference->origin.longitude.in_degrees(), 139.8333);
}

TEST(CityGml, GermanSurveysNamesAreKnown) {
  const Scene scene = read_text(
      "a.gml", city_model(member("luse:LandUse", "l",
                                 "<luse:lod1MultiSurface><gml:MultiSurface>" +
                                     face("",
                                          "4468000 5333000 500 4468010 5333000 500 4468010 "
                                          "5333010 500 4468000 5333000 500") +
                                     "</gml:MultiSurface></luse:lod1MultiSurface>"),
                          "2.0", "urn:adv:crs:DE_DHDN_3GK4*DE_DHN92_NH"));
  EXPECT_EQ(scene.georeference->crs, "EPSG:31468");
  EXPECT_NEAR(scene.georeference->origin.latitude.in_degrees(), 48.13, 0.02);  // Munich
  EXPECT_NEAR(scene.georeference->origin.longitude.in_degrees(), 11.57, 0.02);
}

TEST(CityGml, DegreesUnderANameThatMeansNothingAreRefused) {
  const std::string land =
      member("luse:LandUse", "l",
             "<luse:lod1MultiSurface><gml:MultiSurface>" +
                 face("", "35.1 139.1 5 35.1 139.2 5 35.2 139.2 5 35.1 139.1 5") +
                 "</gml:MultiSurface></luse:lod1MultiSurface>");
  const std::string text = city_model(land, "2.0", "http://www.opengis.net/def/crs/EPSG/0/669");
  EXPECT_NE(message_of(text).find("look like degrees"), std::string::npos);
  ReadOptions options;
  options.crs = "EPSG:6697";
  EXPECT_EQ(message_of(text, options), "");
}

TEST(CityGml, SurfaceFarFromTheOthersIsLeftOutAndTold) {
  const std::string faces = face("a", "35.1 139.1 5 35.1 139.2 5 35.2 139.2 5 35.1 139.1 5") +
                            face("b", "35.1 139.1 5 0 0 0 35.2 139.2 5 35.1 139.1 5") +
                            face("c", "35.1 139.1 9 35.1 139.2 9 35.2 139.2 9 35.1 139.1 9");
  const Scene scene =
      read_text("a.gml", city_model(member("luse:LandUse", "l",
                                           "<luse:lod1MultiSurface><gml:MultiSurface>" + faces +
                                               "</gml:MultiSurface></luse:lod1MultiSurface>"),
                                    "2.0", "http://www.opengis.net/def/crs/EPSG/0/6697"));
  EXPECT_EQ(count_of(scene, "misplaced_surface"), 1U);
  EXPECT_GT(scene.extent.min.x, 35.0);
}

TEST(CityGml, BrokenLinksRingsAndIdsAreTold) {
  const std::string open_ring =
      "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>100000 450000 1 "
      "100009 450000 1 100000 450009 1</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>"
      "</gml:surfaceMember>";
  const std::string one =
      building("twin", solid(link_to("nobody"), "2") + surface("RoofSurface", open_ring));
  const Scene scene = read_text("a.gml", city_model(one + box_building("twin")), without_ground());
  EXPECT_EQ(count_of(scene, "unresolved_xlink"), 1U);
  EXPECT_EQ(count_of(scene, "ring_not_closed"), 1U);
  EXPECT_EQ(count_of(scene, "duplicate_id"), 1U);
  EXPECT_EQ(scene.surfaces.size(), 7U);
  const Scene faces = read_text(
      "a.gml",
      city_model(building("b", surface("RoofSurface", face("f", kTop) + face("f", kSouth)))));
  EXPECT_EQ(count_of(faces, "duplicate_id"), 1U);
}

}  // namespace
}  // namespace tenku
