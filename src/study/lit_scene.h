/// A scene with its light: what every calculation starts from.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/progress.h"
#include "illuminance/daylight_source.h"
#include "illuminance/sensor_grid.h"
#include "scene/read_scene.h"
#include "scene/scene.h"
#include "scene/triangle_soup.h"
#include "site/location.h"
#include "sky_models/make_sky.h"
#include "sky_models/sky_partition.h"
#include "visibility/engines.h"

namespace tenku {

/// The scene as read and as triangles, who sees what in it, the sky and the sun.
///
/// Threads  immutable after construction; may be shared.
class LitScene {
 public:
  /// Makes the sky once the scene has told where it lies.
  using SkyMaker = std::function<Sky(const std::optional<Location>& scene_site)>;

  /// @param partition  the elements of the sky, where they are asked for by hand
  /// @param gl         what draws shadow maps, if any are drawn
  /// @throws InputError, ResourceError as the readers, the partition and the ray engine do
  LitScene(const std::filesystem::path& file, const ReadOptions& options, const SkyMaker& make_sky,
           const std::optional<PartitionRequest>& partition, GlPlatform gl, Progress& progress);

  const Scene& scene() const { return scene_; }
  const TriangleSoup& soup() const { return *soup_; }
  const Engines& engines() const { return *engines_; }
  const RayVisibility& rays() const { return engines_->rays(); }
  const Sky& sky() const { return sky_; }
  const DaylightSource& source() const { return source_; }
  std::optional<Location> site() const;
  /// Of the triangles in the local frame, without the ground that tenku gave; east and north that
  /// of the place looked at, if one was given.
  Extent extent() const;
  /// The place of `ReadOptions::around`.
  const std::optional<GroundSquare>& place_looked_at() const { return place_; }

  /// Sensors given in the coordinates of the scene file, in the local frame.
  Sensors to_local(const Sensors& in_file) const;
  /// The other way round.
  Sensors to_file(const Sensors& local) const;

  /// Sensors on surfaces by the names of `--grid`: `ground`, `roofs`, `walls`, `windows`, or a
  /// surface type.
  /// The ground that tenku gave gets a wider spacing of its own. Only in the place looked at, if
  /// one was given.
  /// @throws InputError if a name is not known or nothing bears it
  SensorGrid grid(std::span<const std::string> surfaces, double spacing_m) const;

 private:
  Scene scene_;
  std::optional<GroundSquare> place_;
  std::unique_ptr<TriangleSoup> soup_;
  std::unique_ptr<Engines> engines_;
  Sky sky_;
  DaylightSource source_;
};

/// Whether a triangle counts as ground, roof or wall: its type, or its slope where the file does
/// not say.
SurfaceType broad_type(const TriangleSoup& soup, std::uint32_t triangle);

}  // namespace tenku
