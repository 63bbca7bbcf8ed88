/// Which triangle the light meets first, texel by texel: a shadow map drawn by OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "visibility/gl_context.h"

namespace tenku {

/// A corner of a caster, and the number under which its triangle is to be found in the map.
struct CasterVertex {
  float x, y, z;
  std::uint32_t id;
};

/// Triangles next to each other in the vertex buffer.
struct CasterRange {
  std::uint32_t first, count;
};

/// What a map shows.
struct MapFrame {
  int width, height;  ///< texels
  /// Rows of the transformation from a local position to clip coordinates: x, y, z and a constant.
  /// The depth falls toward the light.
  std::array<std::array<float, 4>, 3> row;
};

/// Draws shadow maps with one OpenGL context.
///
/// Instead of a depth the map keeps the number of the triangle that is nearest to the light at the
/// centre of each texel, found with a depth buffer of 32-bit floats: its plane tells the depth
/// exactly, wherever it is asked. Both faces cast. What lies nearer to the light than the depth
/// range is pressed into its near end; what lies beyond its far end is left out.
///
/// Threads  one at a time.
class CasterMap {
 public:
  static constexpr std::uint32_t kNothing = 0;  ///< no caster in this texel

  /// @throws ResourceError as `GlContext`, and if the driver refuses the program
  CasterMap(GlPlatform platform, const GlLibraries& libraries);
  ~CasterMap();

  /// Sends the casters. Shape  three vertices a triangle.
  /// @throws ResourceError if the driver runs out of memory
  void upload(std::span<const CasterVertex> vertices);

  /// Numbers of the triangles nearest to the light.
  /// Shape    [row][column], the row of the least clip y first.
  /// @throws ResourceError if the driver fails
  void draw(const MapFrame& frame, std::span<const CasterRange> casters,
            std::vector<std::uint32_t>& id);

  const GlContext& context() const { return context_; }

 private:
  struct Gl;
  void resize(int width, int height);

  GlContext context_;
  std::unique_ptr<Gl> gl_;
};

}  // namespace tenku
