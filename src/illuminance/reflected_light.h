/// Light that reaches a sensor by way of diffuse surfaces: path tracing.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "illuminance/lamp_sampler.h"
#include "illuminance/sky_cache.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Unit vector into the half space of a normal, with a density in proportion to the cosine.
/// @param u, v  uniform in [0, 1)
Vec3 cosine_direction(Vec3 normal, double u, double v);

/// Illuminance of one sensor by one to `bounces` diffuse reflections, with its standard error.
///
/// A path leaves the sensor in proportion to the cosine (Owen-scrambled Sobol) and goes on in the
/// same way at each surface it meets, where a ray asks for the sun. The skylight there is found in
/// one of two ways:
///          by a slice of the sky at a random azimuth: cheap, good under an open sky;
///          from a cache, good indoors, where few slices would meet a window: a few paths more,
///          drawn apart, measure the skylight at one of their surfaces and take the mean of its
///          difference from the cache. What the cache gets wrong becomes noise, never bias.
/// The sensor and each surface on the way look at one point of the lamps, and paths meet lamps by
/// chance: both count, each the more the likelier it was (E. Veach and L. J. Guibas, "Optimally
/// combining sampling techniques for Monte Carlo rendering", SIGGRAPH 1995: the balance heuristic),
/// so that neither small lamps nor near ones make noise. Lamps behind mirrors are met by chance
/// only; so are all where they fill most of the view.
///
/// Error    looked-up paths: variance of the mean of `kBatches` independent scrambles, widened for
///          its few degrees of freedom; difference: variance of the mean of its paths.
class ReflectedLight {
 public:
  enum class SkyBy { Slice, Cache };
  /// The way that suits a sensor which sees this much of the sky.
  static SkyBy way_for(double sky_view) { return sky_view > 0.15 ? SkyBy::Slice : SkyBy::Cache; }

  /// What all paths in a scene share; borrowed.
  struct Scene {
    const RayVisibility& rays;
    SkyCache& cache;
    const LampSampler& lamps;
    bool lamps_apart = false;  ///< light straight from lamps is left to `add_lamp_light`
  };
  ReflectedLight(Scene scene, int bounces, Vec3 position, Vec3 normal, SampleRandom random);

  /// Chooses the way, before the first paths.
  void set_way(SkyBy way) { way_ = way; }

  /// Doubles the paths of the part where that gains the more for its rays; the first call starts
  /// both.
  void refine();

  double lux() const { return looked_up_.mean + difference_.mean; }
  /// The same in three channels: `lux` is its luminance.
  Rgb rgb() const { return looked_up_rgb_ + difference_rgb_; }
  double variance() const { return looked_up_.variance + difference_.variance; }  ///< lux^2
  /// Estimate of what bounces beyond the last would add.
  double left_out_lux() const;
  int paths() const { return looked_up_paths_ + difference_paths_; }
  std::uint64_t rays_sent() const { return rays_sent_; }

  static constexpr int kBatches = 16, kFirstPaths = 32, kFirstDifferences = 8;

 private:
  struct Estimate {
    double mean = 0.0, variance = 0.0;
  };
  struct PathStart {
    std::uint32_t index;
    std::uint64_t scramble;
  };
  struct Vertex;
  struct Leg;

  template <class AtHit, class AtVertex>
  void trace_path(PathStart start, int last_order, const AtHit& at_hit, const AtVertex& at_vertex);
  double share_by_chance(const Leg& leg, std::uint32_t triangle, double distance_m) const;
  Rgb look_at_lamps(Vec3 origin, Vec3 normal, PathStart start, int order);
  void trace_looked_up(int goal);
  void trace_differences(int goal);
  double sun_lux(Vec3 point, Vec3 normal, double u, double v);
  double true_sky_lux(Vec3 point, Vec3 normal, std::uint64_t address, int slices);
  double sky_lux(const Vertex& vertex, std::uint64_t address);

  const RayVisibility& rays_;
  SkyCache& cache_;
  const LampSampler& lamps_;
  bool lamps_apart_;
  int bounces_;
  Vec3 origin_, normal_;
  std::uint64_t scramble_;
  Estimate looked_up_, difference_;  ///< of luminance
  Rgb looked_up_rgb_{}, difference_rgb_{}, looked_up_sum_{}, difference_rgb_sum_{};
  std::vector<double> batch_sum_, order_sum_;
  double difference_sum_ = 0.0, difference_squares_ = 0.0;
  SkyBy way_ = SkyBy::Cache;
  int looked_up_paths_ = 0, difference_paths_ = 0;
  std::uint64_t rays_sent_ = 0, looked_up_rays_ = 0, difference_rays_ = 0;
  TangentFrame sun_frame_;
};

}  // namespace tenku
