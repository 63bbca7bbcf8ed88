/// The sky in a finite number of elements.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sky_models/sky_element.h"
#include "sky_models/sky_model.h"

namespace tenku {

enum class PartitionMethod { Adaptive, Energy, Uniform, Tregenza, Reinhart };

/// What is asked for: a method, and at most one of the three ways to stop. Without one, `Adaptive`
/// stops at a tolerance of 0.5 % and the others at 512 elements. Tregenza and Reinhart know their
/// count.
struct PartitionRequest {
  PartitionMethod method = PartitionMethod::Adaptive;
  int reinhart = 1;                            ///< subdivision of Reinhart's MF, 1 to 6
  std::optional<std::size_t> elements;         ///< count, 1 to 1,000,000
  std::optional<double> energy_threshold_lux;  ///< luminance times solid angle; `Energy`
  std::optional<double> tolerance;             ///< `SkyPartition::standard_error`, as a fraction
};

/// `adaptive`, `energy`, `uniform`, `tregenza`, `reinhart:1` .. `reinhart:6`.
/// @throws InputError for any other text
PartitionRequest parse_partition(std::string_view text);

/// @throws InputError if the request contradicts itself or is out of range
void check_partition(const PartitionRequest& request);

/// A partition of the vault above the horizon.
struct SkyPartition {
  std::vector<SkyElement> elements;
  std::string description;

  /// Standard error of the illuminance that one random direction an element gives to the
  /// worst-oriented unobstructed plane, as a fraction of the horizontal illuminance.
  double standard_error = 0.0;

  /// Sum over the elements of `illuminance_vector`'s vertical part: horizontal illuminance, lx.
  [[nodiscard]] double horizontal_lux() const;
};

/// Divides the sky.
///
/// `Adaptive`, `Energy` and `Uniform` halve the cells of one tree of equal-area halves, again and
/// again the first in their order: the largest standard error of one sample for the worst-oriented
/// plane; the most luminance times solid angle (S. Takada, Y. Dobashi and T. Yamamoto, "A fast
/// method for rendering townscape images with skylight", in Japanese); the largest solid angle.
/// `Tregenza`: P. R. Tregenza, "Subdivision of the sky hemisphere for luminance measurements",
/// Lighting Res. Technol. 19, 1987, 145 patches, the first of each band centred on north.
/// `Reinhart`: its patches divided M x M, as in Radiance. Error    solid angles add up to 2 pi
/// within 1e-12; horizontal illuminance exact within 1e-6. Threads  deterministic.
/// @throws InputError as `check_partition`
SkyPartition partition_sky(const SkyModel& sky, const PartitionRequest& request = {});

}  // namespace tenku
