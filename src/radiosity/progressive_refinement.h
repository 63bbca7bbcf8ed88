/// Light between diffuse surfaces, brightest senders first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/rgb.h"
#include "meshing/element_mesh.h"
#include "radiosity/patch_rows.h"
#include "radiosity/surface_light.h"

namespace tenku {

/// Where all light has gone, by luminance. emitted = absorbed + escaped + unshot.
struct LightBalance {
  double emitted_lm = 0.0;   ///< by surfaces, and brought by sun and sky onto surfaces
  double absorbed_lm = 0.0;  ///< by surfaces
  double escaped_lm = 0.0;   ///< sent where nothing is
  double unshot_lm = 0.0;    ///< still to be sent
};

/// What the sides of a mesh receive and send.
///
/// Units    lux and lm/m2, in linear Rec. 709 channels.
/// Shape    every vector [element side].
struct SideRadiosity {
  std::vector<Rgb> received;   ///< from other sides, lux
  std::vector<Rgb> radiosity;  ///< sent in all, the unshot part too, lm/m2
  std::vector<Rgb> unshot;     ///< lm/m2
};

/// The state of a solution, as those who watch it see it.
struct ShotView {
  std::size_t shots;
  const SideRadiosity& sides;
  Rgb ambient;  ///< lux that the unshot light would give everywhere if it were spread evenly
};

/// Light that has been sent before the first shot.
///
/// Shape    both vectors [element side], or both empty: none.
struct SentLight {
  std::vector<Rgb> radiosity;  ///< sent by then, lm/m2
  std::vector<Rgb> received;   ///< of it, lux
  double escaped_lm = 0.0;     ///< of it
};

struct RefinementOptions {
  /// The end: what the unshot light can still bring to surfaces is at most this share of what they
  /// have received, and it is itself at most 0.05 % of what is emitted.
  double tolerance = 0.002;
  std::size_t most_shots = 0;  ///< 0: a million, or a hundred to a patch if that is more
  SentLight start;             ///< shots make up for it where it is too much
  /// Called after shots 1, 2, 4, 8 and so on, and at the end.
  std::function<void(const ShotView&)> watch;
};

struct RefinementResult {
  SideRadiosity sides;
  LightBalance balance;
  std::size_t shots = 0;
  double left_lm = 0.0;  ///< bound on what surfaces would still receive
  bool is_converged = false;
};

/// Solves for the radiosity of all sides.
///
/// Patch sides with the most unshot flux send it first, their mean radiosity; elements receive by
/// the rows. A row shares out the flux that is sent and never more than that, so that nothing is
/// made or lost on the way. Shots that take back what the start has sent too much of count like
/// others: what is unshot is a sum of magnitudes. Patch sides are taken in batches of kBatch, which
/// depend on nothing but the light: the same bits for any number of threads.
///
/// Source   M. Cohen, S. E. Chen, J. Wallace, D. Greenberg, "A progressive refinement approach to
///          fast radiosity image generation", SIGGRAPH 1988: order, ambient term, two levels.
/// Error    `left_lm`: of a flux U that is sent, surfaces receive at most U and send back at most
///          rho U, with rho the greatest reflectance; the sum over all bounces is U / (1 - rho).
///          That of rows and of the mesh is not in it.
/// @param direct  illuminance that does not come from sides, lux [element side]
/// @throws Cancelled
RefinementResult refine_progressively(const ElementMesh& mesh, const SurfaceLight& surfaces,
                                      std::span<const Rgb> direct, PatchRows& rows,
                                      const RefinementOptions& options, Progress& progress);

}  // namespace tenku
