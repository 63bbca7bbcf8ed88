/// Beams through mirrors: the regions of a window whose rays meet the same faces.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "beams/beam_faces.h"
#include "beams/beam_view.h"
#include "beams/window_division.h"
#include "core/progress.h"

namespace tenku {

/// Shares of a pixel's light below which a pane's mirrored branch is not followed.
inline constexpr double kLeastShare = 1e-4;

/// Panes met by one way after which no more mirror.
inline constexpr int kMostPanes = 32;

/// One chain of mirrors. The first beam has met none; every other continues its parent behind one
/// more mirror, or through a pane.
struct Beam {
  BeamView view;                   ///< the window as seen by way of the chain
  std::uint32_t parent = 0;        ///< of `BeamTree::beams`; the first is its own
  std::uint32_t mirror = kNoFace;  ///< face by which it left its parent
  int depth = 0;                   ///< mirrors met, panes that mirrored among them
  int panes = 0;                   ///< that mirrored or were looked through
  bool is_through = false;         ///< `mirror` is a pane and looked through
  std::uint32_t layer = 0;         ///< equal for beams whose rays were mirrored by the same panes
                                   ///< in the same places of their chain; 0: by none
};

/// A convex part of the window whose rays meet the same mirrors and end at the same face.
struct BeamRegion {
  std::vector<WindowPoint> corners;  ///< counter-clockwise in (u, v)
  std::uint32_t beam = 0;            ///< of `BeamTree::beams`
  std::uint32_t end = kNoFace;       ///< the face it ends at; `kNoFace`: the background;
                                     ///< `kUndivided`: faces that were not told apart, or none.
                                     ///< A mirror where the depth is reached
};

/// What to trace.
struct BeamOptions {
  int depth = 4;        ///< mirrors in a row
  int told_from = 0;    ///< beams of fewer mirrors end at mirrors, the background or `kUndivided`;
                        ///< those of as many or more at every face
  double slack = 1e-7;  ///< width below which nothing is seen, in units of the window
  std::size_t most_regions = 1'000'000;
  std::uint64_t most_work = std::numeric_limits<std::uint64_t>::max();  ///< see `BeamTree`
};

/// The regions of a window.
struct BeamTree {
  std::vector<Beam> beams;
  std::vector<BeamRegion> regions;  ///< in an order that is always the same. Those of one layer do
                                    ///< not overlap, and layer 0 leaves no gap: where a pane both
                                    ///< mirrors and is looked through there is one of each
  std::uint32_t layers = 1;
  bool is_complete = true;    ///< false: there are more than `most_regions`, or it takes more than
                              ///< `most_work`
  std::uint64_t queries = 0;  ///< walks through the tree of boxes
  std::uint64_t work = 0;     ///< what its time goes by: faces held against a line, 0.13 us each on
                              ///< a processor of 2020, and sixteen times that for those projected

  /// The beams that lead to a beam, itself the last, without the first of all.
  [[nodiscard]] std::vector<std::uint32_t> way_to(std::uint32_t beam) const;

  /// The mirrors and panes that a beam has met, the first first.
  [[nodiscard]] std::vector<std::uint32_t> chain(std::uint32_t beam) const;
};

/// Follows beams from an apex through the mirrors of a scene.
///
/// The window is divided by what is seen in it; the parts that end at a mirror are divided again,
/// as seen from the mirrored apex, without ever leaving the window's coordinates. Polygons are cut
/// by lines; nothing is sampled, so that no mirror is too small to be found.
///
/// A pane's part of the window goes on twice: mirrored, where that carries `kLeastShare` or more,
/// and straight on with what is behind the pane.
///
/// Both sides of a mirror reflect. A face that is seen edge-on has no part of the window. In what a
/// mirror shows, only what is before the mirror's plane counts.
///
/// @param view    the apex: a camera's eye, or the direction of the sun
/// @param window  convex, in either sense; every ray of interest starts in it. For a point apex all
///                of it must be in front (see `Homogeneous`)
/// @throws InputError  if the depth is negative or the window has less than three corners
/// @throws Cancelled   as `progress` says
/// Threads  the same result for any number of threads
BeamTree trace_beams(const BeamFaces& faces, const BeamView& view,
                     std::span<const WindowPoint> window, const BeamOptions& options,
                     Progress& progress);

/// Where the rays of a region's corners meet the face that it ends at: a polygon of space.
std::vector<Vec3> corners_on_face(const BeamTree& tree, const BeamRegion& region,
                                  const BeamFaces& faces);

}  // namespace tenku
