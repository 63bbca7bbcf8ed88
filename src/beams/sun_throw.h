/// Where mirrors throw the sun's light.
#pragma once

#include <cstdint>
#include <vector>

#include "beams/sun_mirrors.h"
#include "beams/triangle_tree.h"
#include "core/progress.h"
#include "core/units.h"

namespace tenku {

/// A flat convex polygon that gets sunlight from one panel.
///
/// Frame    local east, north, up; corners counter-clockwise from the lit side.
struct ThrownPolygon {
  std::uint32_t panel = 0;     ///< the first that the light met
  std::uint32_t triangle = 0;  ///< on which it lies
  std::uint32_t mirrors = 1;   ///< that the light has met
  double lux = 0.0;            ///< on the surface, of this light alone
  double area_m2 = 0.0;
  /// Width of the soft edge that the solar disc gives the outline, the widest on this polygon,
  /// metres: lux rises over it from none to all. An outline that is a shadow's on the panel is
  /// softer by the way from what casts the shadow.
  double blur_m = 0.0;
  std::vector<Vec3> corners;
};

/// What one panel does with the light of the sun.
struct PanelLight {
  double arriving_lm = 0.0;  ///< on the whole panel, if nothing stood before it
  double lit_lm = 0.0;       ///< that reaches it
  double thrown_lm = 0.0;    ///< that it mirrors
  double reflectance = 0.0;  ///< at the angle of the sun
};

/// Sunlight thrown by all panels of a scene.
///
/// Every beam is divided exactly by what it meets first: thrown_lm = the polygons with
/// `mirrors` 1 that no pane let through + what is lost to the sky.
struct ThrownSun {
  std::vector<ThrownPolygon> polygons;  ///< in the order of the panels
  std::vector<PanelLight> panels;       ///< [panel]
  double started_lm = 0.0;              ///< of all beams: thrown, mirrored again, through panes
  double landed_lm = 0.0;               ///< where beams met a surface
  double sky_lm = 0.0;                  ///< where they met nothing
  double unfollowed_lm = 0.0;           ///< that mirrors beyond the depth would throw on
};

/// How far the light is followed.
struct ThrowOptions {
  unsigned depth = 2;      ///< mirrors that a beam may meet, at least 1
  double least_lux = 1.0;  ///< of a beam, on a plane that faces it; weaker ones are not followed
};

/// The sun at one instant.
struct ThrowingSun {
  Vec3 direction;  ///< unit, to the centre
  Angle angular_radius;
  Illuminance normal;  ///< on a plane that faces it
};

/// @param tree       of the scene's triangles
/// @param materials  of the scene
/// @param panels     `mirror_panels` of the same
/// Error    the geometry is exact but for `first_met`'s slivers, for a sun that is a point; the
///          solar disc blurs edges by `blur_m`, flux unchanged.
/// Threads  the same bits for any number of them.
ThrownSun throw_sunlight(const TriangleTree& tree, const std::vector<Material>& materials,
                         const std::vector<MirrorPanel>& panels, const ThrowingSun& sun,
                         const ThrowOptions& options, const Progress& progress);

}  // namespace tenku
