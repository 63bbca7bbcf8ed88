#include "beams/sun_throw.h"

#include <algorithm>
#include <cmath>

#include "beams/first_met.h"
#include "core/parallel.h"
#include "visibility/ray_visibility.h"

namespace tenku {
namespace {

constexpr unsigned kMostPanes = 16;  // one behind the other

/// A part of a panel that the sun reaches, and how much of it the panes on the way let through.
struct LitPart {
  SunOutline outline;
  double transmission;
};

Vec3 mirrored(Vec3 direction, Vec3 normal) {
  return direction - 2.0 * dot(direction, normal) * normal;
}

/// The corners in space of an outline in a plane.
std::vector<Vec3> lifted(const BeamFrame& frame, const SunOutline& outline,
                         const DepthPlane& plane) {
  std::vector<Vec3> corners;
  corners.reserve(outline.size());
  for (const AcrossPoint& p : outline) corners.push_back(frame.point(p, plane.depth(p)));
  return corners;
}

class PanelThrow {
 public:
  PanelThrow(const TriangleTree& tree, const std::vector<Material>& materials,
             const ThrowingSun& sun, const ThrowOptions& options, std::uint32_t panel,
             PanelLight& of_panel, ThrownSun& result)
      : tree_(tree),
        materials_(materials),
        sun_(sun),
        options_(options),
        panel_(panel),
        of_panel_(of_panel),
        blur_(2.0 * std::tan(sun.angular_radius.in_radians())),
        result_(result) {}

  void throw_from(const MirrorPanel& panel) {
    PanelLight& light = of_panel_;
    const Material& material = materials_[panel.material];
    for (const MirrorPart& part : panel.parts) {
      const double cosine = std::abs(dot(part.normal, sun_.direction));
      if (!(cosine > kEdgeOn)) continue;
      const BeamFrame to_sun(sun_.direction);
      const DepthPlane plane(to_sun, part.corners[0], part.normal);
      const BeamStart start{to_sun, outline_of(to_sun, part.corners), plane, cosine};
      const double share = mirrored_share(material, cosine);
      light.arriving_lm += sun_.normal.value() * area_of(start.outline);
      std::vector<LitPart> lit;
      find_lit(start, 1.0, 0, lit);
      for (const LitPart& piece : lit) {
        const double lux = piece.transmission * sun_.normal.value();
        const double lumen = lux * area_of(piece.outline);
        light.lit_lm += lumen;
        light.thrown_lm += share * lumen;
        follow_from(lifted(to_sun, piece.outline, plane), part.normal,
                    mirrored(-sun_.direction, part.normal), {share * lux, 0.0, 1, 0});
      }
    }
    light.reflectance = light.lit_lm > 0.0 ? light.thrown_lm / light.lit_lm : 0.0;
  }

 private:
  /// What a beam carries with it.
  struct Carried {
    double normal_lux;  ///< on a plane that faces the beam
    double way_m;       ///< from the first panel
    unsigned mirrors, panes;
  };

  const Material& material_of(std::uint32_t triangle) const {
    return materials_[tree_.soup().material[triangle]];
  }

  /// The parts of a beam toward the sun that reach it.
  void find_lit(const BeamStart& start, double transmission, unsigned panes,
                std::vector<LitPart>& lit) const {
    for (MetPiece& piece : first_met(start, tree_)) {
      if (piece.triangle == MetPiece::kNothing) {
        lit.push_back({std::move(piece.outline), transmission});
        continue;
      }
      const Material& material = material_of(piece.triangle);
      if (!material.is_glass() || panes == kMostPanes) continue;
      const Vec3 normal = normal_of(tree_.soup(), piece.triangle);
      const double cosine = std::abs(dot(normal, start.frame.along));
      const auto corner = tree_.soup().triangles[piece.triangle][0];
      const BeamStart beyond{start.frame, std::move(piece.outline),
                             DepthPlane(start.frame, tree_.soup().vertices[corner], normal),
                             cosine};
      find_lit(beyond, transmission * pane_transmittance(material, cosine), panes + 1, lit);
    }
  }

  /// Follows the light that leaves a polygon in a direction.
  void follow_from(const std::vector<Vec3>& corners, Vec3 normal, Vec3 direction,
                   const Carried& light) {
    const double cosine = std::abs(dot(normal, direction));
    const BeamFrame frame(direction);
    const BeamStart start{frame, outline_of(frame, corners), DepthPlane(frame, corners[0], normal),
                          cosine};
    const double lumen = light.normal_lux * area_of(start.outline);
    if (!(light.normal_lux >= options_.least_lux)) {
      result_.unfollowed_lm += lumen;
      return;
    }
    result_.started_lm += lumen;
    for (const MetPiece& piece : first_met(start, tree_)) {
      const double part_lm = light.normal_lux * area_of(piece.outline);
      if (piece.triangle == MetPiece::kNothing) {
        result_.sky_lm += part_lm;
      } else {
        result_.landed_lm += part_lm;
        land(start, piece, light);
      }
    }
  }

  void land(const BeamStart& start, const MetPiece& piece, const Carried& light) {
    const TriangleSoup& soup = tree_.soup();
    const Vec3 normal = normal_of(soup, piece.triangle);
    const double cosine = std::abs(dot(normal, start.frame.along));
    const DepthPlane plane(start.frame, soup.vertices[soup.triangles[piece.triangle][0]], normal);
    const double way = light.way_m + greatest(piece.outline, [&](AcrossPoint p) {
                         return plane.depth(p) - start.plane.depth(p);
                       });
    ThrownPolygon polygon;
    polygon.panel = panel_;
    polygon.triangle = piece.triangle;
    polygon.mirrors = light.mirrors;
    polygon.lux = light.normal_lux * cosine;
    polygon.area_m2 = area_of(piece.outline) / cosine;
    polygon.blur_m = blur_ * way / cosine;
    polygon.corners = lifted(start.frame, piece.outline, plane);
    // Seen along the beam they run counter-clockwise; the lit side looks against it.
    std::reverse(polygon.corners.begin(), polygon.corners.end());
    const std::vector<Vec3> corners = polygon.corners;
    result_.polygons.push_back(std::move(polygon));
    go_on(corners, normal, piece.triangle, start.frame.along,
          {light.normal_lux, way, light.mirrors, light.panes}, area_of(piece.outline));
  }

  /// What a surface that is met mirrors or lets through.
  void go_on(const std::vector<Vec3>& corners, Vec3 normal, std::uint32_t triangle, Vec3 direction,
             const Carried& light, double across_m2) {
    const Material& material = material_of(triangle);
    const double cosine = std::abs(dot(normal, direction));
    if (material.is_glass() && light.panes < kMostPanes) {
      Carried through = light;
      through.normal_lux *= pane_transmittance(material, cosine);
      ++through.panes;
      follow_from(corners, normal, direction, through);
    }
    if (!is_mirror(material)) return;
    Carried on = light;
    on.normal_lux *= mirrored_share(material, cosine);
    if (++on.mirrors > options_.depth) {
      result_.unfollowed_lm += on.normal_lux * across_m2;
    } else {
      follow_from(corners, normal, mirrored(direction, normal), on);
    }
  }

  const TriangleTree& tree_;
  const std::vector<Material>& materials_;
  const ThrowingSun& sun_;
  const ThrowOptions& options_;
  std::uint32_t panel_;
  PanelLight& of_panel_;
  double blur_;  ///< width of the soft edge for each metre of way, across the beam
  ThrownSun& result_;
};

void add(ThrownSun& all, ThrownSun&& one) {
  std::move(one.polygons.begin(), one.polygons.end(), std::back_inserter(all.polygons));
  all.started_lm += one.started_lm;
  all.landed_lm += one.landed_lm;
  all.sky_lm += one.sky_lm;
  all.unfollowed_lm += one.unfollowed_lm;
}

}  // namespace

ThrownSun throw_sunlight(const TriangleTree& tree, const std::vector<Material>& materials,
                         const std::vector<MirrorPanel>& panels, const ThrowingSun& sun,
                         const ThrowOptions& options, const Progress& progress) {
  ThrownSun all;
  all.panels.resize(panels.size());
  if (!(sun.direction.z > 0.0) || !(sun.normal.value() > 0.0)) return all;
  std::vector<ThrownSun> each(panels.size());
  parallel_for(panels.size(), 1, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      progress.stop_if_cancelled();
      PanelThrow(tree, materials, sun, options, static_cast<std::uint32_t>(k), all.panels[k],
                 each[k])
          .throw_from(panels[k]);
    }
  });
  for (ThrownSun& one : each) add(all, std::move(one));
  return all;
}

}  // namespace tenku
