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
/// Each slice is exact in altitude (SliceTracer); what is left is a sum over azimuth of a function
/// that is smooth but for steps, where one outline gives way to another, and kinks, where an
/// outline has a corner. Two ways, one after the other:
///          even: slices at equal steps from a random start, doubled until most gaps between
///            slices hold no step. Unbiased, whatever is too thin to be resolved;
///          halving: once steps are few and apart, the gaps that hold them are halved, and some
///            of the others, to see whether they hide anything. Smooth gaps are summed up with
///            the slopes at their ends.
///
/// Error    parts that are independent and added as variances. With w the width of a gap:
///          steps, even: the place of a step in its gap is unknown. With second differences
///            r = f(i) - (f(i-1) + f(i+1)) / 2 beside steps, variance w^2 sum(r^2) (1/6 + s/3w),
///            s the scatter (a step of height h gives sum(r^2) = h^2/2 and an error that is
///            uniform in [-wh/2, wh/2], to which each slice within s of the step adds its chance
///            to lie on either side);
///          steps, halving: L and R go on from either side with the slopes there; where one gives
///            way to the other is uniform in the gap: mean of the integral w (L(0) + R(w)) / 2 -
///            c w^2 / 6, variance w^2 h^2 / 12 + c^2 w^4 / 720, with h = R - L in the middle and c
///            the change of slope; (c w^2 / 12)^2 instead of the latter, as a kink may hide there;
///          kinks, halving: continuous, so -c w^2 / 12 on average and variance c^2 w^4 / 720;
///          smooth, halving: a slice differs by r from the polynomial through its neighbours (two
///            on either side where no step or kink separates them). A kink that the slices
///            have not told would give sum(r^2) = (wc)^2 / 6 and, as above, c^2 w^4 / 720: variance
///            w^2 r^2 / 120 each. What is smooth has an r that falls as w^4;
///          coherence: the first slices are odd in number, so that what recurs after 90 or 180
///            degrees (courts; the horizon of a wall's own plane) lies in different parts of the
///            gaps, and its errors cancel where they would add up;
///          scatter: each azimuth is moved at random by up to +-kScatter/2, which gives smooth
///            parts an error of known size;
///          surprises: what the last halving found where nothing was expected;
///          checks: rays at random altitudes measure what the slices missed.
class SensorSky {
 public:
  static constexpr int kFirstSlices = 17;
  /// How the first slices are made.
  struct Effort {
    int first_slices = kFirstSlices;
    bool checked = true;  ///< without checks the result may be biased
    bool halving = true;  ///< without it the result is unbiased whatever is too thin to resolve
  };

  /// @param table   null for no sky: only the sky view factor is found
  /// @param normal  unit vector
  SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
            SampleRandom random, Effort effort);
  SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
            SampleRandom random);

  /// Adds slices: as many as there are, or those that halving needs (the first call makes the
  /// first).
  void refine();

  double lux() const { return lux_ > 0.0 ? lux_ : 0.0; }
  /// The same before it is kept from falling below zero: unbiased.
  double signed_lux() const { return lux_; }
  double sky_view() const { return sky_view_; }
  double variance() const { return variance_; }  ///< of `lux`, lux^2
  /// Whether there are so few slices, or so few that have seen the sky, that there may be things,
  /// or openings, between them of which the variance knows nothing.
  bool may_miss_openings() const {
    return slices() < kFewest || (seeing_ < kSeeing && slices() < kEnoughToBeDark);
  }
  int slices() const { return static_cast<int>(slice_.size()); }
  std::uint64_t rays_sent() const { return tracer_.rays_sent(); }

  static constexpr int kSeeing = 4;   ///< slices that must see the sky to trust steps
  static constexpr int kFewest = 34;  ///< slices, however smooth all looks
  static constexpr int kFewestToHalve = 68;
  static constexpr int kEnoughToBeDark = 256;  ///< slices, none of which sees the sky
  static constexpr double kScatter = 0.002;    // radians

 private:
  /// What one slice gives, per radian of azimuth.
  struct Slice {
    double azimuth = 0.0;
    double lux = 0.0, view = 0.0;
    OutlineEdge low_edge, high_edge;
    int ranges = 0;
    bool is_behind = false;  ///< wholly behind the sensor
  };
  /// What lies between two neighbouring slices.
  enum class Gap { Smooth, Kink, Step };
  /// A visible range of altitudes, with the transmittance of the panes before it.
  struct Piece {
    AltitudeRange range;
    double transmittance;
  };
  /// Sums over the slices of what their checks found, weighted by how rarely they were made and
  /// by the azimuth each stands for.
  struct CheckSums {
    double lux = 0.0, view = 0.0, lux_squared = 0.0;
  };
  /// One slice on its way.
  struct Work;
  struct Sum {
    double lux = 0.0, view = 0.0, variance = 0.0;
  };

  /// Slopes at a slice, of what lies on its smooth sides.
  struct Slopes {
    double lux = 0.0, view = 0.0;
    bool known = false;
  };
  /// Integral over a gap, and its variance.
  struct GapSum {
    double lux, view, variance;
  };

  bool touch(OutlineEdge a, OutlineEdge b) const;
  Gap gap_between(const Slice& a, const Slice& b) const;
  const Slice& at(std::size_t i) const { return slice_[i % slice_.size()]; }
  double width_after(std::size_t i) const;
  Slopes slopes_at(std::size_t i) const;
  bool is_smooth_after(std::size_t i) const { return gap_between(at(i), at(i + 1)) == Gap::Smooth; }
  /// Difference of a slice from the polynomial through its neighbours; 0 where it has none.
  double misfit_at(std::size_t i) const;
  /// Variance that the misfit of a slice tells of.
  double misfit_variance(std::size_t i) const;
  GapSum gap_sum(std::size_t i, const Slopes& before, const Slopes& after) const;

  void double_evenly();
  void halve_gaps();
  bool is_resolved();
  bool has_sure_claims() const;
  Slice make_slice(double azimuth_rad, int checks, double weight);
  void claim(Work& work);
  void check(const Work& work, int checks, double weight);
  Sum even_sum() const;
  Sum halved_sum() const;
  void summarise();

  const RayVisibility& rays_;
  const SkyTable* table_;
  Vec3 normal_;
  SampleRandom random_;
  Effort effort_;
  SliceTracer tracer_;
  double start_ = 0.0;
  std::vector<Slice> slice_;  ///< in the order of their azimuths
  std::vector<Piece> piece_;  ///< of the last slice
  CheckSums checks_;
  bool resolved_ = false;
  int seeing_ = 0;
  double surprise_variance_ = 0.0;
  std::uint32_t halvings_ = 0;
  double lux_ = 0.0, sky_view_ = 0.0, variance_ = 0.0;
};

}  // namespace tenku
