/// Options that say where the sensors are. Private to this module.
#pragma once

#include <optional>
#include <string>

#include "study/lit_scene.h"

namespace tenku {

class OptionList;

/// `--sensors`, `--grid`, `--spacing`.
struct SensorOptions {
  std::string sensors, grid;
  double spacing_m = 1.0;

  bool is_given() const { return !sensors.empty() || !grid.empty(); }
};

void add_sensor_options(OptionList& app, SensorOptions& options);

/// @throws InputError unless one of the two ways is given
void check_sensor_options(const SensorOptions& options);

/// Sensors in the coordinates of the scene file and in the local frame; a grid has a mesh too.
struct PlacedSensors {
  Sensors in_file, sensors;
  std::optional<SensorGrid> grid;
};

/// @throws InputError as the reader of sensor files and `LitScene::grid` do
PlacedSensors place_sensors(const SensorOptions& options, const LitScene& lit);

}  // namespace tenku
