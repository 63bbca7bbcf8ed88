// Bubble meshes: shapes, sizes, shared edges and constraints.
#include "meshing/bubble_mesh.h"

#include <numbers>
#include <set>
#include <tuple>

#include "core/error.h"
#include "core/parallel.h"
#include "meshing/bubble_edges.h"
#include "meshing/bubble_motion.h"
#include "meshing/mesh_checks.h"
#include "meshing/plane_shapes.h"
#include "meshing/size_field.h"

namespace tenku::testing_support {
namespace {

constexpr double kWeld = 1e-5;

struct Shape {
  const char* name;
  std::vector<Ring> rings;
};

Ring regular(int corners, double radius, double inner_radius) {
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double r = k % 2 == 0 ? radius : inner_radius, a = 2.0 * kPi * k / corners;
    ring.push_back({2.0 + r * std::cos(a), 2.0 + r * std::sin(a)});
  }
  return ring;
}

std::vector<Shape> shapes() {
  return {{"square", {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}},
          {"angle", {{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}}},
          {"frame",
           {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1.3, 1.2}, {1.3, 2.4}, {2.9, 2.4}, {2.9, 1.2}}}},
          {"disc", {regular(24, 2.0, 2.0)}},
          {"triangle", {{{0, 0}, {4, 0}, {1.5, 3.5}}}},
          {"star", {regular(10, 2.0, 1.0)}}};
}

struct Wish {
  const char* name;
  double (*size_m)(PlanePoint);
};

const Wish kWishes[] = {{"uniform", [](PlanePoint) { return 0.1; }},
                        {"gradient", [](PlanePoint p) { return 0.04 + 0.04 * p.x; }},
                        {"step", [](PlanePoint p) { return p.x < 2.0 ? 0.05 : 0.25; }},
                        {"dip", [](PlanePoint p) {
                           const double dx = p.x - 2.0, dy = p.y - 1.2;
                           return 0.16 - 0.13 * std::exp(-(dx * dx + dy * dy) / 0.5);
                         }}};

SizeField field_of(const FlatPolygon& polygon, const Wish& wish) {
  std::vector<SizeSample> samples;
  for (int j = 0; j <= 50; ++j) {
    for (int i = 0; i <= 50; ++i) {
      const PlanePoint p{0.08 * i, 0.08 * j};
      samples.push_back({p, wish.size_m(p)});
    }
  }
  return SizeField(polygon, samples, {.least_m = 0.01, .most_m = 1.0});
}

BubbleMesh meshed(const std::vector<FlatPolygon>& polygons, double size_m,
                  const BubbleOptions& options = {}) {
  return bubble_mesh(
      polygons, [=](std::size_t, PlanePoint) { return size_m; }, {}, options);
}

TEST(BubbleForce, IsTheCubicOfItsFourConditions) {
  EXPECT_NEAR(bubble_force(1.0), 0.0, 1e-15);
  EXPECT_NEAR(bubble_force(1.5), 0.0, 1e-15);
  EXPECT_NEAR((bubble_force(1.0 + 1e-6) - bubble_force(1.0 - 1e-6)) / 2e-6, -1.0, 1e-9);
  EXPECT_NEAR((bubble_force(1e-6) - bubble_force(0.0)) / 1e-6, 0.0, 1e-5);
  EXPECT_GT(bubble_force(0.9), 0.0);
  EXPECT_LT(bubble_force(1.2), 0.0);
  EXPECT_EQ(bubble_force(1.6), 0.0);
}

TEST(BubbleChain, PiecesGrowAsTheSize) {
  // Where the size is s0 + g t, the integral of 1 / size is ln(1 + g t / s0) / g: places are a
  // geometric series.
  const ChainAnswer chain = bubble_chain(
      3.0, [](double t) { return 0.1 + 0.2 * t; }, 1000);
  ASSERT_GT(chain.at.size(), 5U);
  const double n = static_cast<double>(chain.at.size()) + 1.0;
  EXPECT_NEAR(n, std::log(1.0 + 0.2 * 3.0 / 0.1) / 0.2, 0.51);
  for (std::size_t k = 0; k < chain.at.size(); ++k) {
    const double expected = 0.1 / 0.2 * (std::pow(7.0, (static_cast<double>(k) + 1.0) / n) - 1.0);
    EXPECT_NEAR(3.0 * chain.at[k], expected, 0.01);
  }
}

TEST(BubbleChain, SaysWhyThereIsNone) {
  const auto nothing = bubble_chain(
      1.0, [](double t) { return t < 0.5 ? 0.1 : 0.0; }, 1000);
  EXPECT_EQ(nothing.refusal, BubbleFlaw::Kind::BadSize);
  const auto much = bubble_chain(
      1.0, [](double) { return 1e-9; }, 1000);
  EXPECT_EQ(much.refusal, BubbleFlaw::Kind::TooMany);
}

TEST(BubbleMesh, ShapesAndSizesAreGood) {
  for (const Shape& shape : shapes()) {
    const std::vector<FlatPolygon> polygon{polygon_of(shape.rings)};
    for (const Wish& wish : kWishes) {
      SCOPED_TRACE(std::string(shape.name) + ", " + wish.name);
      const SizeField field = field_of(polygon[0], wish);
      const auto size_at = [&](std::size_t, PlanePoint p) { return field.at(p); };
      const BubbleMesh made = bubble_mesh(polygon, size_at, {}, {});
      ASSERT_TRUE(made.flaws.empty());
      expect_fills(polygon[0], made.meshes[0], kWeld);
      EXPECT_EQ(cover_of(polygon[0], made.meshes[0]).euler,
                2 - static_cast<long>(shape.rings.size()));
      const MeshQuality& q = made.quality[0];
      EXPECT_GE(q.mean_smallest_angle_deg, 50.0);
      EXPECT_GE(q.least_angle_deg, 20.0);
      EXPECT_GE(q.share_within_20_pct, 95.0);
      EXPECT_LE(q.steps, BubbleOptions{}.steps_most);
      std::printf(
          "%-9s %-9s %5zu elements, mean angle %.1f, least %.1f, %.1f %% of edges, %zu steps\n",
          shape.name, wish.name, made.meshes[0].elements.size(), q.mean_smallest_angle_deg,
          q.least_angle_deg, q.share_within_20_pct, q.steps);
    }
  }
}

TEST(BubbleMesh, QualityIsThatOfTheElements) {
  const auto made = meshed({rectangle(3.0, 2.0)}, 0.2);
  const PolygonMesh& mesh = made.meshes[0];
  ElementMesh elements;
  elements.vertices = mesh.vertices;
  elements.elements = mesh.elements;
  EXPECT_NEAR(made.quality[0].least_angle_deg, least_angle_deg(elements), 1e-9);
  EXPECT_EQ(made.quality[0].edges, static_cast<std::size_t>(topology_of(elements).edges));
  // Of equilateral triangles of this edge; more are needed beside the edges of the rectangle.
  const double ideal = 6.0 / (std::numbers::sqrt3 / 4.0 * 0.04);
  EXPECT_NEAR(static_cast<double>(mesh.elements.size()) / ideal, 1.0, 0.1);
}

/// All elements of all meshes, vertices at the same place made one.
ElementMesh together(const BubbleMesh& made) {
  ElementMesh all;
  std::map<std::tuple<double, double, double>, std::uint32_t> number;
  for (const PolygonMesh& mesh : made.meshes) {
    std::vector<std::uint32_t> of;
    for (const Vec3 p : mesh.vertices) {
      const auto [at, is_new] = number.try_emplace(std::tuple(p.x, p.y, p.z), all.vertices.size());
      if (is_new) all.vertices.push_back(p);
      of.push_back(at->second);
    }
    for (const auto& t : mesh.elements) all.elements.push_back({of[t[0]], of[t[1]], of[t[2]]});
  }
  return all;
}

/// A room and, in the middle of its floor, a pillar up to the ceiling.
std::vector<FlatPolygon> room_with_pillar() {
  Surface s;
  const auto box = [&](double x0, double y0, double x1, double y1) {
    s.fan({{x0, y0, 0}, {x1, y0, 0}, {x1, y0, 3}, {x0, y0, 3}});
    s.fan({{x1, y0, 0}, {x1, y1, 0}, {x1, y1, 3}, {x1, y0, 3}});
    s.fan({{x1, y1, 0}, {x0, y1, 0}, {x0, y1, 3}, {x1, y1, 3}});
    s.fan({{x0, y1, 0}, {x0, y0, 0}, {x0, y0, 3}, {x0, y1, 3}});
  };
  box(0, 0, 6, 4);
  box(2, 1, 3, 2);
  for (const double z : {0.0, 3.0}) {
    s.level(0, 0, 2, 4, z);
    s.level(3, 0, 6, 4, z);
    s.level(2, 0, 3, 1, z);
    s.level(2, 2, 3, 4, z);
  }
  return join_coplanar(s.soup, s.materials, JoinTolerance::of(s.soup.vertices)).polygons;
}

TEST(BubbleMesh, PolygonsShareTheVerticesOfTheirEdges) {
  const auto polygons = room_with_pillar();
  ASSERT_EQ(polygons.size(), 10U);
  // Each polygon asks for sizes of its own.
  const auto size_at = [](std::size_t i, PlanePoint p) {
    return 0.25 + 0.03 * static_cast<double>(i) + 0.02 * std::sin(p.x + p.y);
  };
  const BubbleMesh made = bubble_mesh(polygons, size_at, {}, {});
  ASSERT_TRUE(made.flaws.empty());
  for (std::size_t i = 0; i < polygons.size(); ++i)
    expect_fills(polygons[i], made.meshes[i], kWeld);
  const Topology t = topology_of(together(made));
  EXPECT_EQ(t.border_edges, 0);
  EXPECT_EQ(t.crowded_edges, 0);
  EXPECT_EQ(t.euler(), 0);  // a ring
  for (const MeshQuality& q : made.quality) EXPECT_GE(q.least_angle_deg, 20.0);
}

TEST(BubbleMesh, EdgesThatLieOnOneAnotherInPartConform) {
  // A wall above two floors; the middle of its lower edge is a corner of theirs.
  Surface s;
  s.fan({{0, 0, 0}, {5, 0, 0}, {5, 0, 3}, {0, 0, 3}});
  s.level(0, 0, 2, 3);
  s.object = 1;
  s.level(2, 0, 5, 4);
  const auto polygons =
      join_coplanar(s.soup, s.materials, JoinTolerance::of(s.soup.vertices)).polygons;
  ASSERT_EQ(polygons.size(), 3U);
  const ElementMesh all = together(meshed(polygons, 0.4));
  const Topology t = topology_of(all);
  EXPECT_EQ(t.crowded_edges, 0);
  EXPECT_NEAR(t.border_m, 5 + 3 + 3 + (2 + 3) + (3 + 4 + 1), 1e-9);
}

TEST(BubbleMesh, KeptMeshesStayAndNewOnesConformToThem) {
  const auto polygons = room_with_pillar();
  const BubbleMesh first = meshed(polygons, 0.5);
  std::vector<PolygonMesh> kept = first.meshes;
  kept[1] = {};
  kept[4] = {};
  BubbleOptions options;
  options.kept = kept;
  const BubbleMesh second = meshed(polygons, 0.2, options);
  ASSERT_TRUE(second.flaws.empty());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (i == 1 || i == 4) {
      EXPECT_GT(second.meshes[i].elements.size(), 2 * first.meshes[i].elements.size());
    } else {
      EXPECT_EQ(second.meshes[i].vertices, first.meshes[i].vertices);
      EXPECT_EQ(second.meshes[i].elements, first.meshes[i].elements);
    }
  }
  EXPECT_EQ(topology_of(together(second)).border_edges, 0);
}

TEST(BubbleMesh, SameBitsForAnyNumberOfThreads) {
  const auto polygons = room_with_pillar();
  const auto once = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return bubble_mesh(polygons, [](std::size_t, PlanePoint p) { return 0.08 + 0.02 * p.x; }, {},
                       {});
  };
  const BubbleMesh one = once(1), four = once(4);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    EXPECT_EQ(one.meshes[i].vertices, four.meshes[i].vertices);
    EXPECT_EQ(one.meshes[i].elements, four.meshes[i].elements);
  }
}

/// Length of a segment that is covered by edges of the mesh which lie within `off_m` of it.
double followed_m(const PolygonMesh& mesh, const ConstraintSegment& s, double off_m) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, whole = std::hypot(dx, dy);
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  double sum = 0.0;
  for (const auto& t : mesh.elements) {
    for (unsigned k = 0; k < 3; ++k) {
      const auto edge = std::minmax(t[k], t[(k + 1) % 3]);
      if (!seen.insert({edge.first, edge.second}).second) continue;
      double at[2];
      bool is_on = true;
      for (const unsigned end : {0U, 1U}) {
        const Vec3 p = mesh.vertices[end == 0 ? edge.first : edge.second];
        const double px = p.x - s.a.x, py = p.y - s.a.y;
        at[end] = (px * dx + py * dy) / whole;
        is_on = is_on && std::abs(px * dy - py * dx) / whole <= off_m;
      }
      if (is_on)
        sum += std::max(
            0.0, std::min(whole, std::max(at[0], at[1])) - std::max(0.0, std::min(at[0], at[1])));
    }
  }
  return sum;
}

TEST(BubbleMesh, EdgesFollowConstraints) {
  const std::vector<FlatPolygon> square{rectangle(4.0, 4.0)};
  const std::vector<std::vector<ConstraintSegment>> lines{{{{0.5, 0.7}, {3.4, 2.9}}}};
  const auto size_at = [](std::size_t, PlanePoint) { return 0.2; };
  const BubbleMesh made = bubble_mesh(square, size_at, lines, {});
  ASSERT_TRUE(made.flaws.empty());
  expect_fills(square[0], made.meshes[0], kWeld);
  const double whole = std::hypot(2.9, 2.2);
  EXPECT_NEAR(followed_m(made.meshes[0], lines[0][0], 1e-9), whole, 1e-9);
  EXPECT_LT(followed_m(bubble_mesh(square, size_at, {}, {}).meshes[0], lines[0][0], 1e-3),
            0.5 * whole);
  EXPECT_GE(made.quality[0].least_angle_deg, 20.0);
}

TEST(BubbleMesh, ConstraintsMayCrossLeaveThePolygonAndLieOnOneAnother) {
  const std::vector<FlatPolygon> angle{
      polygon_of({{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}})};
  const std::vector<std::vector<ConstraintSegment>> lines{
      {{{0.3, 3.7}, {3.7, 0.3}},  // passes the corner
       {{1.0, -1.0}, {1.0, 5.0}},
       {{1.0, 0.5}, {1.0, 3.5}},
       {{1.0001, 0.5}, {1.0, 3.0}},
       {{0.0, 0.0}, {4.0, 0.0}},
       {{0.5, 0.01}, {3.5, 0.02}},
       {{3.0, 3.0}, {3.5, 3.5}},
       {{1.5, 1.5}, {1.5, 1.5}}}};
  const BubbleMesh made =
      bubble_mesh(angle, [](std::size_t, PlanePoint) { return 0.25; }, lines, {});
  ASSERT_FALSE(made.meshes[0].elements.empty());
  expect_fills(angle[0], made.meshes[0], kWeld);
  EXPECT_GE(followed_m(made.meshes[0], {{1.0, 0.0}, {1.0, 4.0}}, 0.13), 3.9);
  EXPECT_GE(made.quality[0].least_angle_deg, 20.0);
}

TEST(BubbleMesh, ShortEdgesAreMetByElementsThatGrowFromThem) {
  // A notch of 2 cm in a wall of elements of 50 cm.
  const std::vector<FlatPolygon> wall{
      polygon_of({{{0, 0}, {4, 0}, {4, 3}, {2.02, 3}, {2.02, 2.98}, {2, 2.98}, {2, 3}, {0, 3}}})};
  const BubbleMesh made = meshed(wall, 0.5);
  ASSERT_TRUE(made.flaws.empty());
  expect_fills(wall[0], made.meshes[0], kWeld);
  EXPECT_GE(made.quality[0].least_angle_deg, 20.0);
  EXPECT_LE(made.meshes[0].elements.size(), 600U);
}

TEST(BubbleMesh, NamesWhatItRefuses) {
  FlatPolygon lost = rectangle(1.0, 1.0);
  lost.rings[0][2].x = std::nan("");
  const std::vector<FlatPolygon> polygons{rectangle(1.0, 1.0),
                                          lost,
                                          polygon_of({{{0, 0}, {1, 0}, {2, 0}}}),
                                          polygon_of({{{0, 0}, {1, 1}, {1, 0}, {0, 2}}}),
                                          rectangle(1.0, 1.0),
                                          rectangle(1.0, 1.0)};
  const auto size_at = [](std::size_t i, PlanePoint) {
    return i == 4 ? -1.0 : i == 5 ? 1e-9 : 0.3;
  };
  // Apart, so that one refusal does not touch another polygon.
  std::vector<FlatPolygon> apart;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    apart.push_back(polygons[i]);
    for (auto& ring : apart[i].rings) {
      for (Vec3& p : ring) p.z += 10.0 * static_cast<double>(i);
    }
    apart[i].origin.z += 10.0 * static_cast<double>(i);
  }
  const BubbleMesh made = bubble_mesh(apart, size_at, {}, {});
  EXPECT_FALSE(made.meshes[0].elements.empty());
  std::vector<std::string_view> names;
  for (const BubbleFlaw& flaw : made.flaws) {
    EXPECT_TRUE(flaw.is_refusal());
    EXPECT_TRUE(made.meshes[flaw.polygon].elements.empty());
    EXPECT_EQ(flaw.polygon, names.size() + 1);
    names.push_back(name_of(flaw.kind));
  }
  EXPECT_EQ(names, (std::vector<std::string_view>{"NotFinite", "NoArea", "RingsCross", "BadSize",
                                                  "TooMany"}));
}

TEST(BubbleMesh, BearsSizesThatAreNoneInside) {
  const std::vector<FlatPolygon> square{rectangle(4.0, 4.0)};
  for (const double bad : {std::nan(""), 0.0, -1.0, 1e-300, 1e300, HUGE_VAL}) {
    const auto size_at = [=](std::size_t, PlanePoint p) {
      return std::hypot(p.x - 2.0, p.y - 2.0) < 1.0 ? bad : 0.2;
    };
    const BubbleMesh made = bubble_mesh(square, size_at, {}, {});
    ASSERT_TRUE(made.flaws.empty());
    expect_fills(square[0], made.meshes[0], kWeld);
  }
}

TEST(BubbleMesh, RefusesBadSizesBesideKeptMeshes) {
  const auto polygons = room_with_pillar();
  std::vector<PolygonMesh> kept = meshed(polygons, 0.5).meshes;
  kept[0] = {};
  BubbleOptions options;
  options.kept = kept;
  const auto size_at = [](std::size_t, PlanePoint) { return std::nan(""); };
  const BubbleMesh made = bubble_mesh(polygons, size_at, {}, options);
  ASSERT_EQ(made.flaws.size(), 1U);
  EXPECT_EQ(made.flaws[0].kind, BubbleFlaw::Kind::BadSize);
}

TEST(BubbleMesh, RefusesNumbersThatDoNotFit) {
  const std::vector<FlatPolygon> square{rectangle(1.0, 1.0)};
  const auto size_at = [](std::size_t, PlanePoint) { return 0.3; };
  const std::vector<std::vector<ConstraintSegment>> lines(2);
  EXPECT_THROW(bubble_mesh(square, size_at, lines, {}), InputError);
  BubbleOptions options;
  const std::vector<PolygonMesh> kept(3);
  options.kept = kept;
  EXPECT_THROW(bubble_mesh(square, size_at, {}, options), InputError);
}

}  // namespace
}  // namespace tenku::testing_support
