/// Skylight and sunlight on many sensors from directions that all of them share.
#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "illuminance/sensor.h"
#include "illuminance/sky_table.h"
#include "sky_models/sky_partition.h"
#include "visibility/visibility.h"

namespace tenku {

/// The sky as a finite number of far lamps: each element shines from the same one or few directions
/// on every sensor, so that an engine that prepares a direction does so once for all.
///
/// An element that lies before the plane of a sensor gives dot(n, illuminance vector), exact
/// whatever its size, times the fraction of its directions that is visible, each by its cosine. Of
/// one that the plane cuts, the part before the plane counts. If none of its
/// directions lies before the plane, it is taken to be as visible as the others together are.
///
/// Source   S. Takada, Y. Dobashi and T. Yamamoto, "A fast method for rendering townscape images
///          with skylight" (in Japanese), section 3.1: an element as one point of light.
/// Error    in the open that of the table, 1e-4.
///          What hides a part of an element counts as hiding its directions or not: 1 /
///          (directions) of the element, the same way for neighbouring sensors.
/// Threads  immutable after construction; may be shared. Same bits for any number of threads: sums
///          run over the elements in their order, in double.
class SharedElements {
 public:
  /// @param table       of the sky that was divided, kept by reference: for elements that a plane
  ///                    cuts; null: their mean luminance serves
  /// @param directions  in each element, evenly spread; 1 is that of its light.
  ///                    1 to 1024
  /// @throws InputError if `directions` is out of range
  explicit SharedElements(const SkyPartition& partition, const SkyTable* table = nullptr,
                          int directions = 1);

  /// What the sensors receive. Shape  all [sensor].
  struct Light {
    std::vector<double> lux;
    std::vector<double> sky_view;  ///< cosine-weighted visible fraction of the whole dome
    /// Root of the sum of squares of the light of elements that are visible where the element
    /// before them is hidden, or the reverse, in lux: elements that follow each other touch, so an
    /// outline runs there, and what is wrong with the sum lies along outlines.
    std::vector<double> outline_lux;
    std::vector<double>
        element_lux;  ///< root mean square of the light of an element, visible or not
  };

  /// Which elements are asked for, for whom. The others count as visible.
  struct Wanted {
    std::vector<std::uint32_t> group;         ///< [sensor]
    std::vector<std::vector<bool>> elements;  ///< [group][element]
  };

  /// @param sensors  lifted off their surfaces
  /// @param wanted   null: all for all
  /// @throws Cancelled      if the user asks to stop
  /// @throws ResourceError  as the engine
  Light light(const Visibility& visibility, const Sensors& sensors, Progress& progress,
              const Wanted* wanted = nullptr) const;

  std::size_t count() const { return elements_.size(); }
  /// How many directions the engine is asked for.
  std::size_t size() const { return elements_.size() * static_cast<std::size_t>(directions_); }

  /// What an unobstructed plane receives, lux, from each element and from all.
  std::vector<double> unobstructed_parts(Vec3 normal) const;
  double unobstructed_lux(Vec3 normal) const;

 private:
  struct Element {
    SkyCell cell;
    double mean_luminance;
    Vec3 luminous, uniform;  ///< integrals of direction times luminance, and of direction
    std::vector<Vec3> directions;
  };
  struct Share;
  struct Sums;
  struct Asked;
  Share share_of(const Element& element, Vec3 normal) const;
  static double visible_share(const Element& element, Vec3 normal, const Share& whole,
                              const Asked& asked, std::size_t sensor);
  void add(const Element& element, const Asked& asked, const std::vector<std::uint32_t>& group,
           const std::vector<Vec3>& normals, std::vector<Sums>& sums) const;

  std::vector<Element> elements_;
  const SkyTable* table_;
  int directions_;
};

/// Sunlight from directions spread evenly over the solar disc, shared by all sensors.
/// @param sensors     lifted off their surfaces
/// @param directions  at least 1; in a penumbra the visible fraction is uncertain by about
///                    0.4 / directions^0.75
/// @return            lux [sensor]
std::vector<double> shared_sun_lux(const Visibility& visibility, const Sensors& sensors,
                                   const SolarDisc& sun, int directions);

}  // namespace tenku
