#include "beams/beam_tree.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <utility>

#include "beams/mirror_reflectance.h"
#include "core/error.h"
#include "core/parallel.h"
#include "visibility/ray_visibility.h"

namespace tenku {
namespace {

/// Time of a face that is projected and clipped, in those of one that is held against a line.
constexpr std::uint64_t kProjection = 16;
constexpr double kOnMirror = 1e-9;  ///< metres off its plane per metre of the scene's extent

/// A part of the window that a beam is to be followed through.
struct Task {
  WindowPolygon window;
  std::uint32_t beam;
  double most_share;  ///< of a pixel's light that it can carry
};

class Tracer {
 public:
  Tracer(const BeamFaces& faces, const BeamOptions& options) : faces_(faces), options_(options) {}

  /// @param work  that may still be done
  Division divide(const BeamTree& tree, const Task& task, std::uint64_t work) const {
    const Beam& beam = tree.beams[task.beam];
    const DivisionOptions how{beam.depth >= options_.told_from, options_.slack,
                              options_.most_regions, work};
    const std::vector<std::uint32_t> near = near_faces(beam, task.window);
    const std::uint64_t projection = kProjection * near.size();
    if (projection > work) return {{}, projection};
    Division made = divide_window(task.window, seen_faces(beam, near, task.window), how);
    made.work += projection;
    return made;
  }

 private:
  /// The mirror's plane, its front towards what it shows.
  Plane front_of(const Beam& beam) const {
    const Plane plane = faces_[beam.mirror].plane;
    // The mirrored apex is behind the mirror.
    return beam.view.apex_height(plane) < 0.0 ? plane : Plane{-plane.normal, -plane.offset};
  }

  /// Before the mirror; a wall in the plane of a window is seen behind it.
  Plane near_plane(const Beam& beam) const {
    Plane front = front_of(beam);
    if (beam.is_through) front.offset -= 2.0 * on_mirror_m();
    return front;
  }

  std::vector<std::uint32_t> near_faces(const Beam& beam, const WindowPolygon& window) const {
    std::vector<Plane> sides;
    for (const WindowPolygon::Corner& c : window.corners()) {
      sides.push_back(beam.view.through(c.edge.a, c.edge.b, c.edge.c));
    }
    if (beam.mirror != kNoFace) {
      sides.push_back(near_plane(beam));
    } else if (beam.view.is_point()) {
      sides.push_back(beam.view.through(0.0, 0.0, 1.0));
    }
    return faces_.tree().before(sides);
  }

  std::vector<SeenFace> seen_faces(const Beam& beam, const std::vector<std::uint32_t>& near,
                                   const WindowPolygon& window) const {
    const bool is_first = beam.mirror == kNoFace;
    const Plane front = is_first ? Plane{} : near_plane(beam);
    std::vector<SeenFace> seen;
    for (const std::uint32_t f : near) {
      if (!is_first && !reaches_before(faces_[f], front)) continue;
      if (beam.is_through && faces_[f].is_pane && !reaches_before(faces_[f], front_of(beam))) {
        continue;
      }
      const Nearness nearness = beam.view.nearness(faces_[f].plane);
      if (!is_seen_flat(beam.view, faces_[f].plane)) continue;
      WindowPolygon outline = seen_in_window(beam.view, faces_[f].corners,
                                             is_first ? nullptr : &front, window, options_.slack);
      if (!outline.empty()) {
        seen.push_back({f, faces_[f].is_mirror, nearness, std::move(outline), faces_[f].is_pane});
      }
    }
    return seen;
  }

  bool reaches_before(const BeamFace& face, const Plane& front) const {
    return std::any_of(face.corners.begin(), face.corners.end(),
                       [&](Vec3 p) { return front.height(p) > on_mirror_m(); });
  }

  double on_mirror_m() const { return kOnMirror * faces_.extent_m(); }

  /// Not edge-on.
  bool is_seen_flat(const BeamView& view, const Plane& plane) const {
    constexpr double kRounding = 1e-12;
    const double scale = view.is_point() ? faces_.extent_m() : 1.0;
    return std::abs(view.apex_height(plane)) > kRounding * scale;
  }

  const BeamFaces& faces_;
  const BeamOptions& options_;
};

/// Turns the parts into which tasks were divided into regions and new tasks.
class Gatherer {
 public:
  Gatherer(const BeamFaces& faces, int depth, BeamTree& tree)
      : faces_(faces), depth_(depth), tree_(tree) {}

  void gather(const Task& task, std::vector<WindowPart> parts, std::vector<Task>& next) {
    child_.clear();
    for (WindowPart& part : parts) {
      const bool is_pane = part.face < kUndivided && faces_[part.face].is_pane;
      const Beam parent = tree_.beams[task.beam];
      if (is_pane && parent.panes < kMostPanes) {
        split(task, part, next);
      } else if (!is_pane && part.face < kUndivided && faces_[part.face].is_mirror &&
                 parent.depth < depth_) {
        next.push_back({window_of(part.corners), child_of(task.beam, part.face, false),
                        task.most_share * most_mirrored(parent, part)});
      } else {
        tree_.regions.push_back(
            {std::move(part.corners), task.beam, is_pane ? kUndivided : part.face});
      }
    }
  }

 private:
  void split(const Task& task, const WindowPart& part, std::vector<Task>& next) {
    const Beam parent = tree_.beams[task.beam];
    const double mirrored = task.most_share * most_mirrored(parent, part);
    if (parent.depth < depth_ && mirrored > (1.0 - kRounding) * kLeastShare) {
      next.push_back({window_of(part.corners), child_of(task.beam, part.face, false), mirrored});
    }
    const double upright = pane_transmittance(faces_.material_of(faces_[part.face]), 1.0);
    next.push_back(
        {window_of(part.corners), child_of(task.beam, part.face, true), task.most_share * upright});
  }

  /// Largest reflectance in a part of the window. It falls with the cosine of incidence, which is
  /// least at a corner: where it is above a value is a cone, and convex.
  double most_mirrored(const Beam& beam, const WindowPart& part) const {
    const BeamFace& face = faces_[part.face];
    double most = 0.0;
    for (const WindowPoint p : part.corners) {
      const double cosine = std::abs(dot(face.plane.normal, normalized(beam.view.direction(p))));
      most = std::max(most, luminance_of(mirror_reflectance(faces_.material_of(face), cosine)));
    }
    return most;
  }

  std::uint32_t child_of(std::uint32_t beam, std::uint32_t face, bool is_through) {
    const auto [at, is_new] =
        child_.emplace(std::pair(face, is_through), static_cast<std::uint32_t>(tree_.beams.size()));
    if (!is_new) return at->second;
    Beam child = tree_.beams[beam];
    child.parent = beam;
    child.mirror = face;
    child.is_through = is_through;
    if (!is_through) {
      child.view = child.view.behind(faces_[face].plane);
      ++child.depth;
    }
    if (faces_[face].is_pane) {
      if (!is_through) child.layer = layer_after(child.layer, child.panes);
      ++child.panes;
    }
    tree_.beams.push_back(child);
    return at->second;
  }

  /// The layer of what a pane mirrors that is met in a layer after so many panes.
  std::uint32_t layer_after(std::uint32_t layer, int panes) {
    const auto [at, is_new] = layers_.emplace(std::pair(layer, panes), tree_.layers);
    if (is_new) ++tree_.layers;
    return at->second;
  }

  static constexpr double kRounding = 1e-6;
  const BeamFaces& faces_;
  int depth_;
  BeamTree& tree_;
  std::map<std::pair<std::uint32_t, bool>, std::uint32_t> child_;  ///< of the task at hand
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> layers_;
};

}  // namespace

std::vector<std::uint32_t> BeamTree::way_to(std::uint32_t beam) const {
  std::vector<std::uint32_t> way;
  for (; beams[beam].mirror != kNoFace; beam = beams[beam].parent) way.push_back(beam);
  std::reverse(way.begin(), way.end());
  return way;
}

std::vector<std::uint32_t> BeamTree::chain(std::uint32_t beam) const {
  std::vector<std::uint32_t> mirrors = way_to(beam);
  for (std::uint32_t& at : mirrors) at = beams[at].mirror;
  return mirrors;
}

BeamTree trace_beams(const BeamFaces& faces, const BeamView& view,
                     std::span<const WindowPoint> window, const BeamOptions& options,
                     Progress& progress) {
  if (options.depth < 0) throw InputError("the depth of reflection must not be negative");
  const WindowPolygon whole = window_of(window);
  if (!(whole.area() > 0.0)) throw InputError("the window of the beams has no area");
  BeamTree tree;
  tree.beams.push_back({view});
  std::vector<Task> tasks{{whole, 0, 1.0}};
  Gatherer gatherer(faces, options.depth, tree);
  const Tracer tracer(faces, options);
  while (!tasks.empty()) {
    std::vector<Division> made(tasks.size());
    std::atomic<std::size_t> count{tree.regions.size()};
    std::atomic<std::uint64_t> work{tree.work};
    parallel_for(tasks.size(), 1, [&](IndexRange range) {
      for (std::size_t k = range.begin; k < range.end; ++k) {
        progress.stop_if_cancelled();
        const std::uint64_t done = work;
        if (count > options.most_regions || done > options.most_work) return;
        made[k] = tracer.divide(tree, tasks[k], options.most_work - done);
        count += made[k].parts.size();
        work += made[k].work;
      }
    });
    tree.queries += tasks.size();
    tree.work = work;
    if (count > options.most_regions || work > options.most_work) {
      tree.is_complete = false;
      return tree;
    }
    std::vector<Task> next;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      gatherer.gather(tasks[k], std::move(made[k].parts), next);
    }
    tasks = std::move(next);
  }
  return tree;
}

std::vector<Vec3> corners_on_face(const BeamTree& tree, const BeamRegion& region,
                                  const BeamFaces& faces) {
  std::vector<Vec3> corners;
  const BeamView& view = tree.beams[region.beam].view;
  for (const WindowPoint p : region.corners) {
    corners.push_back(view.on_plane(faces[region.end].plane, p));
  }
  return corners;
}

}  // namespace tenku
