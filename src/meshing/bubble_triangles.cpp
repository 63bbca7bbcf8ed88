#include "meshing/bubble_triangles.h"

#include <algorithm>
#include <cmath>

#include "meshing/bubble_place.h"
#include "scene/constrained_delaunay.h"

namespace tenku {
namespace {

// In sizes. Edges are 1 and radii 0.58 where bubbles touch.
constexpr double kCrowded = 0.68, kWide = 0.8, kLow = 0.4, kClear = 0.65;

double distance(PlanePoint a, PlanePoint b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// Centre of the circle through three points.
PlanePoint circumcentre(PlanePoint a, PlanePoint b, PlanePoint c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double d = 2.0 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return {a.x + (cy * b2 - by * c2) / d, a.y + (bx * c2 - cx * b2) / d};
}

/// Takes bubbles out that are crowded by others.
class Thinner {
 public:
  Thinner(BubbleFace& face, const BubbleTriangles& mesh)
      : face_(face), mesh_(mesh), is_out_(face.at.size()) {}

  std::size_t thin() {
    for (std::size_t i = face_.fixed; i < face_.at.size(); ++i) is_out_[i] = mesh_.is_used[i] == 0;
    for (const auto& t : mesh_.triangles) {
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t a = t.corner[(k + 1) % 3], b = t.corner[(k + 2) % 3];
        check_edge(a, b);
        if (t.is_piece[k]) check_height(t.corner[k], a, b);
      }
    }
    return take_out();
  }

 private:
  void check_edge(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t later = std::max(a, b);
    if (later < face_.fixed || is_out_[a] != 0 || is_out_[b] != 0) return;
    const double crowded = kCrowded * 0.5 * (face_.size_m[a] + face_.size_m[b]);
    if (distance(face_.at[a], face_.at[b]) < crowded) is_out_[later] = 1;
  }
  void check_height(std::uint32_t top, std::uint32_t a, std::uint32_t b) {
    if (top < face_.fixed) return;
    const double height = distance_to_segment(face_.at[top], face_.at[a], face_.at[b]);
    if (height < kLow * face_.size_m[top]) is_out_[top] = 1;
  }
  std::size_t take_out() {
    std::size_t left = face_.fixed;
    for (std::size_t i = face_.fixed; i < face_.at.size(); ++i) {
      if (is_out_[i] != 0) continue;
      face_.at[left] = face_.at[i];
      face_.size_m[left++] = face_.size_m[i];
    }
    const std::size_t out = face_.at.size() - left;
    face_.at.resize(left);
    face_.size_m.resize(left);
    return out;
  }

  BubbleFace& face_;
  const BubbleTriangles& mesh_;
  std::vector<std::uint8_t> is_out_;
};

/// From where to where a bubble is to be put.
struct Gap {
  PlanePoint from, to;
};

std::vector<Gap> wide_gaps(const BubbleFace& face, const BubbleTriangles& mesh) {
  std::vector<Gap> gaps;
  for (const auto& t : mesh.triangles) {
    const PlanePoint a = face.at[t.corner[0]], b = face.at[t.corner[1]], c = face.at[t.corner[2]];
    const PlanePoint centre = circumcentre(a, b, c);
    const double radius = distance(a, centre);
    const PlanePoint middle{(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0};
    if (!(radius > kWide * face.size_at(middle)) || !std::isfinite(radius)) continue;
    gaps.push_back({middle, centre});
  }
  return gaps;
}

}  // namespace

std::optional<BubbleTriangles> triangulate(const BubbleFace& face) {
  ConstrainedDelaunay mesh;
  std::vector<std::uint32_t> vertex(face.at.size()), bubble;
  for (std::uint32_t i = 0; i < face.at.size(); ++i) {
    vertex[i] = mesh.insert(face.at[i].x, face.at[i].y);
    if (vertex[i] == bubble.size()) bubble.push_back(i);
    if (i + 1 != face.fixed) continue;
    for (const auto& [a, b, is_outline] : face.pieces) {
      if (is_outline) {
        mesh.keep_bound(vertex[a], vertex[b]);
      } else {
        mesh.keep_line(vertex[a], vertex[b]);
      }
    }
  }
  if (mesh.size() != bubble.size()) return std::nullopt;
  BubbleTriangles made;
  made.is_used.assign(face.at.size(), 0);
  for (const auto& [corner, is_kept] : mesh.inside()) {
    made.triangles.push_back({{bubble[corner[0]], bubble[corner[1]], bubble[corner[2]]}, is_kept});
    for (const std::uint32_t i : made.triangles.back().corner) made.is_used[i] = 1;
  }
  return made;
}

std::size_t correct_population(BubbleFace& face, const BubbleTriangles& mesh) {
  const std::vector<Gap> gaps = wide_gaps(face, mesh);
  const std::size_t out = Thinner(face, mesh).thin();
  if (gaps.empty()) return out;
  const std::size_t before = face.at.size();
  BubblePlacer placer(face, before + gaps.size());
  for (const Gap& gap : gaps) placer.add_if_free(gap.from, gap.to, kClear);
  return out + face.at.size() - before;
}

}  // namespace tenku
