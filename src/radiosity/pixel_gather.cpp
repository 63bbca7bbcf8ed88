#include "radiosity/pixel_gather.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "form_factors/point_view.h"
#include "illuminance/reflected_light.h"

namespace tenku {
namespace {

constexpr std::size_t kGrain = 8;
constexpr double kNear = 1.0;      // times the mean edge of an element
constexpr int kMostSteps = 16;     // of a path in a crease
constexpr int kLampRays = 8;       // at most, for one at first, from each place of a path
constexpr std::size_t kEvery = 4;  // of the rays into a crease goes on as a path

}  // namespace

PixelGather::PixelGather(const ElementMesh& mesh, const PointGatherOptions& options)
    : options_(options), mesh_(mesh), outward_(mesh, options.lift_m) {
  for (std::size_t e = 0; e < mesh.size(); ++e) near_m_.push_back(kNear * mesh.mean_edge_m(e));
  const int first = PointGather::first_resolution(options);
  for (std::size_t level = 0; level < PointGather::levels(options); ++level) {
    Looks looks;
    for (std::size_t l = 0; l < looks.size(); ++l) {
      looks[l] = std::make_unique<HemisphereLook>(mesh_, resolution_at(first, level),
                                                  mix_bits(options.form_factors.seed + l));
    }
    looks_.push_back(std::move(looks));
  }
}

Rgb PixelGather::sent_from(std::uint32_t side, Vec3 place, const SentBySides& sent) const {
  return sent.reflected[side] + sent.slopes.beyond_mean(side, place);
}

Rgb PixelGather::sent_by_path(std::uint32_t side, Vec3 place, std::array<double, 2> way,
                              const SentBySides& sent) const {
  Rgb sum{}, weight = Rgb::grey(1.0);
  SampleRandom random(key_of(place, kZenith, options_.form_factors.seed), 0, 0);
  for (int step = 0;; ++step) {
    weight = weight * sent.surfaces.reflectance[side / 2];
    const Vec3 normal = mesh_.mesh.normal(side), from = place + options_.lift_m * normal;
    const EmitterLight::Direct lamps = sent.lamps.at(from, normal, kLampRays);
    sum = sum +
          weight * (sent.lamp_scale * lamps.lux + Rgb::grey(sent.slopes.daylight_lux(side, place)));
    const auto next = mesh_.first_met(from, cosine_direction(normal, way[0], way[1]));
    if (!next) return sum;
    way = {random.uniform(), random.uniform()};
    weight = next->share * weight;
    side = next->side, place = mesh_.place(from, *next);
    if (!lamps.has(sent.lamps.lamp_of(side / 2))) {
      sum = sum + weight * sent.surfaces.emission_lm_m2[side / 2];
    }
    if (step == kMostSteps || !(length(place - from) < near_m_[side / 2])) {
      return sum + weight * sent_from(side, place, sent);
    }
  }
}

// What corners tell is right but for a smooth error: few paths find that. Their first ways are an
// even sequence in the order of the rays, so that those of neighbouring rays complete each other.
// Source  M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018: R2.
Rgb PixelGather::beyond_corners(const std::vector<const MetSide*>& met, const Point& point,
                                const SentBySides& sent) const {
  constexpr double kPlastic = 1.32471795724474602596;
  const Vec3 met_first = mesh_.place(point.position, *met.front());  // differs from look to look
  SampleRandom random(key_of(met_first, point.normal, options_.form_factors.seed), 1, 0);
  const double first = random.uniform(), second = random.uniform();
  Rgb beyond{};
  for (std::size_t k = random.bits() % kEvery; k < met.size(); k += kEvery) {
    const MetSide& one = *met[k];
    const Vec3 place = mesh_.place(point.position, one);
    const auto n = static_cast<double>(k / kEvery);
    const double u = first + n / kPlastic, v = second + n / (kPlastic * kPlastic);
    const Rgb by_path = sent_by_path(one.side, place, {u - std::floor(u), v - std::floor(v)}, sent);
    beyond = beyond + one.share * (by_path + -1.0 * sent_from(one.side, place, sent));
  }
  return static_cast<double>(kEvery) * beyond;
}

PixelGather::Found PixelGather::look(const HemisphereLook& look, const Point& point,
                                     const SentBySides& sent) const {
  const std::vector<MetSide> met = look.from_point(point.position, point.normal);
  const FormFactorRow row = row_of(met);
  Found found{{}, mesh_error_lux(row, sent.doubts)};
  if (sent.surfaces.any_emits) {
    found.lux = emission_left_to_row(sent.surfaces, sent.lamps, point.lamps, row);
  }
  Rgb far{}, near{};
  std::vector<const MetSide*> nearby;
  for (const MetSide& one : met) {
    const Vec3 place = mesh_.place(point.position, one);
    const bool is_near =
        length(place - point.position) < near_m_[one.side / 2] && !sent.slopes.is_level(one.side);
    if (is_near) nearby.push_back(&one);
    Rgb& sum = is_near ? near : far;
    sum = sum + one.share * sent_from(one.side, place, sent);
  }
  const double lux = point.direct_lux + luminance_of(found.lux + far + near);
  if (found.mesh_lux > point.tolerance * lux && luminance_of(near) > 0.0) {
    near = near + beyond_corners(nearby, point, sent);
  }
  found.lux = found.lux + far + near;
  return found;
}

SettledLooks PixelGather::gather(const Sensors& points, const SentBySides& sent,
                                 const SensorIlluminance& values, Goal goal,
                                 Progress& progress) const {
  const std::vector<EmitterLight::Direct> known =
      sent.lamps.at_pixels(points, options_.lift_m, EmitterLight::PixelLook::Names);
  std::vector<std::uint8_t> level(points.size());
  const auto look_from = [&](std::span<const std::uint8_t> rough, LooksOfSensors& looks) {
    const auto looking = static_cast<std::size_t>(std::count(rough.begin(), rough.end(), 1));
    progress.begin("light between surfaces", looking);
    parallel_for(points.size(), kGrain, [&](IndexRange range) {
      progress.stop_if_cancelled();
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const Vec3 normal = points.normal[i];
        if (rough[i] == 0 || outward_.faces_nothing(points.position[i], normal)) continue;
        const Point point{points.position[i] + options_.lift_m * normal, normal, known[i],
                          values.sun_lux[i] + values.sky_lux[i], goal.tolerance_pct / 100.0};
        for (std::size_t l = 0; l < PointGather::kLooks; ++l) {
          const Found found = look(*looks_[level[i]][l], point, sent);
          looks.lux[i][l] = found.lux;
          looks.mesh_lux[i][l] = found.mesh_lux;
        }
        progress.advance(1);
      }
    });
    progress.end(std::to_string(looking) + " places in the picture");
  };
  const auto finer = [&](std::span<std::uint8_t> steps) {
    bool any = false;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::size_t next = std::min<std::size_t>(level[i] + steps[i], looks_.size() - 1);
      steps[i] = next > level[i] ? 1 : 0;
      level[i] = static_cast<std::uint8_t>(next);
      any |= steps[i] != 0;
    }
    return any;
  };
  const double noise_pct = goal.tolerance_pct * std::sqrt(static_cast<double>(goal.mean_of));
  return settle_looks(points, values, noise_pct, look_from, finer);
}

}  // namespace tenku
