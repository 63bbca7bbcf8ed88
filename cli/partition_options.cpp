#include "cli/partition_options.h"

#include <fmt/format.h>

#include "cli/option_list.h"
#include "core/error.h"

namespace tenku {

void add_partition_options(OptionList& app, PartitionOptions& o, const std::string& otherwise) {
  app.add_option(
      "--partition", o.partition,
      "elements of the sky: adaptive, energy, uniform, tregenza, reinhart:1 .. reinhart:6 "
      "(default: " +
          otherwise + ")");
  app.add_option("--elements", o.elements, "number of sky elements, 1 to 1,000,000");
  app.add_option("--energy-threshold", o.energy_threshold_lux,
                 "divide until luminance times solid angle of every element is below, lm/m2");
}

PartitionRequest resolve_partition(const PartitionOptions& o) {
  PartitionRequest request = parse_partition(o.partition.value_or("adaptive"));
  if (o.elements) {
    if (*o.elements < 1) throw InputError(fmt::format("--elements {} is below 1", *o.elements));
    request.elements = static_cast<std::size_t>(*o.elements);
  }
  request.energy_threshold_lux = o.energy_threshold_lux;
  check_partition(request);
  return request;
}

}  // namespace tenku
