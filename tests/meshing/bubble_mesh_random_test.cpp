// Random polygons as bad as they come: each ends in a mesh that fills it, or in a named refusal.
// TENKU_RANDOM_POLYGONS sets how many; docs/validation.md has the figures of 10,000.
#include <chrono>
#include <cstdlib>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "core/random.h"
#include "meshing/bubble_mesh.h"
#include "meshing/plane_shapes.h"

namespace tenku::testing_support {
namespace {

enum class Kind { Star, Holes, Neck, Sliver, Comb, Spiral, NoArea, Crossing, Far };
constexpr int kKinds = 9;
constexpr const char* kNames[] = {"star",   "holes",   "neck",     "sliver", "comb",
                                  "spiral", "no area", "crossing", "far"};

struct Model {
  Kind kind;
  FlatPolygon polygon;
  std::vector<ConstraintSegment> lines;
  double size_m, wave, most_ratio;

  /// Waves, and in some models a cliff, between `size_m` and many times that.
  double size_at(PlanePoint p) const {
    if (wave < 0.0) return p.x < 0.4 ? size_m : most_ratio * size_m;
    return size_m * (1.0 + (most_ratio - 1.0) * (0.5 + 0.5 * std::sin(wave * p.x + p.y)));
  }
};

class Maker {
 public:
  explicit Maker(std::uint64_t number) : chance_(20261122, number, 0), number_(number) {}

  Model model() {
    Model m;
    m.kind = static_cast<Kind>(number_ % kKinds);
    m.polygon = polygon_of(rings(m.kind), frame(m.kind == Kind::Far ? 1e4 : 1.0));
    m.size_m = std::pow(10.0, between(-1.7, 0.5));
    m.wave = between(-1.0, 6.0);
    m.most_ratio = std::pow(10.0, between(0.0, 1.0));
    if (chance_.uniform() < 0.5) m.lines = lines();
    return m;
  }

 private:
  double between(double low, double high) { return low + (high - low) * chance_.uniform(); }
  int whole(int low, int high) {
    return low + static_cast<int>((high - low + 1) * chance_.uniform());
  }
  /// From 1 down to `least`, all powers alike.
  double tiny(double least) { return std::pow(least, chance_.uniform()); }

  FlatPolygon frame(double far) {
    FlatPolygon f;
    f.normal = normalized({between(-1, 1), between(-1, 1), between(-1, 1) + 1e-3});
    const TangentFrame axes = tangent_frame(f.normal);
    f.along = axes.tangent;
    f.across = axes.bitangent;
    f.origin = {between(-far, far), between(-far, far), between(-far, far)};
    return f;
  }

  /// Counter-clockwise about a point, radii between the two.
  Ring star(PlanePoint middle, double inner, double outer, int corners) {
    Ring ring;
    const double turn = between(0.0, 6.28);
    for (int k = 0; k < corners; ++k) {
      const double a = turn + 2.0 * kPi * (k + 0.8 * chance_.uniform()) / corners;
      const double r = between(inner, outer);
      ring.push_back({middle.x + r * std::cos(a), middle.y + r * std::sin(a)});
    }
    return ring;
  }

  std::vector<Ring> rings(Kind kind) {
    switch (kind) {
      case Kind::Star:
      case Kind::Far:
        return {star({0, 0}, 0.05, 1.0, whole(3, 40))};
      case Kind::Holes:
        return holes();
      case Kind::Neck: {
        const double w = 0.5 * tiny(1e-5), x = between(0.0, 0.3);
        return {{{-1, -1},
                 {-x, -1},
                 {-x, -w},
                 {x, -w},
                 {x, -1},
                 {1, -1},
                 {1, 1},
                 {x, 1},
                 {x, w},
                 {-x, w},
                 {-x, 1},
                 {-1, 1}}};
      }
      case Kind::Sliver: {
        const double w = tiny(1e-4), s = between(-2.0, 2.0);
        if (chance_.uniform() < 0.5) return {{{0, 0}, {1, 0}, {between(-0.5, 1.5), w}}};
        return {{{0, 0}, {1, 0}, {1 + s * w, w}, {s * w, w}}};
      }
      case Kind::Comb:
        return {comb()};
      case Kind::Spiral:
        return {spiral()};
      case Kind::NoArea: {
        const double x = between(0.1, 1.0);
        if (chance_.uniform() < 0.3) return {{{0, 0}, {x, x}, {2 * x, 2 * x}}};
        if (chance_.uniform() < 0.5) return {{{x, 0}, {x, 0}, {x, 0}, {x, 0}}};
        return {{{0, 0}, {1, 0}, {1, x}, {1, 0}}};
      }
      case Kind::Crossing: {
        Ring ring;
        for (int k = whole(4, 12); k > 0; --k) ring.push_back({between(-1, 1), between(-1, 1)});
        if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
        return {ring};
      }
    }
    return {};
  }

  std::vector<Ring> holes() {
    std::vector<Ring> made{star({0, 0}, 0.9, 1.0, whole(8, 30))};
    const int n = whole(1, 4);
    for (int k = 0; k < n; ++k) {
      const double a = 2.0 * kPi * k / n, least = 0.3 * tiny(1e-4);
      Ring hole = star({0.4 * std::cos(a), 0.4 * std::sin(a)}, 0.5 * least, least / (1 + n / 3.0),
                       whole(5, 9));
      std::reverse(hole.begin(), hole.end());
      made.push_back(hole);
    }
    return made;
  }

  Ring comb() {
    const int teeth = whole(1, 12);
    const double gap = 0.9 * tiny(1e-4), deep = between(0.1, 0.99);
    Ring ring{{0, 0}, {1.0 * teeth, 0}};
    for (int k = teeth; k > 0; --k) {
      ring.push_back({1.0 * k, 1.0});
      ring.push_back({k - 1.0 + gap, 1.0});
      if (k > 1) {
        ring.push_back({k - 1.0 + gap, 1.0 - deep});
        ring.push_back({k - 1.0, 1.0 - deep});
      }
    }
    ring.push_back({0, 1.0});
    return ring;
  }

  Ring spiral() {
    const int turns = whole(1, 4), steps = 12 * turns;
    const double width = 0.5 * tiny(1e-3);
    Ring ring;
    for (int k = 0; k <= steps; ++k) {
      const double a = 2.0 * kPi * k / 12.0, r = 0.3 + a / (2.0 * kPi) + width;
      ring.push_back({r * std::cos(a), r * std::sin(a)});
    }
    for (int k = steps; k >= 0; --k) {
      const double a = 2.0 * kPi * k / 12.0, r = 0.3 + a / (2.0 * kPi);
      ring.push_back({r * std::cos(a), r * std::sin(a)});
    }
    return ring;
  }

  /// Random, and some beside the one before or on it.
  std::vector<ConstraintSegment> lines() {
    std::vector<ConstraintSegment> made;
    for (int k = whole(1, 6); k > 0; --k) {
      const double d = tiny(1e-9);
      if (!made.empty() && chance_.uniform() < 0.5) {
        const auto [a, b] = made.back();
        made.push_back({{a.x + d * between(-1, 1), a.y + d}, {b.x - d, b.y + d * between(-1, 1)}});
      } else {
        made.push_back({{between(-1, 1), between(-1, 1)}, {between(-1, 1), between(-1, 1)}});
      }
    }
    return made;
  }

  SampleRandom chance_;
  std::uint64_t number_;
};

/// Which polygons, by number.
std::vector<int> asked() {
  const char* number = std::getenv("TENKU_RANDOM_POLYGONS");
  std::vector<int> numbers(number != nullptr ? static_cast<std::size_t>(std::atoi(number)) : 90);
  std::iota(numbers.begin(), numbers.end(), 0);
  // Of these, constraints along the outline once made triangles without area.
  if (number == nullptr) numbers.insert(numbers.end(), {378, 1234, 3672, 3853, 4033});
  return numbers;
}

struct Count {
  int meshed = 0;
  std::map<std::string, int> refused;
  std::size_t elements = 0;
  double mean_angle = 0.0, longest_s = 0.0;
};

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TEST(BubbleMeshRandom, EachIsFilledOrRefusedByName) {
  Count counts[kKinds];
  for (const int i : asked()) {
    SCOPED_TRACE("polygon " + std::to_string(i));
    const Model model = Maker(static_cast<std::uint64_t>(i)).model();
    const std::vector<FlatPolygon> polygon{model.polygon};
    const std::vector<std::vector<ConstraintSegment>> lines{model.lines};
    const double start = seconds();
    const BubbleMesh made = bubble_mesh(
        polygon, [&](std::size_t, PlanePoint p) { return model.size_at(p); }, lines, {});
    Count& count = counts[static_cast<int>(model.kind)];
    count.longest_s = std::max(count.longest_s, seconds() - start);
    const bool is_sound = model.kind != Kind::NoArea && model.kind != Kind::Crossing;
    if (!made.flaws.empty() && made.flaws[0].is_refusal()) {
      EXPECT_TRUE(made.meshes[0].elements.empty());
      EXPECT_FALSE(is_sound) << name_of(made.flaws[0].kind);
      ++count.refused[std::string(name_of(made.flaws[0].kind))];
      continue;
    }
    ASSERT_FALSE(made.meshes[0].elements.empty());
    ++count.meshed;
    count.elements += made.meshes[0].elements.size();
    count.mean_angle += made.quality[0].mean_smallest_angle_deg;
    const double weld = model.kind == Kind::Far ? 0.005 : 3e-5;
    expect_fills(model.polygon, made.meshes[0], weld);
    EXPECT_LE(made.quality[0].steps, BubbleOptions{}.steps_most);
    if (HasFatalFailure()) return;
  }
  for (int k = 0; k < kKinds; ++k) {
    const Count& c = counts[k];
    std::printf("%-9s %5d meshed, %8zu elements, mean angle %.1f, longest %.2f s", kNames[k],
                c.meshed, c.elements, c.meshed > 0 ? c.mean_angle / c.meshed : 0.0, c.longest_s);
    for (const auto& [name, n] : c.refused) std::printf(", %d %s", n, name.c_str());
    std::printf("\n");
  }
}

}  // namespace
}  // namespace tenku::testing_support
