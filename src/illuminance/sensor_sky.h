/// Skylight on one sensor, refined slice by slice.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "illuminance/sky_table.h"
#include "visibility/slice_tracer.h"

namespace tenku {

/// Illuminance of one sensor from the visible sky, with its standard error.
///
/// The azimuths of the slices stand at equal steps from a random start; each slice is exact in
/// altitude (SliceTracer), so that what is left is a sum over azimuth of a function that is
/// smooth but where one outline gives way to another. Doubling the slices keeps the old ones.
///
/// Error    three parts, all independent and added as variances:
///          steps: the place of a step between two slices is unknown. With second differences
///            r = f(i) - (f(i-1) + f(i+1)) / 2 beside steps, w the pitch, its variance is
///            w^2 sum(r^2) (1/6 + s/3w), s the scatter (a step of height h gives
///            sum(r^2) = h^2/2 and an error that is uniform in [-wh/2, wh/2], to which each slice
///            within s of the step adds its chance to lie on either side);
///          scatter: each azimuth is moved at random by up to +-kScatter/2, which gives smooth
///            parts an error of known size;
///          checks: rays at random altitudes measure what the slices missed.
class SensorSky {
 public:
  /// @param table   null for no sky: only the sky view factor is found
  /// @param normal  unit vector
  SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
            SampleRandom random);

  /// Doubles the slices (the first call makes `kFirstSlices`).
  void refine();

  double lux() const { return lux_; }
  double sky_view() const { return sky_view_; }
  double variance() const { return variance_; }  ///< of `lux`, lux^2
  int slices() const { return static_cast<int>(slice_.size()); }
  std::uint64_t rays_sent() const { return tracer_.rays_sent(); }

  static constexpr int kFirstSlices = 16;
  static constexpr double kScatter = 0.002;  // radians

 private:
  /// What one slice gives, per radian of azimuth.
  struct Slice {
    double lux = 0.0, view = 0.0;
    OutlineEdge low_edge, high_edge;
    int ranges = 0;
    bool continues(const Slice& other) const;
  };
  /// A visible range of altitudes, with the transmittance of the panes before it.
  struct Piece {
    AltitudeRange range;
    double transmittance;
  };
  /// Sums over the slices of what their checks found, weighted by how rarely they were made.
  struct CheckSums {
    double lux = 0.0, view = 0.0, lux_squared = 0.0;
  };
  /// One slice on its way.
  struct Work;

  Slice make_slice(double azimuth_rad, int checks, double weight);
  void claim(Work& work);
  void check(const Work& work, int checks, double weight);
  void summarise();
  double step_variance() const;

  const RayVisibility& rays_;
  const SkyTable* table_;
  Vec3 normal_;
  SampleRandom random_;
  SliceTracer tracer_;
  double start_ = 0.0;
  std::vector<Slice> slice_;  ///< in the order of their azimuths
  std::vector<Piece> piece_;  ///< of the last slice
  CheckSums checks_;
  double lux_ = 0.0, sky_view_ = 0.0, variance_ = 0.0;
};

}  // namespace tenku
