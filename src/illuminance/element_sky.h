/// Skylight on one sensor, summed over the elements of a partition of the sky.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/random.h"
#include "sky_models/sky_model.h"
#include "sky_models/sky_partition.h"
#include "visibility/visibility.h"

namespace tenku {

/// The sky in the elements that `--elements`, `--energy-threshold` or `--partition` ask for.
///
/// Every sensor looks in two random directions into each element, spread over the elements
/// together by an Owen-scrambled Sobol sequence of its own. With E the light of the whole element
/// on the sensor, exact from its illuminance vector, V1 and V2 the transmission in the two
/// directions and g1 and g2 the solid angle times luminance times cosine there, the element gives
/// the mean of E V2 + g1 (V1 - V2) and E V1 + g2 (V2 - V1). Each direction is independent of the
/// other's V, and the mean of g is E: no bias, whatever hides a part of the element. Where V1 = V2
/// the element gives exactly E V1: an unobstructed sensor receives the exact sum. Elements that
/// the sensor's own plane cuts have no E in closed form and give the mean of g1 V1 and g2 V2.
///
/// Error    directions in different elements count as independent. An element whose visible share
///          is p has V1 != V2 with the chance 2 p (1 - p). Where g is G over its visible part and
///          H over the hidden one, the variance of the mean above is p (1 - p) times
///          ((1 - p) G + p H)^2 / 2 + p (1 - p) (G - H)^2. So (V1 - V2)^2 times half of that,
///          with p = 1/2, g1 and g2 for G and H, is the estimate: (g1 + g2)^2 / 16 +
///          (g1 - g2)^2 / 8; unbiased where g is even. Elements cut by the plane: unbiased,
///          (g1 V1 - g2 V2)^2 / 4. What is cut off may be less than two directions
///          tell: half an element of the mean E^2 / 4 is added to what they saw.
/// Threads  immutable after construction; may be shared.
class ElementSky {
 public:
  /// @param sky  kept by reference: it must outlive this object
  ElementSky(const SkyModel& sky, const SkyPartition& partition);

  /// What one sensor receives.
  struct Light {
    double lux = 0.0, variance = 0.0;  ///< variance in lux^2
    double sky_view = 0.0;             ///< cosine-weighted visible fraction of the whole dome
    std::uint64_t rays = 0;
  };

  /// @param origin  the sensor's place, lifted off its surface
  /// @param normal  unit
  Light light(const Visibility& visibility, Vec3 origin, Vec3 normal, SampleRandom random) const;

  std::size_t size() const { return elements_.size(); }
  /// How the sky was divided, in words.
  const std::string& description() const { return description_; }

 private:
  struct Element {
    SkyCell cell;
    double solid_angle;
    Vec3 luminous, uniform;  ///< integrals of direction times luminance, and of direction
  };
  struct Look {
    Vec3 direction;
    double seen;
  };
  void add(Light& sum, const Element& element, Vec3 normal, const std::array<Look, 2>& looks) const;

  const SkyModel& sky_;
  std::vector<Element> elements_;
  std::string description_;
};

}  // namespace tenku
