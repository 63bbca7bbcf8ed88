/// The light that points of a picture receive from the sides of a mesh, as they vary.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/progress.h"
#include "form_factors/hemisphere_look.h"
#include "form_factors/outward_view.h"
#include "illuminance/sensor.h"
#include "radiosity/corner_solution.h"
#include "radiosity/emitter_light.h"
#include "radiosity/point_gather.h"
#include "radiosity/radiosity_slopes.h"
#include "radiosity/settled_looks.h"
#include "radiosity/surface_light.h"

namespace tenku {

/// What sides send: borrowed.
struct SentBySides {
  const SurfaceLight& surfaces;
  const EmitterLight& lamps;
  double lamp_scale;               ///< of `lamps`: `surfaces` have it in them
  std::span<const Rgb> reflected;  ///< mean [element side], lm/m2
  const RadiositySlopes& slopes;
  std::span<const MeshDoubt> doubts;
};

/// Rays from points into a mesh. Nothing is kept: a picture is lit once.
///
/// Where a ray meets a side nearer than its element is long, as in creases, the light there is not
/// that between the corners: from such places a path goes on until it comes far enough, if the
/// doubt of the mesh is beyond the tolerance.
class PixelGather {
 public:
  /// @param mesh  kept by reference
  PixelGather(const ElementMesh& mesh, const PointGatherOptions& options);

  struct Goal {
    double tolerance_pct;
    int mean_of;  ///< values that are to be averaged: each may have the noise of one of them
  };
  /// Light from sides without the lamps that are found for each point by themselves.
  /// @param values  direct light that is known
  /// @throws Cancelled
  SettledLooks gather(const Sensors& points, const SentBySides& sent,
                      const SensorIlluminance& values, Goal goal, Progress& progress) const;

 private:
  using Looks = std::array<std::unique_ptr<HemisphereLook>, PointGather::kLooks>;
  struct Found {
    Rgb lux;
    double mesh_lux;
  };

  /// One that looks, lifted off its surface.
  struct Point {
    Vec3 position, normal;
    const EmitterLight::Direct& lamps;
    double direct_lux, tolerance;
  };

  /// Reflected radiosity at a place on a side, as its corners tell.
  Rgb sent_from(std::uint32_t side, Vec3 place, const SentBySides& sent) const;
  /// The same, one draw.
  /// @param way  of the first ray, cosine-weighted on the unit square
  Rgb sent_by_path(std::uint32_t side, Vec3 place, std::array<double, 2> way,
                   const SentBySides& sent) const;
  /// What paths find of the light of sides over what their corners tell.
  Rgb beyond_corners(const std::vector<const MetSide*>& met, const Point& point,
                     const SentBySides& sent) const;
  Found look(const HemisphereLook& look, const Point& point, const SentBySides& sent) const;

  PointGatherOptions options_;
  MeshRays mesh_;
  OutwardView outward_;
  std::vector<double> near_m_;  ///< [element]
  std::vector<Looks> looks_;    ///< [level]
};

}  // namespace tenku
