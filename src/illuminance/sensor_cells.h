/// Sensors in the cells of a grid: who lies around whom.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/vec3.h"
#include "illuminance/sensor.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Numbers kept in cells, by surface, and found again around a sensor.
class SensorCells {
 public:
  /// @param place    [sensor], in cells
  /// @param surface  [sensor]; only those of one surface find each other
  /// @param reach    cells on either side in which others are found
  SensorCells(std::vector<Vec3> place, std::vector<std::uint64_t> surface, int reach);

  Vec3 place(std::size_t sensor) const { return place_[sensor]; }
  int reach() const { return reach_; }

  void add(std::size_t sensor, std::uint32_t value) { in_cell_[key(sensor, {})].push_back(value); }

  /// What has been added for the cell of a sensor.
  const std::vector<std::uint32_t>& beside(std::size_t sensor) const {
    return values_at(key(sensor, {}));
  }

  /// Calls `take` with each value that has been added for a cell in reach.
  template <class Take>
  void around(std::size_t sensor, Take take) const {
    for (const Vec3& step : steps_) {
      for (const std::uint32_t value : values_at(key(sensor, step))) take(value);
    }
  }
  /// All of them.
  std::vector<std::uint32_t> around(std::size_t sensor) const;
  /// Equal for sensors of one surface in one cell: what lies around them is the same.
  std::uint64_t cell_of(std::size_t sensor) const { return key(sensor, {}); }

 private:
  std::uint64_t key(std::size_t sensor, Vec3 steps_away) const;
  const std::vector<std::uint32_t>& values_at(std::uint64_t key) const;

  std::vector<Vec3> place_;
  std::vector<std::uint64_t> surface_;
  int reach_;
  std::vector<Vec3> steps_;  ///< to the cells in reach
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> in_cell_;
};

/// What lies around sensors, found once for each of their cells.
/// Threads  one.
class CellsAround {
 public:
  /// @param cells  kept by reference; nothing is added meanwhile
  explicit CellsAround(const SensorCells& cells) : cells_(cells) {}
  const std::vector<std::uint32_t>& of(std::size_t sensor) {
    const auto [found, is_new] = of_cell_.try_emplace(cells_.cell_of(sensor));
    if (is_new) found->second = cells_.around(sensor);
    return found->second;
  }

 private:
  const SensorCells& cells_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> of_cell_;
};

/// Ground and flat roofs, as against walls and pitched roofs.
inline bool is_flat(Vec3 normal) { return normal.z > 0.9 || normal.z < -0.9; }

/// A number for the plane that a sensor lies in, equal for sensors of one plane; a gently rolling
/// ground is one.
std::uint64_t plane_of(Vec3 normal, Vec3 position);

/// Positions in units of the side of a cell.
std::vector<Vec3> places_in_cells(const Sensors& sensors, double cell_m);

/// How many sensors of one surface lie in the cell of a sensor, on the mean.
/// @param surface  [sensor]
double sensors_in_cell(const Sensors& sensors, const std::vector<std::uint64_t>& surface,
                       double cell_m);

/// The side, in metres, of cells that hold at most so many, and at least a quarter of that unless
/// there are fewer.
double cell_with(double sensors_in_it, const Sensors& sensors,
                 const std::vector<std::uint64_t>& surface);

/// Whether nothing opaque stands between two sensors.
bool see_each_other(const Sensors& sensors, std::size_t a, std::size_t b,
                    const RayVisibility& rays);

/// The numbers 0 to `count` - 1 in an order that follows that of no surface: the first sensors of a
/// triangle are its corners, where least can be seen.
std::vector<std::uint32_t> shuffled(std::size_t count);

}  // namespace tenku
