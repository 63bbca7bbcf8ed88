/// The sky summed up along vertical slices, so that any range of altitudes costs two look-ups.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/altitude.h"
#include "sky_models/sky_model.h"

namespace tenku {

/// Integrals of the sky over altitude from the horizon, at one azimuth:
/// `along` = integral of L cos^2(altitude), `up` = integral of L sin(altitude) cos(altitude).
///
/// A surface whose normal has the component `h` toward the azimuth and `z` upward receives
/// h * along + z * up from the slice, per radian of azimuth.
/// Units    cd/m2.
struct SliceMoments {
  double along = 0.0, up = 0.0;

  friend constexpr SliceMoments operator-(SliceMoments a, SliceMoments b) {
    return {a.along - b.along, a.up - b.up};
  }
};

/// Moments of a sky, tabulated over azimuth and altitude.
///
/// Error    below 1e-4 of the horizontal illuminance for the CIE and Perez skies (tested): the
///          columns are interpolated linearly, the altitudes by cubics that also match the slope.
/// Threads  immutable after construction; may be shared.
class SkyTable {
 public:
  explicit SkyTable(const SkyModel& sky);

  /// The table at one azimuth (radians, any number of turns).
  class Column {
   public:
    SliceMoments to(double altitude_rad) const;
    /// The row of the table in which h * along + z * up, summed from the horizon, passes
    /// `wanted`, as a range of altitudes. The sum must rise with altitude from `low_rad` on.
    struct Row {
      double low, high;
    };
    Row row_reaching(double wanted, double h, double z, double low_rad, double high_rad) const;

   private:
    friend class SkyTable;
    Column(const SkyTable* table, const float* left, const float* right, double weight)
        : table_(table), left_(left), right_(right), weight_(weight) {}
    const SkyTable* table_;
    const float *left_, *right_;
    double weight_;
  };
  Column column(double azimuth_rad) const;

  /// Standard error of light from the columns in `width_rad` clockwise of an azimuth, of its value:
  /// what a line between two columns misses. 0 where all are alike.
  double column_error(double azimuth_rad, double width_rad) const;
  /// Illuminance of the unobstructed horizontal plane, lux.
  double horizontal_lux() const { return horizontal_lux_; }
  /// Illuminance of an unobstructed plane with the given normal, lux; below the horizon dark.
  double unobstructed_lux(Vec3 normal) const;

 private:
  static constexpr int kNodeFloats = 4;  // along, its slope, up, its slope

  /// @param altitude  of the rows, and of two points inside between each and the next
  void fill_column(const SkyModel& sky, std::span<const Altitude> altitude, int column);
  void drop_equal_columns();
  void find_column_errors();

  int columns_, rows_;
  double row_rad_, rows_per_rad_;
  std::vector<float> node_;           ///< [column][row][4]; one column if all are alike
  std::vector<double> column_error_;  ///< of the columns before each, summed up; one if all alike
  double horizontal_lux_ = 0.0;
};

/// The part of a slice in front of a surface: altitudes at which n . d > 0.
struct FrontRange {
  double low, high;  ///< low >= high: nothing
};
FrontRange front_range(double normal_along, double normal_up);

}  // namespace tenku
