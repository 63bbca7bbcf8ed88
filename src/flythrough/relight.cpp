#include "flythrough/relight.h"

#include <optional>

#include "core/error.h"

namespace tenku {
namespace {

bool is_same(const StoreLighting& a, const StoreLighting& b) {
  return a.time == b.time && a.sky == b.sky && a.sun_direction == b.sun_direction;
}

/// All light of a lighting is there.
bool is_whole(const PointStore& store, std::size_t lighting) {
  for (std::size_t c = 0; c < store.chunks().size(); ++c) {
    if (!store.has_light(c, lighting)) return false;
  }
  return true;
}

/// The place of a lighting that was begun; nothing where it is new.
std::optional<std::size_t> begun(const PointStore& store, const StoreLighting& wanted,
                                 const std::string& name) {
  for (std::size_t l = 0; l < store.lightings().size(); ++l) {
    if (!is_same(store.lightings()[l], wanted)) {
      if (is_whole(store, l)) continue;
      throw InputError(name + " is not complete: finish " +
                       (l == 0 ? std::string("its first run") : store.lightings()[l].time) +
                       " first");
    }
    if (is_whole(store, l)) throw InputError(name + " has this sun and sky already");
    return l;
  }
  return std::nullopt;
}

/// Points of a chunk, off their surfaces by as much as rounding may have moved them below.
StoredPoints lifted_points(const PointStore& store, std::size_t chunk) {
  constexpr double kRounding = 1.0 / 32.0;  // of the finest footprint: more than sqrt(3) / 64
  StoredPoints points = store.points(chunk);
  const double lift = kRounding * double{store.chunks()[chunk].finest_m};
  for (std::size_t i = 0; i < points.size(); ++i) {
    points.position[i] = points.position[i] + lift * points.normal[i];
  }
  return points;
}

}  // namespace

void check_scene(const PointStore& store, const std::string& scene_sha256,
                 const std::string& store_name) {
  if (store.header().scene_sha256 == scene_sha256) return;
  throw InputError(store_name + " was made from another scene: from " + store.header().scene +
                   " with SHA-256 " + store.header().scene_sha256.substr(0, 12) +
                   ", and this one has " + scene_sha256.substr(0, 12));
}

RelightResult relight(const std::filesystem::path& file, const std::string& scene_sha256,
                      const StoreLighting& lighting, const PointLightOptions& options,
                      const Engines& engines, const DaylightSource& source, Progress& progress) {
  const PointStore store(file);
  check_scene(store, scene_sha256, file.string());
  if (store.frames_done() < store.header().path.size()) {
    throw InputError(file.string() + " is not complete: finish its first run first");
  }
  const PointLightPlan plan = plan_of(store.header().setting("light"));
  const auto former = begun(store, lighting, file.string());
  PointStoreWriter writer(file);
  RelightResult result;
  result.lighting = former ? *former : writer.add_lighting(lighting);
  result.chunks = store.chunks().size();
  result.points = store.point_count();
  progress.begin("lighting points", result.chunks);
  for (std::size_t c = 0; c < result.chunks; ++c) {
    progress.stop_if_cancelled();
    if (former && store.has_light(c, *former)) continue;
    Progress quiet;
    writer.add_light(c, result.lighting,
                     relight_points(lifted_points(store, c), store.light(c, 0), engines, source,
                                    options, plan, quiet));
    progress.advance(1);
  }
  progress.end(std::to_string(result.points) + " points");
  result.bytes = writer.bytes();
  return result;
}

}  // namespace tenku
