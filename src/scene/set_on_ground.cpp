#include "scene/set_on_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "scene/geometry_checks.h"

namespace tenku {
namespace {

constexpr double kFoot_m = 0.05;    // of height that counts as one level
constexpr double kHill_m = 20.0;    // beyond, walls drawn down are worth a warning
constexpr double kFloats_m = 0.5;   // terrain models are no better
constexpr double kBuried_m = 0.5;   // the same
constexpr double kOffHeight_m = 2;  // of most of a city: another datum
constexpr std::size_t kFew = 3;     // buildings at one height by no chance

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Bridges stand on their piers.
bool can_stand(const RawScene& raw, std::uint32_t object) {
  return raw.is_building[object] != 0 && !raw.scene.objects[object].type.starts_with("Bridge") &&
         !raw.scene.objects[object].type.starts_with("Tunnel");
}

/// Calls visit(object, vertex&) for each corner of the buildings.
template <class Visit>
void for_each_corner(RawScene& raw, const Visit& visit) {
  Surfaces& surfaces = raw.scene.surfaces;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (!can_stand(raw, surfaces.object[s])) continue;
    const std::size_t end = surfaces.first_vertex[surfaces.first_ring[s + 1]];
    for (std::size_t k = surfaces.first_vertex[surfaces.first_ring[s]]; k < end; ++k) {
      visit(surfaces.object[s], surfaces.vertex[k]);
    }
  }
}

/// [object] the building that a part belongs to, or itself.
std::vector<std::uint32_t> buildings_of(const Scene& scene) {
  std::vector<std::uint32_t> root(scene.objects.size());
  for (std::uint32_t k = 0; k < root.size(); ++k) {
    root[k] = k;
    for (std::size_t steps = 0; scene.objects[root[k]].parent != kNone; ++steps) {
      if (steps > root.size()) break;  // parents in a ring
      root[k] = scene.objects[root[k]].parent;
    }
  }
  return root;
}

/// How a building lies to the ground beneath it.
struct Standing {
  double lowest = kInfinity, highest = -kInfinity;        // m, local
  double least_gap = kInfinity, least_depth = kInfinity;  // of its feet; of all its corners
  double ground = kInfinity;                              // the lowest under its feet
  Vec3 foot{};
  bool has_ground = false;
};

std::vector<Standing> standings(RawScene& raw, const GroundHeights& ground,
                                const std::vector<std::uint32_t>& root) {
  std::vector<Standing> found(raw.scene.objects.size());
  const std::vector<Vec3>& vertices = raw.scene.vertices;
  for_each_corner(raw, [&](std::uint32_t object, std::uint32_t vertex) {
    Standing& one = found[root[object]];
    one.lowest = std::min(one.lowest, vertices[vertex].z);
    one.highest = std::max(one.highest, vertices[vertex].z);
  });
  for_each_corner(raw, [&](std::uint32_t object, std::uint32_t vertex) {
    Standing& one = found[root[object]];
    const Vec3 at = vertices[vertex];
    const auto z = ground.at(at.x, at.y);
    if (!z) return;
    one.least_depth = std::min(one.least_depth, *z - at.z);
    if (at.z > one.lowest + kFoot_m) return;
    one.has_ground = true;
    if (at.z - *z < one.least_gap) one.least_gap = at.z - *z, one.foot = at;
    one.ground = std::min(one.ground, *z);
  });
  return found;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Whether all feet are at one height, and that is not the terrain's: 0, or that of a few.
bool has_no_heights(const std::vector<Standing>& standings) {
  double low = kInfinity, high = -kInfinity;
  std::vector<double> gap;
  for (const Standing& one : standings) {
    if (!one.has_ground) continue;
    low = std::min(low, one.lowest), high = std::max(high, one.lowest);
    gap.push_back(std::abs(one.lowest - one.ground));
  }
  const bool is_told = gap.size() >= kFew || std::abs(low) < kFoot_m;
  return !gap.empty() && is_told && high - low < kFoot_m && median_of(gap) > kFloats_m;
}

/// Moves each building by its own height; corners that it shares with others become its own.
void move_buildings(RawScene& raw, const std::vector<Standing>& standings,
                    const std::vector<std::uint32_t>& root) {
  std::unordered_map<std::uint64_t, std::uint32_t> moved;  // building and vertex -> its own vertex
  std::size_t count = 0;
  double farthest = 0.0;
  for_each_corner(raw, [&](std::uint32_t object, std::uint32_t& vertex) {
    const Standing& one = standings[root[object]];
    if (!one.has_ground) return;
    const auto [found, is_new] =
        moved.emplace(std::uint64_t{root[object]} << 32U | vertex,
                      static_cast<std::uint32_t>(raw.scene.vertices.size()));
    if (is_new) {
      const Vec3 at = raw.scene.vertices[vertex];
      raw.scene.vertices.push_back({at.x, at.y, at.z + one.ground - one.lowest});
    }
    vertex = found->second;
  });
  for (const Standing& one : standings) {
    if (!one.has_ground) continue;
    ++count;
    farthest = std::max(farthest, std::abs(one.ground - one.lowest));
  }
  if (count == 0) return;
  raw.findings.add({"set_on_terrain", Severity::Warning, "", "",
                    fmt::format("{} buildings stand at one height, off the terrain", count),
                    fmt::format("set on the lowest terrain under their feet, moved by up to {:.1f} "
                                "m; --on-terrain keep leaves them",
                                farthest),
                    count});
}

}  // namespace

LoweredFeet lower_feet(RawScene& raw, const GroundUnder& ground) {
  Scene& scene = raw.scene;
  std::vector<double> lowest(scene.objects.size(), kInfinity);
  for_each_corner(raw, [&](std::uint32_t object, std::uint32_t vertex) {
    lowest[object] = std::min(lowest[object], scene.vertices[vertex].z);
  });
  std::unordered_map<std::uint64_t, std::uint32_t> foot;  // object and vertex -> its own vertex
  std::vector<double> drop(scene.objects.size(), 0.0);
  for_each_corner(raw, [&](std::uint32_t object, std::uint32_t& vertex) {
    const Vec3 at = scene.vertices[vertex];
    if (at.z > lowest[object] + kFoot_m) return;
    const auto z = ground(at.x, at.y);
    if (!z || at.z < *z + kFoot_m) return;
    const auto [found, is_new] = foot.emplace(std::uint64_t{object} << 32U | vertex,
                                              static_cast<std::uint32_t>(scene.vertices.size()));
    if (is_new) scene.vertices.push_back({at.x, at.y, *z});
    drop[object] = std::max(drop[object], at.z - *z);
    vertex = found->second;
  });
  LoweredFeet lowered;
  for (const double metres : drop) {
    if (metres > 0.0) ++lowered.buildings;
    lowered.farthest_m = std::max(lowered.farthest_m, metres);
  }
  return lowered;
}

void set_on_ground(RawScene& raw, const GroundHeights& ground, OnTerrain how) {
  const std::vector<std::uint32_t> root = buildings_of(raw.scene);
  const std::vector<Standing> found = standings(raw, ground, root);
  const bool is_moved = how == OnTerrain::Move || (how == OnTerrain::Auto && has_no_heights(found));
  if (is_moved) move_buildings(raw, found, root);
  std::vector<double> gap;
  std::size_t beside = 0;
  for (const Standing& one : found) {
    if (one.has_ground) gap.push_back(one.lowest - one.ground);
    if (!one.has_ground && one.lowest < kInfinity) ++beside;
  }
  if (beside > 0) {
    raw.findings.add({"off_terrain", Severity::Warning, "", "",
                      fmt::format("{} buildings have no terrain under them", beside),
                      "left as they are; there is no ground below them", beside});
  }
  if (!is_moved && !gap.empty() && std::abs(median_of(gap)) > kOffHeight_m) {
    raw.findings.add(
        {"off_terrain", Severity::Warning, "", "",
         fmt::format("half of the buildings stand {:.1f} m or more {} the terrain",
                     std::abs(median_of(gap)), median_of(gap) > 0.0 ? "above" : "below"),
         "left as they are: heights above different datums? --on-terrain move sets "
         "each on it"});
  }
  if (how == OnTerrain::Keep) return;
  const LoweredFeet lowered = lower_feet(raw, [&](double x, double y) { return ground.at(x, y); });
  if (lowered.buildings == 0) return;
  raw.findings.add(
      {"feet_lowered", lowered.farthest_m > kHill_m ? Severity::Warning : Severity::Note, "", "",
       fmt::format("feet of {} buildings stand above the terrain, by up to {:.1f} m",
                   lowered.buildings, lowered.farthest_m),
       "their walls were drawn down to it, so that no light comes from below", lowered.buildings});
}

void check_on_ground(RawScene& raw, const GroundHeights& ground) {
  const std::vector<Standing> found = standings(raw, ground, buildings_of(raw.scene));
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Standing& one = found[k];
    if (!one.has_ground) continue;
    const std::string& id = raw.scene.objects[k].id;
    const std::string where = place_in_file(raw.scene, one.foot);
    if (one.least_gap > kFloats_m) {
      raw.findings.add({"floating_building", Severity::Warning, id, where,
                        fmt::format("the lowest foot is {:.2f} m above the terrain", one.least_gap),
                        "left as it is"});
    }
    if (one.least_depth > kBuried_m) {
      raw.findings.add(
          {"buried_building", Severity::Warning, id, where,
           fmt::format("all of it is {:.2f} m or more below the terrain", one.least_depth),
           "left as it is"});
    }
  }
}

}  // namespace tenku
