// Broken and hostile CityGML: read, or refused with file and line.
#include <gtest/gtest.h>

#include "tests/robustness/refusal.h"
#include "tests/scene/citygml_texts.h"

namespace tenku {
namespace {

const std::string& model() {
  static const std::string kText = city_model(
      box_building() +
      member(
          "dem:ReliefFeature", "r",
          "<dem:reliefComponent><dem:TINRelief><dem:lod>1</"
          "dem:lod><dem:tin><gml:TriangulatedSurface>"
          "<gml:trianglePatches><gml:Triangle><gml:exterior><gml:LinearRing><gml:posList>100000 "
          "450000 "
          "0 100009 450000 0 100000 450009 0 100000 450000 0</gml:posList></gml:LinearRing>"
          "</gml:exterior></gml:Triangle></gml:trianglePatches></gml:TriangulatedSurface></dem:tin>"
          "</dem:TINRelief></dem:reliefComponent>"));
  return kText;
}

TEST(CityGmlRobustness, WholeFileIsReadAndEveryCutOneIsRefused) {
  EXPECT_EQ(refusal_of_text("a.gml", model()), "");
  const std::size_t end = model().rfind("</core:CityModel>") + 17;
  for (std::size_t part = 0; part < 60; ++part) {
    const std::string cut = model().substr(0, part * end / 60);
    EXPECT_NE(refusal_of_text("a.gml", cut), "") << part;
  }
}

TEST(CityGmlRobustness, WrongValuesAreRefusedWithTheirLine) {
  for (const auto& [old, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {"100000 450000 0", "100000 nan 0"},
           {"100000 450000 0", "100000 inf 0"},
           {"100000 450000 0", "100000 1e999 0"},
           {"100000 450000 0", "100000 450000"},
           {"100000 450000 0", "100000 abc 0"},
           {"100000 450000 0", "100000 450000 0 7"},
           {"</gml:Polygon>", "</gml:Polygone>"},
           {"<gml:Polygon", "<<gml:Polygon"},
           {"<core:CityModel", "<core:CityModel a=\"1\" a=\"2\""},
           {"gml:id=\"b1\"", "gml:id=b1"},
           {"<bldg:Building", "&undefined;<bldg:Building"}}) {
    const std::string message = refusal_of_text("a.gml", replaced(model(), old, with));
    EXPECT_NE(message.find("line "), std::string::npos) << with << ": " << message;
  }
}

TEST(CityGmlRobustness, OtherDocumentsAreRefused) {
  for (const char* text : {"{}", "<html></html>", "<a", "\xEF\xBB\xBF",
                           "<?xml version=\"1.0\" encoding=\"nobody\"?><a/>", "<CityModel/>",
                           "<CityModel></CityModel><CityModel/>", "\x1f\x8b", "ply"}) {
    EXPECT_NE(refusal_of_text("a.gml", text), "") << text;
  }
}

TEST(CityGmlRobustness, EntitiesThatMultiplyAreRefused) {
  std::string text = "<?xml version=\"1.0\"?><!DOCTYPE CityModel [<!ENTITY a0 \"lollollollol\">";
  for (int k = 1; k < 12; ++k) {
    const std::string last = "&a" + std::to_string(k - 1) + ";";
    text += "<!ENTITY a" + std::to_string(k) + " \"";
    for (int n = 0; n < 10; ++n) text += last;
    text += "\">";
  }
  text +=
      "]><CityModel><cityObjectMember><Building><lod1Solid>&a11;</lod1Solid></Building>"
      "</cityObjectMember></CityModel>";
  EXPECT_NE(refusal_of_text("a.gml", text), "");
}

TEST(CityGmlRobustness, NothingIsLoadedFromElsewhere) {
  const TemporaryFolder folder;
  const auto secret = folder.write("secret.txt", "100000 450000 0");
  const std::string text =
      "<?xml version=\"1.0\"?><!DOCTYPE CityModel [<!ENTITY s SYSTEM \"" + secret.string() +
      "\">]>" + "<CityModel><cityObjectMember><Building><lod1MultiSurface>" + face("", "&s;") +
      "</lod1MultiSurface></Building></cityObjectMember></CityModel>";
  EXPECT_NE(refusal_of_text("a.gml", text), "");
}

TEST(CityGmlRobustness, DeepNestingIsRefused) {
  for (const std::size_t depth : {600U, 100000U}) {
    std::string nest = "<CityModel>", end;
    for (std::size_t k = 0; k < depth; ++k) nest += "<Solid>";
    const std::string message = refusal_of_text("a.gml", nest);
    EXPECT_NE(message.find("too deep"), std::string::npos) << message;
  }
}

TEST(CityGmlRobustness, ElementsInWrongPlacesAreBorneOrRefused) {
  const std::string ring =
      "<gml:LinearRing><gml:posList>1 1 1 2 2 2 3 1 1</gml:posList></gml:LinearRing>";
  for (const std::string& content : std::initializer_list<std::string>{
           ring, "<bldg:lod1Solid>" + ring + "</bldg:lod1Solid>",
           "<bldg:lod1Solid><gml:exterior>" + ring + "</gml:exterior></bldg:lod1Solid>",
           "<bldg:lod1Solid><gml:Solid><gml:Polygon>" + ring + ring +
               "</gml:Polygon></gml:Solid>"
               "</bldg:lod1Solid>",
           "<bldg:lod1Solid><gml:Polygon><gml:Polygon>" + ring + "</gml:Polygon>" + ring +
               "</gml:Polygon></bldg:lod1Solid>",
           "<bldg:lod1Solid><gml:Polygon/></bldg:lod1Solid>",
           "<bldg:lod1Solid><gml:Polygon><gml:interior>" + ring +
               "</gml:interior></gml:Polygon></bldg:lod1Solid>",
           "<bldg:lod1Solid><gml:Polygon><core:relativeGMLGeometry>" + ring +
               "</core:relativeGMLGeometry></gml:Polygon></bldg:lod1Solid>",
           "<core:ImplicitGeometry><core:relativeGMLGeometry><core:relativeGMLGeometry/>" + ring +
               "</core:relativeGMLGeometry></core:ImplicitGeometry>",
           "<core:ImplicitGeometry><core:relativeGMLGeometry><gml:Solid><gml:exterior>"
           "<bldg:Building><bldg:lod1Solid><gml:Polygon>" +
               ring +
               "</gml:Polygon></bldg:lod1Solid></bldg:Building></gml:exterior></gml:Solid>"
               "</core:relativeGMLGeometry></core:ImplicitGeometry>",
           "<core:ImplicitGeometry><core:transformationMatrix>1 2</core:transformationMatrix>"
           "</core:ImplicitGeometry>",
           "<bldg:lod1Solid xlink:href=\"#b1\"/>", "<bldg:lod2Solid xlink:href=\"\"/>",
           "<bldg:boundedBy><bldg:Building><bldg:BuildingPart/></bldg:Building></bldg:boundedBy>",
           "<dem:tin>" + ring + "</dem:tin>"}) {
    refusal_of_text("a.gml", city_model(member("bldg:Building", "x", content)));
    refusal_of_text("a.gml", city_model(member("bldg:Building", "x", content) + box_building()));
    refusal_of_text("a.gml", city_model(content));
  }
}

TEST(CityGmlRobustness, FaceThatNamesItselfIsBorne) {
  const std::string loop = "<bldg:lod2MultiSurface><gml:MultiSurface gml:id=\"m\">" +
                           face("p", kTop) + link_to("m") + link_to("p") +
                           "</gml:MultiSurface></bldg:lod2MultiSurface>"
                           "<bldg:lod3MultiSurface><gml:MultiSurface gml:id=\"n\">" +
                           link_to("m") + link_to("n") +
                           "</gml:MultiSurface></bldg:lod3MultiSurface>";
  EXPECT_EQ(refusal_of_text("a.gml", city_model(building("b", loop))), "");
}

TEST(CityGmlRobustness, EachByteMayBeWrong) {
  for (std::size_t i = 0; i < model().size(); i += 29) {
    for (const char c : {'0', '<', '\x80'}) {
      std::string broken = model();
      broken[i] = c;
      refusal_of_text("a.gml", broken);
    }
  }
}

}  // namespace
}  // namespace tenku
