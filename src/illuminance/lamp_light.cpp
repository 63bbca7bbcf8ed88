#include "illuminance/lamp_light.h"

#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>

#include "core/low_discrepancy.h"
#include "core/parallel.h"
#include "core/random.h"
#include "illuminance/lamp_sampler.h"
#include "illuminance/reflected_light.h"

namespace tenku {
namespace {

constexpr std::size_t kScrambles = 8, kGrain = 64;
constexpr std::uint32_t kFirst = 4, kMost = 64;  // rays of each scramble
constexpr double kWiden7 = 1.456;  // Student's t of seven degrees of freedom over 1.96, squared
constexpr std::uint64_t kStream = 0x7374726169676874ULL;

/// The lamps as one sensor sees them.
class LampView {
 public:
  LampView(const LampSampler& lamps, const RayVisibility& rays, Vec3 position, Vec3 normal,
           std::uint64_t key)
      : rays_(rays),
        origin_(position + rays.lift_m() * normal),
        normal_(normal),
        view_(lamps, origin_, normal),
        key_(key) {}

  void look_to(std::uint32_t goal) {
    for (; looks_ < goal; ++looks_) {
      for (std::size_t b = 0; b < kScrambles; ++b) {
        const std::uint64_t scramble = mix_bits(key_ + b);
        const Rgb light = look(sobol_owen(looks_, 0, scramble), sobol_owen(looks_, 1, scramble));
        sum_ = sum_ + light;
        of_scramble_.at(b) += luminance_of(light);
      }
    }
  }

  Rgb lux() const { return (1.0 / (kScrambles * static_cast<double>(looks_))) * sum_; }
  double variance() const {
    const double mean = luminance_of(lux());
    double squares = 0.0;
    for (const double sum : of_scramble_) squares += std::pow(sum / looks_ - mean, 2);
    return kWiden7 * squares / (kScrambles * (kScrambles - 1.0));
  }
  std::uint64_t rays_sent() const { return rays_sent_; }

 private:
  Rgb look(double u, double v) {
    return view_.is_worth_looking() ? at_lamp(u, v) : along(cosine_direction(normal_, u, v));
  }

  Rgb at_lamp(double u, double v) {
    const auto [triangle, position] = view_.choose(u, v);
    const Vec3 way = position - origin_;
    const double away = length(way), height = dot(way, normal_);
    if (!(height > 0.0)) return {};
    const Vec3 direction = (1.0 / away) * way;
    const auto hit = first_hit(direction);
    if (!hit || hit->triangle != triangle) return {};
    const double share = height / (kPi * away * view_.density(triangle, way));
    return share * rays_.glass_transmission(origin_, direction, away) * emission(triangle);
  }

  Rgb along(Vec3 direction) {
    const auto hit = first_hit(direction);
    if (!hit) return {};
    return rays_.glass_transmission(origin_, direction, hit->distance_m) * emission(hit->triangle);
  }

  std::optional<RayHit> first_hit(Vec3 direction) {
    ++rays_sent_;
    return rays_.first_hit(origin_, direction);
  }
  Rgb emission(std::uint32_t triangle) const {
    return rays_.materials()[rays_.soup().material[triangle]].emission_lm_m2;
  }

  const RayVisibility& rays_;
  Vec3 origin_, normal_;
  LampSampler::View view_;
  std::uint64_t key_;
  std::uint32_t looks_ = 0;
  Rgb sum_{};
  std::array<double, kScrambles> of_scramble_{};
  std::uint64_t rays_sent_ = 0;
};

}  // namespace

std::uint64_t add_lamp_light(const Sensors& sensors, const RayVisibility& rays,
                             const ErrorBudget& budget, std::uint64_t seed, Progress& progress,
                             SensorIlluminance& values) {
  const LampSampler lamps(rays);
  if (!lamps.is_any()) return 0;
  std::atomic<std::uint64_t> rays_sent{0};
  progress.begin("light of lamps", sensors.size());
  parallel_for(sensors.size(), kGrain, [&](IndexRange range) {
    progress.stop_if_cancelled();
    for (std::size_t i = range.begin; i < range.end; ++i) {
      LampView view(lamps, rays, sensors.position[i], sensors.normal[i],
                    mix_bits(mix_bits(seed ^ kStream) + i));
      for (std::uint32_t looks = kFirst; looks <= kMost; looks *= 2) {
        view.look_to(looks);
        const double all = values.total_lux(i) + luminance_of(view.lux());
        if (view.variance() <= budget.allowed_variance(all)) break;
      }
      values.set_reflected(i, values.reflected_rgb[i] + view.lux());
      values.error_lux[i] = std::hypot(values.error_lux[i], interval_lux(view.variance(), 0.0));
      rays_sent += view.rays_sent();
    }
    progress.advance(range.end - range.begin);
  });
  progress.end(std::to_string(rays_sent) + " rays");
  return rays_sent;
}

}  // namespace tenku
