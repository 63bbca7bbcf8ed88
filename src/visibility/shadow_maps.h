/// The shadow-map engine: OpenGL behind the visibility interface.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "scene/material.h"
#include "scene/triangle_soup.h"
#include "visibility/gl_context.h"
#include "visibility/visibility.h"

namespace tenku {

struct ShadowMapOptions {
  int texels = 1024;  ///< along the longer side of a map, 8 to 16384
  /// Square texels, so that a long footprint gets a narrow map. Otherwise both sides have `texels`:
  /// where light grazes the ground its footprint is narrow, and the texels shrink with it.
  bool square_texels = false;
  GlPlatform platform = GlPlatform::Auto;
  GlLibraries libraries;
};

/// One map for a direction and a set of points: the extent of the points, seen from the light.
///
/// A map tells which triangle the light meets first at the centre of each texel, and the scene
/// tells in double where that triangle lies. Of the four texels about a point, each is asked:
///  - Its triangle does not hide a point on or before its plane.
///  - Else the mesh is followed from that triangle to the point, at most a texel's diagonal. Where
///    it gets there, the point is hidden. Where an outline comes before, the texel does not hide
///    it.
///  - Where too many triangles lie on the way, the texel hides the point if its triangle stands, at
///    the texel's centre, above the plane of the point's own surface; it counts with its bilinear
///    weight (percentage-closer filtering).
/// No depth is compared, so there is no bias to choose. That of ordinary maps must allow for half a
/// texel's diagonal times tan(i) on a surface inclined by i to the light, which opens a gap at the
/// foot of walls; here surfaces do not shade themselves however low the light, and shadows begin at
/// the foot. What is left to rounding is 0.1 mm.
///
/// Glass is left out of the maps: rays find the panes on the way from points that the maps do not
/// hide, as in the ray engine.
///
/// Source   L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978; W. T. Reeves,
///          D. H. Salesin and R. L. Cook, "Rendering antialiased shadows with depth maps", SIGGRAPH
///          1987. One map per sky element: S. Takada, Y. Dobashi and T. Yamamoto (in Japanese).
/// Frame    local east, north, up, any distance from the origin: what is drawn is moved near zero.
/// Error    outlines of what is wider than a texel are as exact as rays. What is narrower than a
///          texel, and joined to nothing wider, may be missed.
/// Threads  may be shared: each call that draws takes a context of its own from a pool. The result
///          does not depend on how many there are.
/// Cost     one drawing of the casters that overlap the points' extent, for each direction. One map
///          is alive per call.
class ShadowMaps : public Visibility {
 public:
  /// @param soup, materials  kept by reference: they must outlive this object
  /// @throws InputError     texels out of range
  /// @throws ResourceError  if there is no OpenGL, or the driver fails
  ShadowMaps(const TriangleSoup& soup, const std::vector<Material>& materials,
             const ShadowMapOptions& options = {});
  ~ShadowMaps() override;

  std::string_view name() const override { return "shadow-maps"; }

  /// One map for each different direction. The points count as facing the light: give their normals
  /// to `transmission_from` where they lie on surfaces.
  void transmission(std::span<const Vec3> origin, std::span<const Vec3> direction,
                    std::span<float> result) const override;

  void transmission_from(Vec3 direction, std::span<const Vec3> point, std::span<const Vec3> normal,
                         std::span<float> result) const override;

  /// Sides of a texel of the map for these points and this direction, in metres across the light:
  /// the level one first.
  struct Texel {
    double width_m, height_m;
  };
  Texel texel(Vec3 direction, std::span<const Vec3> point) const;

  /// The same casters and contexts with maps of another size. Shares what it draws with.
  /// @param reach_m  casters farther than this from the box about the points are left out
  /// @throws InputError as the constructor
  ShadowMaps with(int texels, double reach_m = std::numeric_limits<double>::infinity()) const;

  /// How many triangles a map for these points and this direction draws.
  std::size_t triangles_drawn(Vec3 direction, std::span<const Vec3> point) const;

  /// How many maps have been drawn so far, by this object and those that share with it.
  std::uint64_t maps_drawn() const;
  /// OpenGL as the driver names it.
  const std::string& description() const { return description_; }

 private:
  struct State;
  ShadowMaps(std::shared_ptr<State> state, const ShadowMapOptions& options, double reach_m);

  std::string description_;
  std::shared_ptr<State> state_;
  ShadowMapOptions options_;
  double reach_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace tenku
