// Results on the surfaces of models, models written as they are used, one place in many formats.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/lit_scene_files.h"
#include "scene/read_scene.h"
#include "support/reference_table.h"
#include "support/run_program.h"
#include "support/scene_formats.h"

namespace tenku {
namespace {

using namespace testing_support;
using nlohmann::json;

/// A cube of 10 m in an open field, in CityJSON.
const char* const kCube =
    R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":)"
    R"("https://www.opengis.net/def/crs/EPSG/0/7415"},"transform":{"scale":[1,1,1],)"
    R"("translate":[85000,447000,0]},"CityObjects":{"cube":{"type":"Building","geometry":)"
    R"([{"type":"Solid","lod":"2.2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],)"
    R"([[2,3,7,6]],[[3,0,4,7]]]]}]},"field":{"type":"LandUse","geometry":[{"type":"MultiSurface",)"
    R"("lod":"1","boundaries":[[[8,9,10,11]]]}]}},"vertices":[[0,0,0],[10,0,0],[10,10,0],[0,10,0],)"
    R"([0,0,10],[10,0,10],[10,10,10],[0,10,10],[-500,-500,0],[500,-500,0],[500,500,0],)"
    R"([-500,500,0]]})";

const std::string kOpenSky = " --sky uniform --sky-illuminance 10000 --sun-illuminance 0";

/// The semantic surface of each polygon of an object.
std::vector<json> surfaces_of(const json& model, const char* object) {
  const json& geometry = model["CityObjects"][object]["geometry"][0];
  std::vector<json> surfaces;
  for (const json& index : geometry["semantics"]["values"]) {
    surfaces.push_back(geometry["semantics"]["surfaces"][index.get<std::size_t>()]);
  }
  return surfaces;
}

// Under a uniform sky a roof that sees all of it has what the open field has, a wall half, and
// the cosine-weighted share of the sky is 1 and 0.5.
TEST(ModelResults, SurfacesOfCityJsonCarryTheirIlluminance) {
  const auto folder = test_folder();
  write_text(folder / "cube.city.json", kCube);
  const auto run = run_tenku("illuminance cube.city.json --grid roofs,walls --spacing 5 " +
                                 kOpenSky + " --bounces 0 --tolerance 1 --out lit.city.json",
                             folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json model = json::parse(contents_of(folder / "lit.city.json"));
  std::size_t roofs = 0, walls = 0;
  for (const json& surface : surfaces_of(model, "cube")) {
    const std::string type = surface["type"];
    if (type != "RoofSurface" && type != "WallSurface") {
      EXPECT_FALSE(surface.contains("total_lux"));  // the underside has no sensors
      continue;
    }
    const double share = type == "RoofSurface" ? 1.0 : 0.5;
    (type == "RoofSurface" ? roofs : walls) += 1;
    EXPECT_NEAR(surface["total_lux"], 10000.0 * share, 110.0) << type;
    EXPECT_NEAR(surface["sky_view"], share, 0.011) << type;
    EXPECT_EQ(surface["sun_lux"], 0.0);
    EXPECT_LE(surface["error_lux"], 110.0);
  }
  EXPECT_EQ(roofs, 1u);
  EXPECT_EQ(walls, 4u);
  // By area: one roof and four walls of the same size.
  const json& object = model["CityObjects"]["cube"]["attributes"];
  EXPECT_NEAR(object["sky_view"], (1.0 + 4 * 0.5) / 5.0, 0.011);
  EXPECT_FALSE(model["CityObjects"]["field"].contains("attributes"));
  const auto seen = run_tenku("inspect lit.city.json --json --quiet", folder);
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  const json counts = json::parse(seen.out);
  EXPECT_EQ(counts["triangles"], 14);
  EXPECT_EQ(counts["findings"].size(), 0u) << seen.out;
}

/// Numbers of an accessor of 32-bit floats of a GLB.
std::vector<float> floats_of(const json& document, const std::string& binary,
                             std::size_t accessor) {
  const json& a = document["accessors"][accessor];
  const json& view = document["bufferViews"][a["bufferView"].get<std::size_t>()];
  const std::size_t per = a["type"] == "VEC3" ? 3 : 1;
  std::vector<float> values(a["count"].get<std::size_t>() * per);
  EXPECT_EQ(view["byteLength"].get<std::size_t>(), 4 * values.size());
  std::memcpy(values.data(), binary.data() + view["byteOffset"].get<std::size_t>(),
              4 * values.size());
  return values;
}

TEST(ModelResults, GlbHasColouredVertices) {
  const auto folder = test_folder();
  write_text(folder / "cube.city.json", kCube);
  const auto run = run_tenku("illuminance cube.city.json --grid roofs,walls --spacing 5 " +
                                 kOpenSky + " --bounces 0 --tolerance 1 --out lit.glb",
                             folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string file = contents_of(folder / "lit.glb");
  std::uint32_t length = 0, json_length = 0;
  std::memcpy(&length, file.data() + 8, 4);
  std::memcpy(&json_length, file.data() + 12, 4);
  ASSERT_EQ(length, file.size());
  const json document = json::parse(file.substr(20, json_length));
  const std::string binary = file.substr(20 + json_length + 8);
  const json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  const auto points = floats_of(document, binary, attributes["POSITION"]);
  const auto colours = floats_of(document, binary, attributes["COLOR_0"]);
  const auto total = floats_of(document, binary, attributes["_TOTAL_LUX"]);
  const auto sky_view = floats_of(document, binary, attributes["_SKY_VIEW"]);
  ASSERT_EQ(points.size(), colours.size());
  ASSERT_EQ(points.size(), 3 * total.size());
  const json& extras = document["asset"]["extras"];
  EXPECT_EQ(extras["crs"], "EPSG:7415");
  for (std::size_t v = 0; v < total.size(); ++v) {
    // y is up: the roof lies at 10 m.
    const bool is_roof = std::abs(points[3 * v + 1] - 10.0F) < 1e-3F && total[v] > 7500.0F;
    EXPECT_NEAR(total[v], is_roof ? 10000.0 : 5000.0, 110.0);
    EXPECT_NEAR(sky_view[v] * 10000.0, total[v], 110.0);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_GE(colours[3 * v + c], 0.0F);
      EXPECT_LE(colours[3 * v + c], 1.0F);
    }
    // Viridis gets greener all the way up: a value has no less green than a lower one.
    for (const std::size_t w : {std::size_t{0}, total.size() - 1}) {
      if (total[v] <= total[w] + 1000.0F) continue;
      EXPECT_GT(colours[3 * v + 1], colours[3 * w + 1]);
    }
  }
  const auto seen = run_tenku("inspect lit.glb --json --quiet", folder);
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  EXPECT_EQ(json::parse(seen.out)["triangles"].get<std::size_t>(), total.size() / 3);
}

TEST(ModelResults, SensorsOutsideSurfacesCannotBePutOnThem) {
  const auto folder = test_folder();
  write_text(folder / "cube.city.json", kCube);
  write_text(folder / "s.pts", "85000 447000 20 0 0 1\n");
  for (const char* out : {"o.city.json", "o.glb"}) {
    const auto run = run_tenku(
        "illuminance cube.city.json --sensors s.pts" + kOpenSky + " --out " + out, folder);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.err.find("--grid"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / out));
  }
}

TEST(Strict, RefusesByExitCode) {
  const auto folder = test_folder();
  write_text(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 2 3\n");
  EXPECT_EQ(run_tenku("inspect a.obj", folder).exit_code, 0);
  const auto run = run_tenku("inspect a.obj --strict", folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("repeated_vertex"), std::string::npos) << run.err;
  const auto other = run_tenku("inspect a.obj --repaired a.ply", folder);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find(".city.json"), std::string::npos) << other.err;
}

/// Points 1 m above the ground of the town, on the map.
std::vector<Vec3> places_in(const Scene& scene) {
  std::vector<Vec3> places;
  std::size_t seen = 0;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const SurfaceType type = scene.surfaces.type[s];
    const Vec3 area = area_vector(scene, s);
    if ((type != SurfaceType::Ground && type != SurfaceType::Road) || area.z < 5.0) continue;
    if (seen++ % 60 != 0) continue;
    Vec3 middle{};
    const auto ring = scene.surfaces.outer_ring(s);
    for (const std::uint32_t v : ring) {
      middle = middle + (1.0 / static_cast<double>(ring.size())) * scene.vertices[v];
    }
    places.push_back(scene.map_frame.to_file(middle + Vec3{0.0, 0.0, 1.0}));
  }
  return places;
}

// The town as CityJSON, as what `inspect --repaired` writes, as CityGML, OBJ and glTF: the values
// are as close as their 95 % intervals. Those of glTF are rounded to 32-bit floats about the
// middle.
TEST(SamePlace, HasTheSameIlluminanceInEveryFormat) {
  const auto folder = test_folder();
  const std::string town = TENKU_SOURCE_DIR "/scenes/examples/sapporo_town.city.json";
  Progress silent;
  const Scene scene = read_scene(town, {}, silent);
  write_text(folder / "town.obj", obj_of(scene));
  write_text(folder / "town.glb", glb_of(scene));
  write_text(folder / "town.gml", citygml_of(scene));
  const auto repaired =
      run_tenku("inspect '" + town + "' --repaired repaired.city.json --quiet", folder);
  ASSERT_EQ(repaired.exit_code, 0) << repaired.err;
  const std::vector<Vec3> places = places_in(scene);
  ASSERT_GT(places.size(), 20u);
  std::ostringstream z_up, y_up;
  z_up.precision(12);
  y_up.precision(12);
  for (const Vec3 p : places) {
    z_up << p.x << ' ' << p.y << ' ' << p.z << " 0 0 1\n";
    y_up << p.x << ' ' << p.z << ' ' << -p.y << " 0 1 0\n";
  }
  write_text(folder / "z.pts", z_up.str());
  write_text(folder / "y.pts", y_up.str());
  const auto light = [&](const std::string& file, const std::string& more) {
    const auto run = run_tenku("illuminance '" + file + "' " + more +
                                   " --time 2026-06-21T10:00+09:00 --sky cie:12 --tolerance 3 "
                                   "--bounces 0 --quiet --out o.csv",
                               folder);
    EXPECT_EQ(run.exit_code, 0) << file << ": " << run.err;
    return ReferenceTable((folder / "o.csv").string());
  };
  const ReferenceTable expected = light(town, "--sensors z.pts");
  ASSERT_EQ(expected.size(), places.size());
  std::size_t shaded = 0, sunlit = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    shaded += expected.number(i, "sky_view") < 0.8 ? 1 : 0;
    sunlit += expected.number(i, "sun_lux") > 0.0 ? 1 : 0;
  }
  EXPECT_GT(shaded, 5u);
  EXPECT_GT(sunlit, 5u);
  for (const auto& [file, more] : std::initializer_list<std::pair<const char*, const char*>>{
           {"repaired.city.json", "--sensors z.pts"},
           {"town.gml", "--sensors z.pts"},
           {"town.obj", "--sensors z.pts --crs EPSG:6680"},
           {"town.glb", "--sensors y.pts --crs EPSG:6680"}}) {
    const ReferenceTable table = light(file, more);
    ASSERT_EQ(table.size(), expected.size()) << file;
    for (std::size_t i = 0; i < table.size(); ++i) {
      EXPECT_NEAR(table.number(i, "total_lux"), expected.number(i, "total_lux"),
                  table.number(i, "error_lux") + expected.number(i, "error_lux") + 0.1)
          << file << ", sensor " << i;
      EXPECT_NEAR(table.number(i, "sun_lux"), expected.number(i, "sun_lux"), 50.0)
          << file << ", sensor " << i;
    }
  }
}

}  // namespace
}  // namespace tenku
