// Rooms of known radiosity: closed forms, continuous solutions, the Cornell box.
#include <gtest/gtest.h>

#include "radiosity/solver_scene.h"
#include "support/measured.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

using testing_support::ReferenceTable;
using testing_support::SolverScene;
using testing_support::WorstError;

TEST(Radiosity, InAWhiteFurnaceIsTheGeometricSeries) {
  WorstError worst("furnace, relative");
  for (const double rho : {0.0, 0.3, 0.5, 0.8, 0.9}) {
    SolverScene scene;
    const std::uint32_t wall = scene.grey(rho, 100.0);
    scene.room({4, 5, 2.7}, {wall, wall, wall, wall, wall, wall}, 1.0);
    InteriorOptions options;
    options.tolerance_pct = 1.0;
    const InteriorLight light = scene.light(options);
    for (std::size_t side = 0; side < scene.mesh.sides(); side += 2) {
      const double radiosity = luminance_of(light.corners.radiosity[side]);
      worst.add(radiosity * (1.0 - rho) / 100.0 - 1.0, std::to_string(rho));
    }
    testing_support::expect_balanced(light.shots.balance);
  }
  EXPECT_LE(worst.worst(), 0.001);
}

Sensors sensors_of_room(const ReferenceTable& table, const std::string& room) {
  static const std::array<Vec3, 6> kInward{
      {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}};
  Sensors sensors;
  for (std::size_t row = 0; row < table.size(); ++row) {
    if (table.text(row, "room") != room) continue;
    sensors.position.push_back(
        {table.number(row, "x"), table.number(row, "y"), table.number(row, "z")});
    sensors.normal.push_back(kInward.at(static_cast<std::size_t>(table.number(row, "face"))));
  }
  return sensors;
}

SolverScene closed_room(const ReferenceTable& table, std::size_t row, double cells) {
  SolverScene scene;
  const std::uint32_t floor = scene.grey(table.number(row, "rho_floor")),
                      ceiling = scene.grey(table.number(row, "rho_ceiling"),
                                           table.number(row, "ceiling_emission")),
                      wall = scene.grey(table.number(row, "rho_walls"));
  const Vec3 size{table.number(row, "width"), table.number(row, "depth"),
                  table.number(row, "height")};
  scene.room(size, {floor, ceiling, wall, wall, wall, wall}, cells / size.x);
  return scene;
}

/// Worst relative error of the reference points of the room that begins in a row.
double worst_error(const ReferenceTable& table, std::size_t row, const SensorIlluminance& values) {
  WorstError worst(table.text(row, "room") + ", relative");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double truth = table.number(row + i, "illuminance");
    worst.add(values.reflected_lux[i] / truth - 1.0, std::to_string(i));
    EXPECT_LE(std::abs(values.reflected_lux[i] - truth),
              values.error_lux[i] + 3.0 * table.number(row + i, "error"))
        << table.text(row, "room") << " " << i;
  }
  return worst.worst();
}

TEST(Radiosity, OfClosedRoomsIsTheContinuousSolution) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/radiosity/continuous_rooms.csv");
  for (std::size_t row = 0; row < table.size(); row += 12) {
    const SolverScene scene = closed_room(table, row, 16.0);
    Progress quiet;
    Interior interior(scene.mesh, scene.materials, {});
    const InteriorLight light = interior.light({}, quiet);
    testing_support::expect_balanced(light.shots.balance);
    const Sensors sensors = sensors_of_room(table, table.text(row, "room"));
    SensorIlluminance values(sensors.size());
    InteriorSensors look = interior.look_from(sensors);
    interior.add_reflected(look, light, values, quiet);
    EXPECT_LE(worst_error(table, row, values), 0.005);
  }
}

// The points lie down to a hundredth of the length from an edge. By the means of elements that long
// they would be off by 3 %.
TEST(Radiosity, PixelsInCreasesSeeHowTheLightOfLongElementsVaries) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/radiosity/continuous_rooms.csv");
  for (std::size_t row = 0; row < table.size(); row += 12) {
    const SolverScene scene = closed_room(table, row, 4.0);
    Progress quiet;
    Interior interior(scene.mesh, scene.materials, {});
    const InteriorLight light = interior.light({}, quiet);
    const Sensors points = sensors_of_room(table, table.text(row, "room"));
    SensorIlluminance values(points.size());
    interior.add_reflected_to_pixels(points, 1, light, values, quiet);
    interior.add_lamps(points, light, false, values, quiet);
    EXPECT_LE(worst_error(table, row, values), 0.01);
  }
}

}  // namespace
}  // namespace tenku
