/// Bubbles along lines that a mesh must follow.
#pragma once

#include <span>

#include "meshing/bubble_face.h"
#include "meshing/bubble_mesh.h"

namespace tenku {

/// Puts fixed bubbles on the parts of the segments that lie inside the outline, and pieces between
/// them. Where a segment comes nearer than a third of the size to what is there, it runs along
/// that, and its ends and crossings move by up to half the size to where a bubble is.
/// @param face  its outline, and no bubbles inside yet
/// @param most  bubbles
/// @return      length of what could not be followed, metres
double add_constraints(BubbleFace& face, std::span<const ConstraintSegment> segments,
                       std::size_t most);

}  // namespace tenku
