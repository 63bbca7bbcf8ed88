#include "cli/sensor_options.h"

#include <vector>

#include "cli/option_list.h"
#include "core/error.h"
#include "output/sensor_file.h"

namespace tenku {
namespace {

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    if (end > begin) words.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

}  // namespace

void add_sensor_options(OptionList& app, SensorOptions& options) {
  app.add_option("--sensors", options.sensors,
                 "sensors: x y z nx ny nz a line; - for standard input");
  app.add_option("--grid", options.grid, "surfaces to cover: ground,roofs,walls");
  app.add_option("--spacing", options.spacing_m, "of the grid, metres (default 1)");
}

void check_sensor_options(const SensorOptions& options) {
  if (options.sensors.empty() == options.grid.empty()) {
    throw InputError("give either --sensors FILE or --grid SURFACES --spacing M");
  }
}

PlacedSensors place_sensors(const SensorOptions& options, const LitScene& lit) {
  PlacedSensors placed;
  if (!options.sensors.empty()) {
    placed.in_file = read_sensor_file(options.sensors);
    placed.sensors = lit.to_local(placed.in_file);
    return placed;
  }
  placed.grid = lit.grid(words_of(options.grid), options.spacing_m);
  placed.sensors = placed.grid->sensors;
  placed.in_file = lit.to_file(placed.sensors);
  return placed;
}

}  // namespace tenku
