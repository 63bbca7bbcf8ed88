#include "radiosity/light_leaks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "core/extent.h"
#include "core/parallel.h"
#include "core/random.h"
#include "meshing/mesh_soup.h"
#include "visibility/ray_visibility.h"

namespace tenku {
namespace {

constexpr int kCells = 24;      // a side of the square of directions
constexpr int kBisections = 8;  // between two rays, to the edge
constexpr std::size_t kMostPoints = 500;
constexpr double kCellShare = 0.02;     // of the longest side: edges so near are one opening
constexpr double kWidest = 0.01;        // of the longest side
constexpr double kLeastShare = 1e-4;    // of the light: less passes where edges meet, by rounding
constexpr double kOpenView = 0.5;       // of the view of a point: it is not in a room
constexpr std::size_t kFewestRays = 3;  // through a gap

/// Where a ray leaves, beside one that does not.
struct Passage {
  Vec3 place;
  double light;
};

/// Directions for equal parts of the cosine, in rows of neighbours: a square of radius and turn.
Vec3 direction(int i, int j, Vec3 normal, const TangentFrame& frame, SampleRandom& random) {
  const double u = (i + random.uniform()) / kCells,
               turn = 2.0 * kPi * (j + random.uniform()) / kCells;
  const double radius = std::sqrt(u);
  return normalized(radius * std::cos(turn) * frame.tangent +
                    radius * std::sin(turn) * frame.bitangent + std::sqrt(1.0 - u) * normal);
}

class Look {
 public:
  Look(const RayVisibility& rays, Vec3 origin, Vec3 normal, SampleRandom random)
      : rays_(rays), origin_(origin) {
    const TangentFrame frame = tangent_frame(normal);
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        way_.push_back(direction(i, j, normal, frame, random));
        const auto hit = rays.first_hit(origin, way_.back());
        distance_.push_back(hit ? hit->distance_m : kNothing);
        missed_ += !hit;
      }
    }
  }
  double open_view() const { return static_cast<double>(missed_) / (kCells * kCells); }

  void add_passages(double light, std::vector<Passage>& passages) const {
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        if (distance_[at(i, j)] != kNothing) continue;
        const std::optional<std::size_t> beside = farthest_hit_beside(i, j);
        if (!beside) continue;
        passages.push_back({edge_between(*beside, at(i, j)), light / (kCells * kCells)});
      }
    }
  }

 private:
  static constexpr double kNothing = -1.0;
  static std::size_t at(int i, int j) {
    return static_cast<std::size_t>(i * kCells + (j + kCells) % kCells);
  }

  std::optional<std::size_t> farthest_hit_beside(int i, int j) const {
    std::optional<std::size_t> farthest;
    for (const auto& [di, dj] :
         std::array<std::array<int, 2>, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
      if (i + di < 0 || i + di >= kCells) continue;
      const std::size_t k = at(i + di, j + dj);
      if (distance_[k] == kNothing) continue;
      if (!farthest || distance_[k] > distance_[*farthest]) farthest = k;
    }
    return farthest;
  }

  /// Where a surface ends between a ray that meets it and one that meets nothing.
  Vec3 edge_between(std::size_t met, std::size_t passed) const {
    Vec3 hit_way = way_[met], free_way = way_[passed];
    double distance = distance_[met];
    for (int step = 0; step < kBisections; ++step) {
      const Vec3 middle = normalized(hit_way + free_way);
      if (const auto hit = rays_.first_hit(origin_, middle)) {
        hit_way = middle;
        distance = hit->distance_m;
      } else {
        free_way = middle;
      }
    }
    return origin_ + distance * hit_way;
  }

  const RayVisibility& rays_;
  Vec3 origin_;
  std::vector<Vec3> way_;
  std::vector<double> distance_;
  int missed_ = 0;
};

using Cell = std::array<std::int64_t, 3>;

/// Passages in cells that touch, together.
std::vector<std::vector<Passage>> openings(const std::vector<Passage>& passages, double cell_m) {
  std::map<Cell, std::vector<Passage>> cells;
  const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell_m)); };
  for (const Passage& p : passages) {
    cells[{index(p.place.x), index(p.place.y), index(p.place.z)}].push_back(p);
  }
  std::vector<std::vector<Passage>> result;
  while (!cells.empty()) {
    std::vector<Passage> together;
    std::vector<Cell> waiting{cells.begin()->first};
    while (!waiting.empty()) {
      const Cell cell = waiting.back();
      waiting.pop_back();
      auto found = cells.extract(cell);
      if (found.empty()) continue;
      together.insert(together.end(), found.mapped().begin(), found.mapped().end());
      for (int k = 0; k < 27; ++k) {
        const Cell near{cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1};
        if (cells.contains(near)) waiting.push_back(near);
      }
    }
    result.push_back(std::move(together));
  }
  return result;
}

LightLeak leak_of(const std::vector<Passage>& opening, double all_light) {
  Extent extent;
  LightLeak leak;
  for (const Passage& p : opening) {
    extent.add(p.place);
    leak.share += p.light / all_light;
  }
  const Vec3 size = extent.size();
  std::array<double, 3> sides{size.x, size.y, size.z};
  std::sort(sides.begin(), sides.end());
  leak.place = extent.middle();
  leak.length_m = sides[2];
  leak.width_m = sides[1];
  return leak;
}

}  // namespace

std::vector<LightLeak> find_light_leaks(const ElementMesh& mesh, const Sensors& points,
                                        std::span<const double> light, double lift_m,
                                        std::uint64_t seed) {
  const MeshSoup made = soup_of(mesh);
  const RayVisibility rays(made.soup, made.materials);
  std::vector<std::size_t> from;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (light[i] > 0.0) from.push_back(i);
  }
  const std::size_t step = from.size() / kMostPoints + 1, count = from.size() / step;
  std::vector<std::vector<Passage>> seen(count);
  std::vector<double> sent(count);
  parallel_for(count, 16, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      const std::size_t i = from[k * step];
      const Vec3 normal = points.normal[i];
      const Look look(rays, points.position[i] + lift_m * normal, normal, SampleRandom(seed, i, 5));
      if (look.open_view() > kOpenView) continue;
      sent[k] = light[i];
      look.add_passages(light[i], seen[k]);
    }
  });
  std::vector<Passage> passages;
  for (const auto& some : seen) passages.insert(passages.end(), some.begin(), some.end());
  const double all = std::accumulate(sent.begin(), sent.end(), 0.0);
  const double longest = extent_of(mesh.vertices).longest_side();
  std::vector<LightLeak> leaks;
  for (const auto& opening : openings(passages, kCellShare * longest)) {
    const LightLeak leak = leak_of(opening, all);
    if (opening.size() < kFewestRays || leak.width_m > kWidest * longest) continue;
    if (leak.share > kLeastShare) leaks.push_back(leak);
  }
  std::sort(leaks.begin(), leaks.end(),
            [](const LightLeak& a, const LightLeak& b) { return a.share > b.share; });
  return leaks;
}

void tell_light_leaks(const std::vector<LightLeak>& leaks, std::vector<Finding>& findings) {
  if (leaks.empty()) return;
  const LightLeak& worst = leaks.front();
  Finding finding;
  finding.code = "light_leak";
  finding.where = fmt::format("{:.2f} m east, {:.2f} m north, {:.2f} m up of the origin",
                              worst.place.x, worst.place.y, worst.place.z);
  finding.what = fmt::format(
      "light escapes through a gap about {:.2f} m long and {:.3f} m wide between surfaces that "
      "enclose a room: {:.2g} % of what they send",
      worst.length_m, worst.width_m, 100.0 * worst.share);
  finding.repair = "surfaces that meet, if it is not meant";
  finding.count = leaks.size();
  findings.push_back(std::move(finding));
}

}  // namespace tenku
