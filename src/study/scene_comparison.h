/// One place by two models: where the simpler one is enough.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "illuminance/illuminate.h"
#include "illuminance/light_method.h"
#include "study/ground_plan.h"
#include "study/lit_scene.h"

namespace tenku {

/// Light on the ground of a scene, and of another model of the same place, in squares.
///
/// Shape    all but `plan` [square], in the order of `plan.cell`, those that are open in both.
/// Frame    `plan` in the local frame of the first scene.
struct SceneComparison {
  GroundPlan plan;  ///< its grid holds `difference_pct`, without sign
  SensorIlluminance first, second;
  std::vector<double> difference_pct;  ///< second - first, of the first, at least 1 % of open light
  std::vector<double> error_pct;       ///< 95 % half-width of the difference, of the same
  std::size_t covered = 0;             ///< squares that are open in the first alone
};

/// What is compared.
struct ComparedScene {
  const LitScene& lit;
  const ReflectionFinder* reflection;  ///< as `IlluminanceOptions::reflection`
};

/// @param spacing_m  side of a square; wider where there would be over 60,000
/// @throws InputError  if no open ground is in both, or one has a place on Earth and the other not
SceneComparison compare_scenes(const ComparedScene& first, const ComparedScene& second,
                               const IlluminanceOptions& options, const LightMethod& method,
                               double spacing_m, Progress& progress);

inline constexpr std::array<double, 4> kWithin_pct{2.0, 5.0, 10.0, 20.0};

/// One line of the table: some of the squares.
struct ComparisonRow {
  std::string which;
  std::size_t squares = 0;
  double mean_pct = 0.0;  ///< of the differences with their signs: lighter or darker on the whole
  double median_pct = 0.0, p95_pct = 0.0, worst_pct = 0.0;  ///< without signs
  std::array<double, 4> within{};                           ///< share of them, as `kWithin_pct`
  double sun_differs = 0.0;  ///< share that has the sun in one and not in the other
};

/// All squares, then by the sky that they see.
std::vector<ComparisonRow> comparison_table(const SceneComparison& comparison);

}  // namespace tenku
