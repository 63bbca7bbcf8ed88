/// The light at the corners of elements, all reflections in it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/rgb.h"
#include "meshing/element_mesh.h"
#include "radiosity/daylight_sources.h"
#include "radiosity/emitter_light.h"
#include "radiosity/point_gather.h"
#include "radiosity/side_points.h"
#include "radiosity/surface_light.h"

namespace tenku {

/// Light straight from lamps on a mesh, as they are: found once, whatever the sky.
struct LampsOnMesh {
  std::vector<EmitterLight::Direct> corner;      ///< [point]
  std::vector<PointGather::Looks> left_to_rows;  ///< [point], of surfaces that are not in the above
  std::vector<Rgb> middle;                       ///< [element side], lux
  std::vector<std::uint8_t> has_middle;  ///< [element side], of the same lamps as at its corners
};

/// @param is_lit  [point]: others have no light
/// @param rays    at most, to a lamp that a point sees in part
LampsOnMesh lamps_on_mesh(const ElementMesh& mesh, const SurfaceLight& surfaces,
                          const SidePoints& points, const EmitterLight& lamps,
                          const PointGather& gather, std::span<const std::uint8_t> is_lit,
                          double lift_m, int rays);

/// What never changes while corners gather: borrowed.
struct CornerProblem {
  const ElementMesh& mesh;
  const SurfaceLight& surfaces;
  const SidePoints& points;
  const LampsOnMesh& lamps;
  double lamp_scale;  ///< of what surfaces emit: `surfaces` have it in them, `lamps` have not
  const DaylightOnSides& daylight;
  double enough_pct;  ///< of the light in dim places: what sweeps may leave; infinite: one sweep
};

/// Light at corners and what sides send by it.
struct CornerLight {
  std::vector<Rgb> lux;          ///< [point], all but daylight straight from sun and sky
  std::vector<double> variance;  ///< [point], lux^2: of form factors and lamps
  std::vector<double> mesh_lux;  ///< [point], half-width: by `mesh_errors_lux`, once all is settled
  std::vector<Rgb> radiosity;    ///< [element side], lm/m2
  std::vector<std::uint8_t> open;  ///< [element side], bits of the corners that count
  std::vector<double> spread;      ///< [element side], lm/m2: radiosity between corners, at most
  std::vector<double> middle_off;  ///< [element side], lux: how far the light straight from sun,
                                   ///< sky and lamps in its middle is off the mean of its corners
  std::vector<double> uneven;      ///< [element side], lm/m2: doubt of the mean radiosity
  double convergence_lux = 0.0;    ///< bound on the light still under way, anywhere
  std::size_t sweeps = 0;
};

/// Corners gather what sides send, sides send what their corners and middles receive, until that
/// changes little: collocation, solved by Jacobi's iteration from `start`. After every other sweep
/// what sides send goes on by as much as its last changes, in proportion, would add up to.
///
/// The mean of a side is that of its corners, of daylight and lamps a quarter of it and three
/// quarters of the middle. A corner without any light beside lit ones is inside of something that
/// stands on the surface: it does not count.
///
/// Error    convergence: a sweep shrinks every error of what sides send at least by the greatest
///            reflectance rho, so that it was at most 1 / (1 - rho) of the last change before
///            that; what corners have gathered of it is no more wrong.
///          form factors: from the two looks of each point, half its own difference, half that of
///            its plane.
///          mesh: kNear of the spread of a side counts as far as the side is wide in the view of
///            the point (form factor over itself and kWideView), for who sees it only in part sees
///            another mean; and kDoubt of how far corners and middle differ, taken as kCurved of
///            the spread where only corners are known.
/// @param start    radiosity [element side], and which corners count if that is known already
/// @param is_lit   [point]
/// @throws Cancelled
CornerLight solve_at_corners(const CornerProblem& problem, const PointGather& gather,
                             CornerLight start, std::span<const std::uint8_t> is_lit,
                             Progress& progress);

/// What a side adds to the error of a row in parts of its form factor, lm/m2: where it fills the
/// view of the point, and anywhere.
struct MeshDoubt {
  float near = 0.0F, anywhere = 0.0F;
};
std::vector<MeshDoubt> mesh_doubts(const CornerLight& light);

/// Half-widths of corners.
/// @return  [point]
std::vector<double> mesh_errors_lux(const CornerLight& light, const PointGather& gather,
                                    std::span<const std::uint8_t> is_lit);

/// Half-width for one row: see the above.
/// @param of_side  [element side]
double mesh_error_lux(const FormFactorRow& row, std::span<const MeshDoubt> of_side);

/// Variance of each mean of two looks, lux^2: half its own draw and half that of its group in
/// proportion, and no less than the latter.
/// @param group  [point], numbers from 0
std::vector<double> pooled_variance(std::span<const PointGather::Looks> looks,
                                    std::span<const std::uint32_t> group);

/// Light straight from lamps, at points on a surface.
std::vector<EmitterLight::Direct> light_of_lamps(const EmitterLight& lamps, const Sensors& sensors,
                                                 std::span<const std::uint8_t> is_wanted,
                                                 double lift_m, int rays);

/// What the emitting sides of a row give to its point, without the lamps that it knows exactly.
Rgb emission_left_to_row(const SurfaceLight& surfaces, const EmitterLight& lamps,
                         const EmitterLight::Direct& known, const FormFactorRow& row);

inline Rgb mean_of(const PointGather::Looks& looks) { return 0.5 * (looks[0] + looks[1]); }

/// What sides send without what they emit.
std::vector<Rgb> reflected_part(const SurfaceLight& surfaces, std::span<const Rgb> radiosity);

}  // namespace tenku
