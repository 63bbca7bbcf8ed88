/// Light from sides at sensors, looked at as finely as the tolerance asks.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "illuminance/sensor.h"
#include "radiosity/point_gather.h"

namespace tenku {

/// What sensors receive by both looks, and the doubt of the mesh in it, lux.
///
/// Shape    all [sensor].
struct LooksOfSensors {
  std::vector<PointGather::Looks> lux;
  std::vector<std::array<double, PointGather::kLooks>> mesh_lux;
};

/// Means of both looks, the variance between them, lux^2, and the half-width for the mesh.
///
/// Shape    all [sensor].
struct SettledLooks {
  std::vector<Rgb> lux;
  std::vector<double> variance, mesh_lux;
};

/// Fills in the looks of those that are rough.
using LookAtSides = std::function<void(std::span<const std::uint8_t> rough, LooksOfSensors& looks)>;
/// Lets sensors look more finely by so many steps; sets those that do not to 0.
using LookFiner = std::function<bool(std::span<std::uint8_t> steps)>;

/// Looks from all sensors, and more finely from those that are not within half of the tolerance of
/// all their light, until none can look more finely.
/// @param values  direct light that is known
SettledLooks settle_looks(const Sensors& sensors, const SensorIlluminance& values,
                          double tolerance_pct, const LookAtSides& look, const LookFiner& finer);

/// By how many steps of twice as many samples an interval comes within what is allowed.
std::uint8_t steps_finer(double interval_lux, double allowed_lux);

/// Samples go with the square of the resolution: twice as many a level.
int resolution_at(int first, std::size_t level);

}  // namespace tenku
