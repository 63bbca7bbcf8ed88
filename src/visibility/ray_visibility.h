/// The ray engine: Embree behind the visibility interface.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "scene/material.h"
#include "scene/triangle_soup.h"
#include "visibility/floating_parts.h"
#include "visibility/mesh_adjacency.h"
#include "visibility/sharp_edge.h"
#include "visibility/visibility.h"

namespace tenku {

/// What a ray meets first.
struct RayHit {
  std::uint32_t triangle;
  double distance_m;
};

/// Rays against the triangles of a scene.
///
/// Opaque triangles stop a ray; panes of glass let a part through that depends on the angle of
/// incidence.
///
/// Frame    local east, north, up.
/// Error    the geometry is stored in float about the local origin: 0.1 mm at 1 km.
/// Threads  immutable after construction; may be shared.
class RayVisibility : public Visibility {
 public:
  /// @param soup       kept by reference: it must outlive this object
  /// @param materials  tells which triangles are glass
  /// @throws ResourceError if the ray-tracing device fails or memory runs out
  RayVisibility(const TriangleSoup& soup, const std::vector<Material>& materials);
  ~RayVisibility() override;

  std::string_view name() const override { return "rays"; }
  void transmission(std::span<const Vec3> origin, std::span<const Vec3> direction,
                    std::span<float> result) const override;

  /// Whether an opaque triangle lies on the ray.
  bool is_occluded(Vec3 origin, Vec3 direction) const;
  /// First opaque triangle on the ray.
  std::optional<RayHit> first_hit(Vec3 origin, Vec3 direction) const;
  /// First opaque triangle on each of many rays from one point, `kNoTriangle` where there is none.
  /// Fast where neighbours in the list are neighbours in space.
  /// Shape  both [ray].
  void first_triangles(Vec3 origin, std::span<const Vec3> direction,
                       std::span<std::uint32_t> triangle) const;
  static constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();
  /// An opaque triangle that holds the point, as far as floats can tell: a ray from there may start
  /// on either side of it.
  std::optional<std::uint32_t> triangle_at(Vec3 point) const;
  /// Product of the transmittances of the panes on the ray, whatever else is on it.
  double glass_transmission(Vec3 origin, Vec3 direction,
                            double distance_m = std::numeric_limits<double>::infinity()) const;
  /// The panes on the ray up to a distance, nearest first. Of triangles that share the edge which
  /// the ray meets one is told, and none whose plane holds the origin.
  /// @param direction  unit
  void find_panes(Vec3 origin, Vec3 direction, double distance_m, std::vector<RayHit>& panes) const;
  bool has_glass() const;

  const TriangleSoup& soup() const { return soup_; }
  const std::vector<Material>& materials() const { return materials_; }
  const MeshAdjacency& adjacency() const { return adjacency_; }
  /// Opaque parts below which sky may show.
  const FloatingParts& floating_parts() const { return floating_parts_; }
  /// All edges that can bound what is seen; none where they are many, or where there is glass.
  std::span<const SharpEdge> few_edges() const { return few_edges_; }
  Vec3 normal(std::uint32_t triangle) const;
  /// The point moved into the plane of the triangle: where a ray met it, without the rounding of
  /// its distance.
  Vec3 on_plane(std::uint32_t triangle, Vec3 point) const;
  /// Distance by which a point is lifted off a surface before rays leave it, in metres.
  double lift_m() const { return lift_m_; }

 private:
  struct Device;
  const TriangleSoup& soup_;
  const std::vector<Material>& materials_;
  MeshAdjacency adjacency_;
  double lift_m_;
  std::vector<SharpEdge> few_edges_;
  FloatingParts floating_parts_;
  std::unique_ptr<Device> device_;
};

/// Transmittance of a clear pane at the given cosine of the angle of incidence.
///
/// Source   slab with multiple reflection inside, no coherence: mean over the polarisations of
///          (1 - r) / (1 + r), r the Fresnel reflectance of one face. A pane given by its
///          transmittance at normal incidence follows the same curve of index 1.52, scaled.
double pane_transmittance(const Material& glass, double cos_incidence);

/// Specular reflectance of a pane, both its faces: what a clear pane does not let through. A pane
/// given by its transmittance is taken for float glass of index 1.52 whose rest is absorbed inside;
/// never more than is not let through.
double pane_reflectance(const Material& glass, double cos_incidence);

}  // namespace tenku
