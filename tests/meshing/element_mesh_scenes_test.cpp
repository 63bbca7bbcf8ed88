// Rooms and buildings from files: numbers of polygons and areas are counted from what they are made
// of, numbers of patches and elements are those of the paper's tables and figure.
#include <cstdlib>
#include <filesystem>

#include "meshing/mesh_checks.h"
#include "scene/flatten.h"
#include "scene/read_scene.h"

namespace tenku::testing_support {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(TENKU_SOURCE_DIR) / "scenes";

struct Model {
  Scene scene;
  TriangleSoup soup;

  explicit Model(const std::filesystem::path& file, const std::filesystem::path& materials = {}) {
    ReadOptions options;
    options.ground.kind = GroundChoice::Kind::None;
    if (!materials.empty()) options.materials = materials;
    Progress progress;
    scene = read_scene(file, options, progress);
    soup = flatten(scene);
  }
  /// Area of all triangles but glass.
  double area_m2() const {
    double sum = 0.0;
    for (std::size_t t = 0; t < soup.size(); ++t) {
      if (scene.materials[soup.material[t]].is_glass()) continue;
      const auto& [a, b, c] = soup.triangles[t];
      sum += 0.5 * length(cross(soup.vertices[b] - soup.vertices[a],
                                soup.vertices[c] - soup.vertices[a]));
    }
    return sum;
  }
};

/// What scenes/examples/generate_interior.py makes.
Model generated(const std::string& kind) {
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / ("tenku_element_mesh_" + kind + ".obj");
  const std::string command = "'" TENKU_PYTHON "' -B '" +
                              (kScenes / "examples/generate_interior.py").string() + "' " + kind +
                              " --out '" + file.string() + "' > /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return Model(file, kScenes / "examples/interior_materials.toml");
}

/// Pieces that share no vertices: the polygons.
std::size_t polygons_of(const ElementMesh& mesh) {
  std::vector<std::uint32_t> root(mesh.vertices.size());
  for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.elements) {
    root[find(b)] = find(a);
    root[find(c)] = find(a);
  }
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < root.size(); ++v) count += root[v] == v ? 1U : 0U;
  return count;
}

double share(std::size_t found, double wanted) { return static_cast<double>(found) / wanted; }

TEST(ElementMeshScenes, RoomOfTheTables) {
  const Model room = generated("room");
  // Six faces of the room, six of the table, five of the cupboard, the luminaire.
  const double area = 180.0 + 8.8 + 10.5 + 2.0 - 1.5 + 0.5;
  EXPECT_NEAR(room.area_m2(), area, 1e-9);
  const MeshedScene table_1 =
      mesh_scene(room.scene, room.soup, {.element_m = 1.29, .patch_m = 2.3});
  EXPECT_TRUE(table_1.findings.empty());
  EXPECT_EQ(polygons_of(table_1.mesh), 18U);
  EXPECT_NEAR(share(table_1.mesh.patches(), 132.0), 1.0, 0.05);
  EXPECT_NEAR(share(table_1.mesh.size(), 548.0), 1.0, 0.05);
  const MeshedScene table_2 =
      mesh_scene(room.scene, room.soup, {.element_m = 0.502, .patch_m = 1.45});
  EXPECT_NEAR(share(table_2.mesh.patches(), 328.0), 1.0, 0.02);
  EXPECT_NEAR(share(table_2.mesh.size(), 3294.0), 1.0, 0.02);
  EXPECT_NEAR(area_of(table_2.mesh), area, area * 1e-12);
}

TEST(ElementMeshScenes, BuildingOfTheFigure) {
  const Model building = generated("building");
  const MeshedScene made =
      mesh_scene(building.scene, building.soup, {.element_m = 1.28, .patch_m = 1.79});
  EXPECT_TRUE(made.findings.empty());
  EXPECT_NEAR(share(polygons_of(made.mesh), 10'288.0), 1.0, 0.001);
  EXPECT_NEAR(share(made.mesh.patches(), 23'855.0), 1.0, 0.03);
  EXPECT_NEAR(share(made.mesh.size(), 53'430.0), 1.0, 0.03);
  EXPECT_NEAR(area_of(made.mesh) / building.area_m2(), 1.0, 1e-12);
  EXPECT_LE(longest_edge(made.mesh), 1.28 * (1.0 + 1e-9));
  // One hole in the window's wall of each of 84 rooms, and every other polygon without.
  const Topology topology = topology_of(made.mesh);
  EXPECT_EQ(topology.euler(), static_cast<long>(polygons_of(made.mesh)) - 84);
  EXPECT_EQ(topology.crowded_edges, 0);
}

TEST(ElementMeshScenes, SideLitRoomHasAWallAboutItsOpening) {
  const Model room(TENKU_TEST_REFERENCE "/radiosity/side_lit_room.obj");
  const MeshedScene made = mesh_scene(room.scene, room.soup, {.element_m = 0.4});
  EXPECT_TRUE(made.findings.empty());
  EXPECT_EQ(polygons_of(made.mesh), 6U);
  EXPECT_NEAR(area_of(made.mesh), 180.0 - 4.5, 1e-10);
  ElementMesh front;
  front.vertices = made.mesh.vertices;
  for (std::size_t e = 0; e < made.mesh.size(); ++e) {
    const double facing = std::abs(made.mesh.normal(2 * e).y);
    if (made.mesh.centre(e).y < 1e-9 && facing > 0.5)
      front.elements.push_back(made.mesh.elements[e]);
  }
  EXPECT_NEAR(area_of(front), 13.5, 1e-10);
  EXPECT_EQ(topology_of(front).euler(), 0);
  EXPECT_NEAR(topology_of(front).border_m, 18.0 + 9.0, 1e-9);
}

TEST(ElementMeshScenes, CornellBox) {
  const auto folder = kScenes / "verification/cornell_box";
  const Model box(folder / "cornell_box.obj", folder / "materials.toml");
  const MeshedScene made = mesh_scene(box.scene, box.soup, {.element_m = 0.05});
  // 16 as published, of which the left wall is two triangles, and five of the casing.
  EXPECT_EQ(polygons_of(made.mesh), 22U);
  EXPECT_NEAR(area_of(made.mesh) / box.area_m2(), 1.0, 1e-12);
  double light = 0.0;
  for (std::size_t e = 0; e < made.mesh.size(); ++e) {
    const Material& material = box.scene.materials[made.mesh.material[e]];
    if (material.emission_lm_m2.r > 0.0) light += made.mesh.area_m2(e);
  }
  EXPECT_NEAR(light, 0.130 * 0.105, 1e-12);
  // The casing is 0.2 mm high.
  ASSERT_EQ(made.findings.size(), 1U);
  EXPECT_EQ(made.findings[0].code, "sliver_surfaces");
  EXPECT_EQ(made.findings[0].count, 4U);
}

}  // namespace
}  // namespace tenku::testing_support
