#include "beams/beam_tree.h"

#include <algorithm>
#include <atomic>
#include <map>

#include "core/error.h"
#include "core/parallel.h"

namespace tenku {
namespace {

constexpr double kOnMirror = 1e-9;  ///< metres off its plane per metre of the scene's extent

/// A part of the window that a beam is to be followed through.
struct Task {
  WindowPolygon window;
  std::uint32_t beam;
};

class Tracer {
 public:
  Tracer(const BeamFaces& faces, const BeamOptions& options) : faces_(faces), options_(options) {}

  std::vector<WindowPart> divide(const BeamTree& tree, const Task& task) const {
    const Beam& beam = tree.beams[task.beam];
    const DivisionOptions how{beam.depth >= options_.told_from, options_.slack,
                              options_.most_regions};
    return divide_window(task.window, seen_faces(beam, task.window), how);
  }

 private:
  /// The mirror's plane, its front towards what it shows.
  Plane front_of(const Beam& beam) const {
    const Plane plane = faces_[beam.mirror].plane;
    // The mirrored apex is behind the mirror.
    return beam.view.apex_height(plane) < 0.0 ? plane : Plane{-plane.normal, -plane.offset};
  }

  std::vector<SeenFace> seen_faces(const Beam& beam, const WindowPolygon& window) const {
    std::vector<Plane> sides;
    for (const WindowPolygon::Corner& c : window.corners()) {
      sides.push_back(beam.view.through(c.edge.a, c.edge.b, c.edge.c));
    }
    const bool is_first = beam.mirror == kNoFace;
    Plane front;
    if (!is_first) {
      front = front_of(beam);
      sides.push_back(front);
    } else if (beam.view.is_point()) {
      sides.push_back(beam.view.through(0.0, 0.0, 1.0));
    }
    std::vector<SeenFace> seen;
    for (const std::uint32_t f : faces_.tree().before(sides)) {
      if (!is_first && !reaches_before(faces_[f], front)) continue;
      const Nearness nearness = beam.view.nearness(faces_[f].plane);
      if (!is_seen_flat(beam.view, faces_[f].plane)) continue;
      WindowPolygon outline = seen_in_window(beam.view, faces_[f].corners,
                                             is_first ? nullptr : &front, window, options_.slack);
      if (!outline.empty()) {
        seen.push_back({f, faces_[f].is_mirror, nearness, std::move(outline)});
      }
    }
    return seen;
  }

  bool reaches_before(const BeamFace& face, const Plane& front) const {
    const double least = kOnMirror * faces_.extent_m();
    return std::any_of(face.corners.begin(), face.corners.end(),
                       [&](Vec3 p) { return front.height(p) > least; });
  }

  /// Not edge-on.
  bool is_seen_flat(const BeamView& view, const Plane& plane) const {
    constexpr double kRounding = 1e-12;
    const double scale = view.is_point() ? faces_.extent_m() : 1.0;
    return std::abs(view.apex_height(plane)) > kRounding * scale;
  }

  const BeamFaces& faces_;
  const BeamOptions& options_;
};

/// Adds what the division of a task gave; the parts that go on behind a mirror become tasks.
void gather(const BeamFaces& faces, const Task& task, std::vector<WindowPart> parts, int depth,
            BeamTree& tree, std::vector<Task>& next) {
  std::map<std::uint32_t, std::uint32_t> child;  // mirror -> beam
  for (WindowPart& part : parts) {
    const bool goes_on =
        part.face < kUndivided && faces[part.face].is_mirror && tree.beams[task.beam].depth < depth;
    if (!goes_on) {
      tree.regions.push_back({std::move(part.corners), task.beam, part.face});
      continue;
    }
    const auto [at, is_new] =
        child.emplace(part.face, static_cast<std::uint32_t>(tree.beams.size()));
    if (is_new) {
      const Beam& parent = tree.beams[task.beam];
      tree.beams.push_back(
          {parent.view.behind(faces[part.face].plane), task.beam, part.face, parent.depth + 1});
    }
    next.push_back({window_of(part.corners), at->second});
  }
}

}  // namespace

std::vector<std::uint32_t> BeamTree::chain(std::uint32_t beam) const {
  std::vector<std::uint32_t> mirrors;
  for (; beams[beam].depth > 0; beam = beams[beam].parent) mirrors.push_back(beams[beam].mirror);
  std::reverse(mirrors.begin(), mirrors.end());
  return mirrors;
}

BeamTree trace_beams(const BeamFaces& faces, const BeamView& view,
                     std::span<const WindowPoint> window, const BeamOptions& options,
                     Progress& progress) {
  if (options.depth < 0) throw InputError("the depth of reflection must not be negative");
  const WindowPolygon whole = window_of(window);
  if (!(whole.area() > 0.0)) throw InputError("the window of the beams has no area");
  BeamTree tree;
  tree.beams.push_back({view, 0, kNoFace, 0});
  std::vector<Task> tasks{{whole, 0}};
  const Tracer tracer(faces, options);
  while (!tasks.empty()) {
    std::vector<std::vector<WindowPart>> parts(tasks.size());
    std::atomic<std::size_t> count{tree.regions.size()};
    parallel_for(tasks.size(), 1, [&](IndexRange range) {
      for (std::size_t k = range.begin; k < range.end; ++k) {
        progress.stop_if_cancelled();
        if (count > options.most_regions) return;
        parts[k] = tracer.divide(tree, tasks[k]);
        count += parts[k].size();
      }
    });
    tree.queries += tasks.size();
    if (count > options.most_regions) {
      tree.is_complete = false;
      return tree;
    }
    std::vector<Task> next;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      gather(faces, tasks[k], std::move(parts[k]), options.depth, tree, next);
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
