#include "verification/reference_cases.h"

#include <algorithm>
#include <cmath>

namespace tenku::testing_support {
namespace {

using Parameters = std::array<double, 6>;

// What is infinite in the reference ends here, this many times the largest distance away, closed
// by walls across: what they hide wrongly is of second order.
constexpr double kEndless = 100.0;

void add_canyon(TestScene& scene, const Parameters& p, Vec3 point) {
  const auto [left, right, width, d, e, f] = p;
  const bool one_wall = width > 1e5;
  const double far = kEndless * std::max({left, right, one_wall ? point.x : width});
  scene.wall({0, -far, 0, far}, 0, left);
  if (one_wall) return;
  scene.wall({width, -far, width, far}, 0, right);
  const double lower = std::min(left, right);
  scene.wall({0, -far, width, -far}, 0, lower);
  scene.wall({0, far, width, far}, 0, lower);
}

void add_overhang(TestScene& scene, const Parameters& p, Vec3) {
  const auto [depth, above, elevation_deg, d, e, f] = p;
  const double distance = 2.0 * (depth + above), far = kEndless * distance;
  const double obstruction = distance * std::tan(elevation_deg * kPi / 180.0);
  if (depth > 0.0) {
    scene.level({-far, 0, far, depth}, above);
    scene.wall({-far, 0, -far, depth}, 0, above);
    scene.wall({far, 0, far, depth}, 0, above);
  }
  scene.begin_object();
  if (elevation_deg <= 0.0) return;
  scene.wall({-far, distance, far, distance}, 0, obstruction);
  scene.wall({-far, 0, -far, distance}, 0, obstruction);
  scene.wall({far, 0, far, distance}, 0, obstruction);
}

void add_courtyard(TestScene& scene, const Parameters& p, Vec3) {
  const auto [w, d, h, x, y, z] = p;
  scene.wall({0, 0, w, 0}, 0, h);
  scene.wall({w, 0, w, d}, 0, h);
  scene.wall({w, d, 0, d}, 0, h);
  scene.wall({0, d, 0, 0}, 0, h);
}

void add_obstruction(TestScene& scene, const std::string& kind, const Parameters& p, Vec3 point) {
  if (kind == "canyon") add_canyon(scene, p, point);
  if (kind == "overhang") add_overhang(scene, p, point);
  if (kind == "courtyard") add_courtyard(scene, p, point);
  if (kind == "block") scene.wall({p[1], p[0], p[2], p[0]}, 0, p[3]);
  if (kind == "slab") scene.level({p[0], p[2], p[1], p[3]}, p[4]);
  if (kind == "box") scene.box({p[0], p[1], 0}, {p[2], p[3], p[4]}, p[5]);
}

/// The rectangle 0..4 x `low`..`high` with the hole `a`..`b` in both directions, in pieces that
/// `place` puts where they belong.
struct Span {
  double low, high;
};
template <class Place>
void with_hole(Span u, Span v, Span hole_u, Span hole_v, const Place& place) {
  if (hole_v.low > v.low) place(u, Span{v.low, hole_v.low});
  if (hole_v.high < v.high) place(u, Span{hole_v.high, v.high});
  if (hole_u.low > u.low) place(Span{u.low, hole_u.low}, hole_v);
  if (hole_u.high < u.high) place(Span{hole_u.high, u.high}, hole_v);
}

void add_south_wall(TestScene& scene, Span hole_x, Span hole_z) {
  with_hole({0, 4}, {0, 3}, hole_x, hole_z, [&](Span x, Span z) {
    scene.wall({x.low, 0, x.high, 0}, z.low, z.high);
  });
}

void add_ceiling(TestScene& scene, Span hole) {
  with_hole({0, 4}, {0, 4}, hole, hole, [&](Span x, Span y) {
    scene.level({x.low, y.low, x.high, y.high}, 3);
  });
}

/// The room of CIE 171, 4 x 4 x 3 m, with the opening and the mask of one case.
void add_cie_171_room(TestScene& scene, const std::string& name) {
  constexpr Span kNone{0, 0};
  scene.level({0, 0, 4, 4}, 0);
  scene.wall({4, 0, 4, 4}, 0, 3);
  scene.wall({4, 4, 0, 4}, 0, 3);
  scene.wall({0, 4, 0, 0}, 0, 3);
  const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
  const bool roof = has("roof");
  if (roof) add_south_wall(scene, kNone, kNone);
  if (has("roof") && has("1x1")) add_ceiling(scene, {1.5, 2.5});
  if (has("roof") && has("2x2")) {
    add_ceiling(scene, {1, 3});
    Material pane;
    pane.name = "pane";
    pane.index = 1.52;
    scene.materials.push_back(pane);
    scene.begin_object();
    scene.level({1, 1, 3, 3}, 3, 1);
  }
  if (roof) return;
  add_ceiling(scene, kNone);
  if (has("4x3")) return;  // the whole south wall is open
  add_south_wall(scene, {1, 3}, {1, 2});
  const double size = std::stod(name.substr(name.rfind('_') + 1));
  if (has("hmask")) scene.level({-20, -size, 24, 0}, 3);
  scene.begin_object();
  if (has("vmask")) scene.wall({-100, -6, 104, -6}, 0, size);
}

/// Gathers rows of one scene and one sky.
class CaseList {
 public:
  ReferenceCase& at(const std::string& name) {
    const auto [place, is_new] = index_.emplace(name, cases_.size());
    if (is_new) {
      cases_.emplace_back();
      cases_.back().name = name;
      cases_.back().scene = std::make_shared<TestScene>();
    }
    return cases_[place->second];
  }
  std::shared_ptr<DaylightSource> source(const std::string& sky, double sun_altitude_deg) {
    auto& source = sources_[sky + "/" + std::to_string(sun_altitude_deg)];
    if (!source) {
      source = std::make_shared<DaylightSource>(
          source_of(*numbered_sky(std::stoi(sky), sun_altitude_deg, 180.0)));
    }
    return source;
  }
  std::vector<ReferenceCase> take() { return std::move(cases_); }

 private:
  std::vector<ReferenceCase> cases_;
  std::map<std::string, std::size_t> index_;
  std::map<std::string, std::shared_ptr<DaylightSource>> sources_;
};

Vec3 vector_in(const ReferenceTable& table, std::size_t row, const char* prefix) {
  const std::string n = prefix;
  return {table.number(row, n + "x"), table.number(row, n + "y"), table.number(row, n + "z")};
}

}  // namespace

std::vector<ReferenceCase> obstructed_cases() {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/illuminance/obstructed_sky.csv");
  CaseList list;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const std::string kind = table.text(row, "kind"), sky = table.text(row, "sky");
    Parameters p{};
    std::string name = kind;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const std::string column(1, static_cast<char>('a' + k));
      p[k] = table.number(row, column);
      name += " " + table.text(row, column);
    }
    Vec3 point = vector_in(table, row, "");
    const Vec3 normal = vector_in(table, row, "n");
    // A single wall reaches as far as the farthest sensor needs.
    if (kind == "canyon" && p[2] > 1e5) name += " x " + table.text(row, "x");
    ReferenceCase& one = list.at(name + " sky " + sky);
    if (one.sensors.size() == 0) {
      add_obstruction(*one.scene, kind, p, point);
      one.source = list.source(sky, 40.0);
    }
    one.sensors.position.push_back(point);
    one.sensors.normal.push_back(normal);
    one.ratio.push_back(table.number(row, "ratio"));
  }
  return list.take();
}

std::vector<ReferenceCase> cie_171_cases() {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/illuminance/cie_171.csv");
  CaseList list;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const std::string name = table.text(row, "case"), sky = table.text(row, "sky");
    ReferenceCase& one = list.at(name + " sky " + sky);
    if (one.sensors.size() == 0) {
      add_cie_171_room(*one.scene, name);
      one.source = list.source(sky, name[0] == 'X' ? 35.0 : 60.0);
    }
    one.sensors.position.push_back(vector_in(table, row, ""));
    one.sensors.normal.push_back(vector_in(table, row, "n"));
    one.ratio.push_back(table.number(row, "percent") / 100.0);
  }
  return list.take();
}

}  // namespace tenku::testing_support
