/// The light of a scene with all its reflections, by radiosity: the whole calculation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/finding.h"
#include "core/progress.h"
#include "illuminance/sensor.h"
#include "meshing/element_mesh.h"
#include "radiosity/corner_solution.h"
#include "radiosity/daylight_sources.h"
#include "radiosity/emitter_light.h"
#include "radiosity/former_lights.h"
#include "radiosity/light_leaks.h"
#include "radiosity/patch_rows.h"
#include "radiosity/pixel_gather.h"
#include "radiosity/point_gather.h"
#include "radiosity/progressive_refinement.h"
#include "radiosity/side_points.h"
#include "radiosity/surface_light.h"

namespace tenku {

struct InteriorOptions {
  std::string form_factors = "hemisphere-rays";  ///< method
  FormFactorOptions shot{.resolution = 32};      ///< of each of the points of a patch that shoots
  int point_resolution = 0;  ///< of corners of elements; 0: by the tolerance, 24 at 2 %
  int sensor_resolution = 128;
  double tolerance_pct = 2.0;
  std::size_t most_shots = 0;                      ///< 0: as many as it takes
  std::size_t most_bytes = std::size_t{2} << 30U;  ///< of form factors that are kept
  double lift_m = 1e-5;
  bool many_skies = false;  ///< keeps what of one light serves others
  std::function<void(const ShotView&)> watch;
};

/// Seconds of the stages.
struct InteriorTimes {
  double form_factors_s = 0.0, daylight_s = 0.0, solve_s = 0.0;
};

/// One light in the scene: sun and sky, and how bright the lamps are.
struct LightRequest {
  const DaylightMethod* daylight = nullptr;  ///< null: none
  double lamp_scale = 1.0;                   ///< of what surfaces emit
};

/// What it comes to.
///
/// Units    lux, lm/m2.
struct InteriorLight {
  RefinementResult shots;
  CornerLight corners;
  SensorIlluminance points{0};  ///< [point of `SidePoints`], with the light from other sides as
                                ///< `reflected_lux`
  std::vector<std::uint8_t> is_lit;  ///< [point], whether any light reaches its plane
  double lamp_scale = 1.0;
  std::vector<Finding> findings;
};

/// Sensors with their form factors, for `Interior::add_reflected`.
struct InteriorSensors {
  std::unique_ptr<PointGather> gather;
  std::vector<EmitterLight::Direct> lamps;
  std::vector<std::uint8_t> all;  ///< [sensor], 1
};

/// A mesh with its form factors: asked again for another light, it looks nowhere twice.
///
/// First patches shoot (`refine_progressively`), which settles where the light goes; then every
/// corner of an element gathers what the sides send, sides send what their corners receive, and so
/// on until that changes nothing: values that are continuous over each plane, and exact where
/// everything is evenly lit.
class Interior {
 public:
  /// @param mesh, materials  kept by reference
  /// @throws InputError as `form_factor_method`; a tolerance not in (0, 100] percent
  Interior(const ElementMesh& mesh, const std::vector<Material>& materials,
           const InteriorOptions& options);

  /// @throws Cancelled
  InteriorLight light(const LightRequest& request, Progress& progress);

  /// Form factors that another mesh of the same surfaces can take over; they are gone from here.
  /// @param now  [element side], numbers there, as `PointGather::release`
  std::vector<PointGather::Kept> release_rows(std::span<const std::uint32_t> now) {
    return gather_.release(now);
  }
  /// @return  number of points whose form factors need not be found
  std::size_t adopt_rows(std::vector<PointGather::Kept> rows) {
    return gather_.adopt(std::move(rows));
  }

  /// Sensors that look into the mesh once for many lights.
  /// @param sensors  kept by reference
  InteriorSensors look_from(const Sensors& sensors) const;
  /// Adds the light straight from lamps to points of a picture.
  /// @param on_edges  neighbours differ: a lamp may be seen by a sliver
  void add_lamps(const Sensors& points, const InteriorLight& light, bool on_edges,
                 SensorIlluminance& values, Progress& progress) const;
  /// Adds the light from sides to direct light on sensors. Those that are not within half of the
  /// tolerance look more finely, and stay so.
  void add_reflected(InteriorSensors& sensors, const InteriorLight& light,
                     SensorIlluminance& values, Progress& progress) const;

  /// The same for some points of a picture, whose light is blended at the others, without lamps,
  /// whose shadows are too sharp to be blended. Half as many lines by rays, which see how what a
  /// side sends varies over it.
  /// @param values   direct light, that of lamps included
  /// @param mean_of  so many values are to be averaged: each may have the noise of one of them
  void add_reflected_to_pixels(const Sensors& points, int mean_of, const InteriorLight& light,
                               SensorIlluminance& values, Progress& progress);

  const SidePoints& points() const { return points_; }
  const SurfaceLight& surfaces() const { return surfaces_; }
  const InteriorTimes& times() const { return times_; }
  /// Bytes of form factors that are kept.
  std::size_t bytes() const { return rows_.store().bytes() + gather_.bytes() + daylight_.bytes(); }

 private:
  const std::vector<std::uint8_t>& open_points(Progress& progress);
  RefinementResult shoot(const SurfaceLight& surfaces, const DaylightOnSides& direct,
                         SentLight start, Progress& progress);
  std::vector<double> enclosed_areas() const;
  std::vector<std::uint8_t> lit_points(const SideRadiosity& sides,
                                       const DaylightOnSides& direct) const;
  const LampsOnMesh& lamps_on(std::span<const std::uint8_t> is_lit);
  /// By how many steps corners have to look more finely to be within the tolerance [point].
  /// @param margin  on the tolerance
  std::vector<std::uint8_t> rough_points(const InteriorLight& light, double margin) const;
  void tell_leaks(InteriorLight& light);
  void tell_refused(std::vector<Finding>& findings) const;

  const ElementMesh& mesh_;
  InteriorOptions options_;
  std::vector<Finding> findings_;
  SurfaceLight surfaces_;
  SidePoints points_;
  std::unique_ptr<FormFactorMethod> method_;
  PatchRows rows_;
  PointGather gather_;
  EmitterLight emitters_;
  KeptDaylight daylight_;
  bool has_light_ = false;  ///< whether corners look as finely as one light has asked for
  FormerLights former_;
  std::optional<std::vector<std::uint8_t>> is_open_;  ///< [point], once it is known
  std::vector<float> enclosure_;  ///< [point], share of its view that surfaces fill, likewise
  std::vector<std::uint8_t> lamps_known_;  ///< [point], for `lamps_`
  LampsOnMesh lamps_;
  std::unique_ptr<PixelGather> pixels_;          ///< once a picture has asked
  std::optional<std::vector<LightLeak>> leaks_;  ///< once they have been looked for
  InteriorTimes times_;
};

}  // namespace tenku
