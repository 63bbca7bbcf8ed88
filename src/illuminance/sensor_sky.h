/// Skylight on one sensor, refined slice by slice.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "illuminance/outline_gap.h"
#include "visibility/slice_tracer.h"

namespace tenku {

/// Illuminance of one sensor from the visible sky, with its standard error.
///
/// Each slice is exact in altitude (SliceTracer); what is left is a sum over azimuth. Two ways:
///          even: slices at equal steps from a random start, doubled, each for itself. Unbiased,
///            whatever is too thin to be resolved (leaves, louvres);
///          outlined: between the slices the sky is summed above the edges that they have met
///            (OutlineGap), as soon as that foretells slices much better than the mean of their
///            neighbours does, or leaves open only few places. Then, once the checks have nothing
///            more to tell, slices go where most is unknown: into holes between outlines, beside
///            slices that were not foretold, into wide gaps.
///
/// Error    parts that are independent and added as variances. A test is what a slice found less
///          what its neighbours foretell without it. With w the width of a gap:
///          even: with r the difference from the mean of the neighbours, a step of height h at an
///            unknown place gives sum(r^2) = h^2/2 and an error uniform in [-wh/2, wh/2]; to it
///            each slice within the scatter s of the step adds its chance to lie on either side:
///            variance w^2 r^2 (1/6 + s/3w). Where outlines go on, kinks of slope change c
///            give sum(r^2) = (wc)^2 / 6 and an error of variance w^4 c^2 / 720, that is w^2 r^2 /
///            120. The first slices are odd in number, so that what recurs after 90 or 180 degrees
///            (courts; the horizon of a wall's own plane) lies in different parts of the gaps; each
///            azimuth is moved at random by up to +-s/2, so that smooth parts err by a known size;
///          holes: the sky in them lies a share p up from the line between their ends to the open
///            sky. p and its scatter are learned from the slices that came to lie in holes;
///          blind holes (beside a slice that sees no sky but not why): a step between their ends,
///            anywhere: w^2 h^2 / 12. Where one such error rules, the variance is lowered to
///            that of a normal error with the same 95 % interval;
///          unknown things: one of width a and height h, met by no slice (probability 1 - a/w), is
///            an error of ah; a slice met it and its neighbours did not foretell it (if a < 2w)
///            with probability a/w. For widths spread evenly over 0..2w the errors squared
///            come to w^2 h^2 / 24 and r^2 to 3 h^2 / 4. Taken is 2 w^2 r^2 / 5, as things much
///            thinner than w need; r^2 from all tests, in proportion to the square of the light
///            that a gap has to lose (from deep in a street most of it comes from along the street,
///            where most is unknown too), or a gap's own where greater. kPriorTests imagined tests
///            that failed stand in for those not made, times the root of the chance that the next
///            outline is a new one (measured in towns, where that is 0.1 to 0.6). Where all that
///            bounds the sky is known, and is what the slices have met (`sky_boundary`), there are
///            no unknown things;
///          what they take away: kMissed of the mean test (smooth change: 1/6, thin things: 1;
///            measured in towns: 0.3 to 0.5), with a third of that as error, the less the
///            fewer tests have failed;
///          floating parts that no slice has met, though it is known that they are there
///            (`FloatingParts`): they hide nothing or all that they enclose, evenly;
///          tables and sums: kTable of the value, and `SkyTable::column_error`;
///          checks: rays at altitudes spread evenly measure what the slices missed.
class SensorSky {
 public:
  static constexpr int kFirstSlices = 17;
  /// How the first slices are made.
  struct Effort {
    int first_slices = kFirstSlices;
    bool checked = true;   ///< without checks the result may be biased
    bool outlined = true;  ///< without it the result is unbiased whatever is too thin to resolve
    bool sure_of_parts = true;  ///< floating parts between slices count in the variance
    double least_part_rad = SliceTracer::kLeastPart_rad;  ///< see `SliceTracer`
  };

  /// @param table   null for no sky: only the sky view factor is found
  /// @param normal  unit vector
  SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
            SampleRandom random, Effort effort);
  SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
            SampleRandom random);

  /// Adds slices: as many as there are, or where most is unknown (the first call makes the first).
  /// @param enough  variance (lux^2) that needs no better method than even slices
  void refine(double enough = 0.0);

  double lux() const { return lux_ > 0.0 ? lux_ : 0.0; }
  /// The same before it is kept from falling below zero: unbiased.
  double signed_lux() const { return lux_; }
  double sky_view() const { return sky_view_; }
  double variance() const { return variance_; }  ///< of `lux`, lux^2
  /// Whether there are so few slices, or so few that have seen the sky, that there may be things,
  /// or openings, between them of which the variance knows nothing.
  bool may_miss_openings() const {
    return unchecked_ || slices() < kFewest || (seeing_ < kSeeing && slices() < kEnoughToBeDark);
  }
  int slices() const { return static_cast<int>(entry_.size()); }
  std::uint64_t rays_sent() const { return tracer_.rays_sent() + pane_rays_; }

  static constexpr int kSeeing = 4;            ///< slices that must see the sky to trust steps
  static constexpr int kFewest = 34;           ///< slices, however smooth all looks
  static constexpr int kEnoughToBeDark = 256;  ///< slices, none of which sees the sky
  static constexpr double kScatter = 0.002;    // radians
  static constexpr double kTable = 3e-5;       // standard error of the tables, of the value

 private:
  /// Sums over the slices of what their checks found, weighted by how rarely they were made and
  /// by the azimuth each stands for.
  struct CheckSums {
    double lux = 0.0, view = 0.0, lux_squared = 0.0;
  };
  struct Sum {
    LuxAndView light;
    double variance = 0.0;
  };

  /// What the outlines tell of the gap after a slice.
  struct GapLight {
    LuxAndView known;  ///< outside its hole
    LuxAndView hole;   ///< of the hole, on the line between its ends
    LuxAndView room;   ///< of an open sky in the hole, less that
    double hole_begin = 0.0, hole_width = 0.0;
    double step = 0.0;      ///< between its ends, lux per radian
    bool is_blind = false;  ///< a hole beside a slice without outlines
    bool is_fine = false;   ///< summed as well as if nothing else were unknown
  };
  /// What the neighbours of a slice had foretold.
  struct Test {
    enum class Kind { Known, Hole, Blind } kind = Kind::Blind;
    LuxAndView miss;    ///< what was found less what was foretold, per radian
    double room = 0.0;  ///< `Hole`: from the line to the open sky, lux per radian
  };
  /// A slice and what follows from it and its neighbours.
  struct Entry {
    SkySlice slice;
    GapLight gap;
    Test test;
    bool is_new = true;
  };
  /// What the tests of all slices tell.
  struct Lesson {
    double share = 0.5, share_variance = 0.0;  ///< of holes
    double share_error = 0.0;                  ///< variance of the mean
    LuxAndView miss;                           ///< mean over what was known
    double miss_squared = 0.0;                 ///< the same of its square, lux^2
    double relative_squared = 0.0;             ///< the squares of the misses by those of the light
    double evidence = 0.0;                     ///< misses that make up the mean, 0 to 1
    double bend_squared = 0.0;                 ///< the same for the mean of the neighbours
    int known = 0;
  };

  /// @param i  up to the number of slices, which is the first one again
  const SkySlice& at(std::size_t i) const { return entry_[i < entry_.size() ? i : 0].slice; }
  std::size_t before(std::size_t i) const { return i > 0 ? i - 1 : entry_.size() - 1; }
  double width_after(std::size_t i) const;
  GapLight gap_light(std::size_t i);
  Test test_of(std::size_t i);
  /// @param about_lux  the value, roughly
  void learn(double about_lux);
  static double to_lose(const Entry& entry);
  double open_squared() const;
  double unknown_squared(const Entry& entry) const;
  double gap_variance(std::size_t i) const;

  void double_evenly();
  void fill_gaps();
  bool has_sure_claims() const;
  SkySlice make_slice(double azimuth_rad, int checks, double weight, SliceHints before = {},
                      SliceHints after = {});
  void trace_again();
  void bound(SkySlice& slice, const VisibleSlice& visible, double low, double high) const;
  void check(const SliceLight& light, int checks, double weight);
  Sum even_sum() const;
  double unseen_share();
  void find_unmet_parts();
  bool is_whole();
  bool outlines_tell() const;
  Sum outlined_sum() const;
  void summarise(double enough);

  SensorSight sight_;
  SampleRandom random_;
  Effort effort_;
  SliceTracer tracer_;
  double start_ = 0.0, check_start_ = 0.0;
  int checked_ = 0;
  std::vector<Entry> entry_;        ///< in the order of their azimuths
  std::vector<SeenPiece> piece_;    ///< of the last slice
  std::vector<std::uint64_t> met_;  ///< edges that bound slices, sorted; room for them
  /// All that bounds the sky, in scenes so small that it can be known.
  std::optional<std::vector<BoundaryOutline>> boundary_;
  bool has_boundary_ = false;  ///< it has been looked for
  bool is_whole_ = false;      ///< the slices have met all of it
  std::vector<double> unmet_;  ///< [slice], variance by floating parts in the gap after it, lux^2
  Lesson lesson_;
  CheckSums checks_;
  bool is_outlined_ = false, is_filled_ = false;
  int seeing_ = 0;
  int traced_again_ = 0;
  bool unchecked_ = false;  ///< no check has tried the slices as they are now
  std::uint64_t pane_rays_ = 0;
  double lux_ = 0.0, sky_view_ = 0.0, variance_ = 0.0;
};

}  // namespace tenku
