#include "illuminance/shared_elements.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <tuple>

#include "core/error.h"
#include "core/parallel.h"
#include "illuminance/cell_side.h"
#include "illuminance/sensor_sun.h"

namespace tenku {
namespace {

constexpr std::size_t kGrain = 4096;            // sensors in a task
constexpr std::size_t kLooksAtOnce = 8;         // directions whose visibility is held in memory
constexpr int kCutParts = 24;                   // a side of an element that a sensor's plane cuts
constexpr double kGolden = 0.6180339887498949;  // (sqrt(5) - 1) / 2

/// Points k of n in the unit square, evenly spread: a lattice of the golden section.
struct Spread {
  double u, v;
  Spread(int k, int n) : u((k + 0.5) / n), v(std::fmod(0.5 + k * kGolden, 1.0)) {}
};

/// Integral of the direction over the part of a cell in front of a plane.
Vec3 front_vector(const SkyCell& cell, Vec3 normal) {
  Vec3 sum;
  for (int i = 0; i < kCutParts; ++i) {
    for (int j = 0; j < kCutParts; ++j) {
      const Vec3 direction = cell.direction((i + 0.5) / kCutParts, (j + 0.5) / kCutParts);
      if (dot(normal, direction) > 0.0) sum = sum + direction;
    }
  }
  return cell.solid_angle() / (kCutParts * kCutParts) * sum;
}

/// Different normals among the sensors, and which of them each sensor has.
struct Normals {
  std::vector<Vec3> different;
  std::vector<std::uint32_t> of_sensor;

  explicit Normals(const std::vector<Vec3>& normal) : of_sensor(normal.size()) {
    std::vector<std::uint32_t> order(normal.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t k) {
      return std::tuple(normal[k].x, normal[k].y, normal[k].z);
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (const std::uint32_t k : order) {
      if (different.empty() || different.back() != normal[k]) different.push_back(normal[k]);
      of_sensor[k] = static_cast<std::uint32_t>(different.size() - 1);
    }
  }
};

}  // namespace

/// What an unobstructed sensor with one of the normals receives from an element.
struct SharedElements::Share {
  double lux = 0.0, view = 0.0;
  double cosines = 0.0;  ///< sum over the element's directions before the plane
};

/// Of one sensor.
struct SharedElements::Sums {
  double lux = 0.0, view = 0.0;              ///< seen
  double asked_lux = 0.0, asked_view = 0.0;  ///< of the elements that were asked for
  double rest_lux = 0.0, rest_view = 0.0;    ///< of those with no direction before the plane
};

SharedElements::SharedElements(const SkyPartition& partition, int directions)
    : directions_(directions) {
  constexpr int kMost = 1024;
  if (!(directions >= 1 && directions <= kMost)) {
    throw InputError("an element has 1 to 1024 directions, not " + std::to_string(directions));
  }
  for (const SkyElement& e : partition.elements) {
    Element element{e.cell, e.luminance.value(), e.illuminance_vector, uniform_vector(e.cell), {}};
    for (int k = 0; k < directions; ++k) {
      const Spread at(k, directions);
      element.directions.push_back(directions == 1 ? e.direction : e.cell.direction(at.u, at.v));
    }
    elements_.push_back(std::move(element));
  }
}

std::vector<SharedElements::Share> SharedElements::shares(const Element& element,
                                                          const std::vector<Vec3>& normals) const {
  std::vector<Share> made(normals.size());
  parallel_for(normals.size(), kGrain, [&](IndexRange range) {
    for (std::size_t g = range.begin; g < range.end; ++g) {
      const Vec3 n = normals[g];
      const Side side = side_of(element.cell, n);
      if (side == Side::Behind) continue;
      Share& share = made[g];
      for (const Vec3& d : element.directions) share.cosines += std::max(0.0, dot(n, d));
      if (side == Side::Front) {
        share.lux = std::max(0.0, dot(n, element.luminous));
        share.view = std::max(0.0, dot(n, element.uniform)) / kPi;
      } else {
        const double front = dot(n, front_vector(element.cell, n));
        share.lux = element.mean_luminance * front;
        share.view = front / kPi;
      }
    }
  });
  return made;
}

void SharedElements::add(const Element& element, const std::vector<float>* seen,
                         const std::vector<std::uint32_t>& group, const std::vector<Vec3>& normals,
                         std::vector<Sums>& sums) const {
  const std::vector<Share> share = shares(element, normals);
  parallel_for(sums.size(), kGrain, [&](IndexRange range) {
    for (std::size_t s = range.begin; s < range.end; ++s) {
      const Share& whole = share[group[s]];
      if (!(whole.view > 0.0)) continue;
      Sums& sum = sums[s];
      if (!(whole.cosines > 0.0)) {
        sum.rest_lux += whole.lux, sum.rest_view += whole.view;
        continue;
      }
      double visible = 0.0;
      for (std::size_t k = 0; k < element.directions.size(); ++k) {
        visible += std::max(0.0, dot(normals[group[s]], element.directions[k])) * seen[k][s];
      }
      visible /= whole.cosines;
      sum.lux += whole.lux * visible, sum.asked_lux += whole.lux;
      sum.view += whole.view * visible, sum.asked_view += whole.view;
    }
  });
}

SharedElements::Light SharedElements::light(const Visibility& visibility, const Sensors& sensors,
                                            Progress& progress) const {
  const Normals normals(sensors.normal);
  std::vector<Sums> sums(sensors.size());
  const auto per_element = static_cast<std::size_t>(directions_);
  const std::size_t at_once = std::max<std::size_t>(1, kLooksAtOnce / per_element);
  std::vector<std::vector<float>> seen(at_once * per_element, std::vector<float>(sensors.size()));
  progress.begin("sky elements", size());
  for (std::size_t first = 0; first < elements_.size(); first += at_once) {
    progress.stop_if_cancelled();
    const std::size_t count = std::min(at_once, elements_.size() - first);
    parallel_for(count * per_element, 1, [&](IndexRange range) {
      for (std::size_t k = range.begin; k < range.end; ++k) {
        const Element& element = elements_[first + k / per_element];
        visibility.transmission_from(element.directions[k % per_element], sensors.position,
                                     sensors.normal, seen[k]);
      }
    });
    for (std::size_t e = 0; e < count; ++e) {
      add(elements_[first + e], &seen[e * per_element], normals.of_sensor, normals.different, sums);
    }
    progress.advance(count * per_element);
  }
  Light light{std::vector<double>(sums.size()), std::vector<double>(sums.size())};
  for (std::size_t s = 0; s < sums.size(); ++s) {
    const Sums& sum = sums[s];
    const auto with_rest = [](double got, double asked, double rest) {
      return asked > 0.0 ? got + rest * got / asked : 0.0;
    };
    light.lux[s] = with_rest(sum.lux, sum.asked_lux, sum.rest_lux);
    light.sky_view[s] = with_rest(sum.view, sum.asked_view, sum.rest_view);
  }
  progress.end(std::to_string(size()) + " directions");
  return light;
}

std::vector<double> shared_sun_lux(const Visibility& visibility, const Sensors& sensors,
                                   const SolarDisc& sun, int directions) {
  expects(directions >= 1, "the sun shines from one direction at least");
  const TangentFrame frame = tangent_frame(sun.direction);
  std::vector<double> lux(sensors.size());
  std::vector<float> seen(sensors.size());
  for (int k = 0; k < directions; ++k) {
    const Spread at(k, directions);
    const Vec3 toward = direction_on_disc(sun, frame, at.u, at.v);
    if (toward.z <= 0.0) continue;
    visibility.transmission_from(toward, sensors.position, sensors.normal, seen);
    for (std::size_t s = 0; s < lux.size(); ++s) {
      const double facing = std::max(0.0, dot(sensors.normal[s], toward));
      lux[s] += sun.normal_illuminance.value() / directions * facing * seen[s];
    }
  }
  return lux;
}

}  // namespace tenku
