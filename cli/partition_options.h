/// The options that divide the sky by hand.
#pragma once

#include <optional>
#include <string>

#include "sky_models/sky_partition.h"

namespace CLI {
class App;
}

namespace tenku {

/// `--partition`, `--elements`, `--energy-threshold`.
struct PartitionOptions {
  std::string partition = "adaptive";
  std::optional<long> elements;
  std::optional<double> energy_threshold_lux;

  bool is_default() const { return partition == "adaptive" && !elements && !energy_threshold_lux; }
};

void add_partition_options(CLI::App& app, PartitionOptions& options);

/// @throws InputError
PartitionRequest resolve_partition(const PartitionOptions& options);

}  // namespace tenku
