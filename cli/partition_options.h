/// The options that divide the sky by hand.
#pragma once

#include <optional>
#include <string>

#include "sky_models/sky_partition.h"

namespace tenku {

class OptionList;

/// `--partition`, `--elements`, `--energy-threshold`.
struct PartitionOptions {
  std::optional<std::string> partition;
  std::optional<long> elements;
  std::optional<double> energy_threshold_lux;

  bool is_given() const { return partition || elements || energy_threshold_lux; }
};

/// @param otherwise  what is done where none of them is given
void add_partition_options(OptionList& app, PartitionOptions& options,
                           const std::string& otherwise);

/// @throws InputError
PartitionRequest resolve_partition(const PartitionOptions& options);

}  // namespace tenku
