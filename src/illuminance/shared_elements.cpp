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
#include "illuminance/slice_light.h"

namespace tenku {
namespace {

constexpr std::size_t kGrain = 4096;            // sensors in a task
constexpr std::size_t kLooksAtOnce = 8;         // directions whose visibility is held in memory
constexpr int kCutSlices = 12;                  // of an element that a sensor's plane cuts
constexpr double kGolden = 0.6180339887498949;  // (sqrt(5) - 1) / 2

constexpr double square(double x) { return x * x; }

/// Points k of n in the unit square, evenly spread: a lattice of the golden section.
struct Spread {
  double u, v;
  Spread(int k, int n) : u((k + 0.5) / n), v(std::fmod(0.5 + k * kGolden, 1.0)) {}
};

/// What a plane receives from the part of a cell in front of it, slice by slice of azimuth.
/// @param table  null: only the view
LuxAndView front_part(const SkyCell& cell, Vec3 normal, const SkyTable* table) {
  const double bottom = std::asin(cell.sine_from), top = std::asin(cell.sine_to);
  const double width = (cell.azimuth_to - cell.azimuth_from) / kCutSlices;
  LuxAndView sum;
  for (int k = 0; k < kCutSlices; ++k) {
    const double azimuth = cell.azimuth_from + (k + 0.5) * width;
    const double along = normal.x * std::sin(azimuth) + normal.y * std::cos(azimuth);
    const FrontRange front = front_range(along, normal.z);
    const double low = std::max(front.low, bottom), high = std::min(front.high, top);
    if (!(low < high)) continue;
    const double turn = 0.5 * (std::sin(2.0 * high) - std::sin(2.0 * low));
    const double rise = square(std::sin(high)) - square(std::sin(low));
    sum.view += width / kPi * 0.5 * (along * (high - low + turn) + normal.z * rise);
    if (table == nullptr) continue;
    const SkyTable::Column column = table->column(azimuth);
    const SliceMoments moments = column.to(high) - column.to(low);
    sum.lux += width * (along * moments.along + normal.z * moments.up);
  }
  return sum;
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
  double lux = 0.0, view = 0.0;               ///< seen
  double asked_lux = 0.0, asked_view = 0.0;   ///< of the elements that were asked for
  double rest_lux = 0.0, rest_view = 0.0;     ///< of those with no direction before the plane
  double open_lux = 0.0, open_view = 0.0;     ///< of those that were not wanted
  double last_lux = 0.0, last_visible = 0.0;  ///< of the element before
  double outline_squared = 0.0, squared = 0.0;
  std::uint32_t elements = 0;

  void add(const Share& whole, double visible) {
    if (!(whole.view > 0.0)) {
      last_lux = 0.0;
    } else if (!(whole.cosines > 0.0)) {
      rest_lux += whole.lux, rest_view += whole.view;
    } else {
      const double step = 0.5 * (whole.lux + last_lux) * (visible - last_visible);
      if (last_lux > 0.0) outline_squared += step * step;
      last_lux = whole.lux, last_visible = visible;
      squared += whole.lux * whole.lux;
      ++elements;
      lux += whole.lux * visible, asked_lux += whole.lux;
      view += whole.view * visible, asked_view += whole.view;
    }
  }
};

SharedElements::SharedElements(const SkyPartition& partition, const SkyTable* table, int directions)
    : table_(table), directions_(directions) {
  constexpr int kMost = 1024;
  if (!(directions >= 1 && directions <= kMost)) {
    throw InputError("an element has 1 to 1024 directions, not " + std::to_string(directions));
  }
  for (const SkyElement& e : partition.elements) {
    Element element{e.cell, e.luminance.value(), e.illuminance_vector, uniform_vector(e.cell), {}};
    for (int k = 0; k < directions; ++k) {
      const Spread at(k, directions);
      element.directions.push_back(directions == 1 ? normalized(e.illuminance_vector)
                                                   : e.cell.direction(at.u, at.v));
    }
    elements_.push_back(std::move(element));
  }
}

SharedElements::Share SharedElements::share_of(const Element& element, Vec3 n) const {
  Share share;
  const Side side = side_of(element.cell, n);
  if (side == Side::Behind) return share;
  for (const Vec3& d : element.directions) share.cosines += std::max(0.0, dot(n, d));
  if (side == Side::Front) {
    share.lux = std::max(0.0, dot(n, element.luminous));
    share.view = std::max(0.0, dot(n, element.uniform)) / kPi;
  } else {
    const LuxAndView front = front_part(element.cell, n, table_);
    share.view = std::max(0.0, front.view);
    share.lux =
        table_ != nullptr ? std::max(0.0, front.lux) : element.mean_luminance * kPi * share.view;
  }
  return share;
}

std::vector<double> SharedElements::unobstructed_parts(Vec3 normal) const {
  std::vector<double> lux;
  lux.reserve(elements_.size());
  for (const Element& element : elements_) lux.push_back(share_of(element, normal).lux);
  return lux;
}

double SharedElements::unobstructed_lux(Vec3 normal) const {
  const std::vector<double> parts = unobstructed_parts(normal);
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

/// What is asked of the engine for one element.
struct SharedElements::Asked {
  std::vector<std::uint32_t> sensor;     ///< those that want it; unused if all do
  std::vector<std::uint8_t> is_wanted;   ///< [sensor]; empty: all
  std::vector<std::vector<float>> seen;  ///< [direction][sensor]

  Asked(std::size_t directions, std::size_t sensors)
      : seen(directions, std::vector<float>(sensors)) {}

  void choose(const Wanted* wanted, std::size_t element) {
    if (wanted == nullptr) return;
    is_wanted.resize(wanted->group.size());
    sensor.clear();
    for (std::size_t s = 0; s < is_wanted.size(); ++s) {
      is_wanted[s] = wanted->elements[wanted->group[s]][element] ? 1 : 0;
      if (is_wanted[s] != 0) sensor.push_back(static_cast<std::uint32_t>(s));
    }
  }

  void ask(const Visibility& visibility, const Sensors& sensors, Vec3 direction, std::size_t k) {
    if (is_wanted.empty()) {
      visibility.transmission_from(direction, sensors.position, sensors.normal, seen[k]);
      return;
    }
    Sensors some;
    for (const std::uint32_t s : sensor) {
      some.position.push_back(sensors.position[s]);
      some.normal.push_back(sensors.normal[s]);
    }
    std::vector<float> found(some.size());
    visibility.transmission_from(direction, some.position, some.normal, found);
    for (std::size_t i = 0; i < found.size(); ++i) seen[k][sensor[i]] = found[i];
  }
};

void SharedElements::add(const Element& element, const Asked& asked,
                         const std::vector<std::uint32_t>& group, const std::vector<Vec3>& normals,
                         std::vector<Sums>& sums) const {
  std::vector<Share> share(normals.size());
  parallel_for(normals.size(), kGrain, [&](IndexRange range) {
    for (std::size_t g = range.begin; g < range.end; ++g) share[g] = share_of(element, normals[g]);
  });
  parallel_for(sums.size(), kGrain, [&](IndexRange range) {
    for (std::size_t s = range.begin; s < range.end; ++s) {
      const Share& whole = share[group[s]];
      Sums& sum = sums[s];
      if (!asked.is_wanted.empty() && asked.is_wanted[s] == 0) {
        sum.open_lux += whole.lux, sum.open_view += whole.view;
      } else {
        sum.add(whole, visible_share(element, normals[group[s]], whole, asked, s));
      }
    }
  });
}

double SharedElements::visible_share(const Element& element, Vec3 normal, const Share& whole,
                                     const Asked& asked, std::size_t sensor) {
  if (!(whole.cosines > 0.0)) return 0.0;
  double visible = 0.0;
  for (std::size_t k = 0; k < element.directions.size(); ++k) {
    visible += std::max(0.0, dot(normal, element.directions[k])) * asked.seen[k][sensor];
  }
  return visible / whole.cosines;
}

SharedElements::Light SharedElements::light(const Visibility& visibility, const Sensors& sensors,
                                            Progress& progress, const Wanted* wanted) const {
  const Normals normals(sensors.normal);
  std::vector<Sums> sums(sensors.size());
  const auto per_element = static_cast<std::size_t>(directions_);
  const std::size_t at_once = std::max<std::size_t>(1, kLooksAtOnce / per_element);
  std::vector<Asked> asked(at_once, Asked(per_element, sensors.size()));
  progress.begin("sky elements", size());
  for (std::size_t first = 0; first < elements_.size(); first += at_once) {
    progress.stop_if_cancelled();
    const std::size_t count = std::min(at_once, elements_.size() - first);
    for (std::size_t e = 0; e < count; ++e) asked[e].choose(wanted, first + e);
    parallel_for(count * per_element, 1, [&](IndexRange range) {
      for (std::size_t k = range.begin; k < range.end; ++k) {
        const std::size_t e = k / per_element, d = k % per_element;
        asked[e].ask(visibility, sensors, elements_[first + e].directions[d], d);
      }
    });
    for (std::size_t e = 0; e < count; ++e) {
      add(elements_[first + e], asked[e], normals.of_sensor, normals.different, sums);
    }
    progress.advance(count * per_element);
  }
  const std::vector<double> none(sums.size());
  Light light{none, none, none, none};
  for (std::size_t s = 0; s < sums.size(); ++s) {
    const Sums& sum = sums[s];
    const auto with_rest = [](double got, double whole, double rest) {
      return whole > 0.0 ? got + rest * got / whole : 0.0;
    };
    light.lux[s] = sum.open_lux + with_rest(sum.lux, sum.asked_lux, sum.rest_lux);
    light.sky_view[s] = sum.open_view + with_rest(sum.view, sum.asked_view, sum.rest_view);
    light.outline_lux[s] = std::sqrt(sum.outline_squared);
    if (sum.elements > 0) light.element_lux[s] = std::sqrt(sum.squared / sum.elements);
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
