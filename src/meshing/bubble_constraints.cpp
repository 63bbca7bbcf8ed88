#include "meshing/bubble_constraints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "meshing/bubble_edges.h"
#include "scene/constrained_delaunay.h"
#include "scene/scene.h"

namespace tenku {
namespace {

// In sizes: a bubble nearer to another than this is that one, and nearer to a piece than this lies
// at one of its ends.
constexpr double kSameBubble = 0.5, kSamePiece = 0.35;
constexpr double kBeside = 0.15;  // of a piece's length: nearer to it, a bubble parts it
// Bubbles on a line that runs beside another are up to so much smaller, and as many gaps wide:
// kept apart from those on the other.
constexpr double kLeastBeside = 0.5, kPerGap = 1.6;
constexpr double kSlanted = 0.5;  // sine: lines that part faster do not run beside one another
constexpr double kSameLine = 1e-6;

PlanePoint between(PlanePoint a, PlanePoint b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}
double distance(PlanePoint a, PlanePoint b) { return std::hypot(b.x - a.x, b.y - a.y); }
std::array<double, 2> pair_of(PlanePoint p) { return {p.x, p.y}; }

class ConstraintAdder {
 public:
  ConstraintAdder(BubbleFace& face, std::span<const ConstraintSegment> segments, std::size_t most)
      : face_(face), lines_(segments.begin(), segments.end()), most_(most) {
    for (const auto& piece : face.pieces) {
      edges_.insert(std::minmax(piece.a, piece.b));
      lines_.push_back({face.at[piece.a], face.at[piece.b]});
    }
  }

  double add(const ConstraintSegment& s) {
    const double long_m = distance(s.a, s.b);
    if (!(long_m > 0.0 && std::isfinite(long_m))) return 0.0;
    double lost_m = 0.0;
    std::vector<double> cuts = crossings(s);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (cuts[i + 1] > cuts[i] && is_inside(between(s.a, s.b, 0.5 * (cuts[i] + cuts[i + 1])))) {
        lost_m += add_part({between(s.a, s.b, cuts[i]), between(s.a, s.b, cuts[i + 1])});
      }
    }
    return lost_m;
  }

 private:
  /// Where the segment meets pieces, as fractions of it, and its ends.
  std::vector<double> crossings(const ConstraintSegment& s) const {
    std::vector<double> cuts{0.0, 1.0};
    for (const auto& piece : face_.pieces) {
      const PlanePoint a = face_.at[piece.a], b = face_.at[piece.b];
      if (!segments_meet(s.a, s.b, a, b)) continue;
      const double a_side = doubled_area(s.a, s.b, a), b_side = doubled_area(s.a, s.b, b);
      const double from = doubled_area(a, b, s.a), to = doubled_area(a, b, s.b);
      if (a_side != b_side && from != to) cuts.push_back(std::clamp(from / (from - to), 0.0, 1.0));
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts;
  }

  bool is_inside(PlanePoint p) const {
    bool is_in = false;
    for (const auto& piece : face_.pieces) {
      if (!piece.is_outline) continue;
      const PlanePoint a = face_.at[piece.a], b = face_.at[piece.b];
      if ((a.y <= p.y) == (b.y <= p.y)) continue;
      if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) is_in = !is_in;
    }
    return is_in;
  }

  /// To the nearest line that runs beside `s` and is not a part of the same, up to `most`.
  double gap(const ConstraintSegment& s, PlanePoint p, double most) const {
    const double long_m = distance(s.a, s.b);
    double least = most;
    for (const ConstraintSegment& line : lines_) {
      const double d = distance_to_segment(p, line.a, line.b);
      if (!(d < least)) continue;
      const double a_off = doubled_area(s.a, s.b, line.a) / long_m,
                   b_off = doubled_area(s.a, s.b, line.b) / long_m;
      const bool is_beside = std::abs(a_off - b_off) < kSlanted * distance(line.a, line.b),
                 is_same = std::abs(a_off) + std::abs(b_off) < kSameLine * long_m;
      if (is_beside && !is_same) least = d;
    }
    return least;
  }

  double size_on(const ConstraintSegment& s, PlanePoint p) const {
    const double size = face_.size_at(p);
    if (!is_size(size)) return size;
    return std::clamp(kPerGap * gap(s, p, size), kLeastBeside * size, size);
  }

  double add_part(const ConstraintSegment& part) {
    const double long_m = distance(part.a, part.b);
    const auto place = [&](double t) { return between(part.a, part.b, t); };
    ChainAnswer chain = bubble_chain(
        long_m, [&](double at_m) { return size_on(part, place(at_m / long_m)); }, most_);
    if (chain.refusal || face_.at.size() + chain.at.size() > most_) return long_m;
    chain.at.insert(chain.at.begin(), 0.0);
    chain.at.push_back(1.0);
    std::uint32_t last = kNone;
    double lost_m = 0.0;
    for (const double t : chain.at) {
      const std::uint32_t next = bubble_at(place(t), size_on(part, place(t)));
      if (next != kNone && last != kNone && next != last) lost_m += add_piece(last, next);
      if (next != kNone) last = next;
    }
    return lost_m;
  }

  /// The bubble that is there, or at the end of a piece that is there, or a new one.
  std::uint32_t bubble_at(PlanePoint p, double size) {
    if (!is_size(size)) return kNone;
    std::uint32_t nearest = kNone;
    double least = kSameBubble * size;
    for (std::uint32_t i = 0; i < face_.at.size(); ++i) {
      if (const double d = distance(p, face_.at[i]); d < least) nearest = i, least = d;
    }
    if (nearest != kNone) return nearest;
    least = kSamePiece * size;
    for (const auto& piece : face_.pieces) {
      const PlanePoint a = face_.at[piece.a], b = face_.at[piece.b];
      const double d = distance_to_segment(p, a, b);
      if (d < least) nearest = distance(p, a) <= distance(p, b) ? piece.a : piece.b, least = d;
    }
    return nearest != kNone ? nearest : face_.add(p, size);
  }

  /// Adds a piece, through bubbles that lie beside it: it would make flat triangles with them.
  /// @return  length of what would cross what is there
  double add_piece(std::uint32_t a, std::uint32_t b, int depth = 0) {
    const PlanePoint p = face_.at[a], q = face_.at[b];
    if (edges_.contains(std::minmax(a, b))) return 0.0;
    const std::uint32_t beside = bubble_beside(a, b);
    if (beside != kNone) {
      constexpr int kDeepest = 8;
      if (depth == kDeepest) return distance(p, q);
      return add_piece(a, beside, depth + 1) + add_piece(beside, b, depth + 1);
    }
    edges_.insert(std::minmax(a, b));
    const bool is_crossed =
        std::any_of(face_.pieces.begin(), face_.pieces.end(), [&](const BubblePiece& piece) {
          const PlanePoint r = face_.at[piece.a], s = face_.at[piece.b];
          return segments_cross(pair_of(p), pair_of(q), pair_of(r), pair_of(s));
        });
    if (is_crossed) return distance(p, q);
    face_.pieces.push_back({a, b, false});
    return 0.0;
  }

  /// The bubble nearest to the piece from `a` to `b`, if it is too near.
  std::uint32_t bubble_beside(std::uint32_t a, std::uint32_t b) const {
    std::uint32_t nearest = kNone;
    double least = kBeside * distance(face_.at[a], face_.at[b]);
    for (std::uint32_t i = 0; i < face_.at.size(); ++i) {
      if (i == a || i == b) continue;
      const double d = distance_to_segment(face_.at[i], face_.at[a], face_.at[b]);
      if (d < least) nearest = i, least = d;
    }
    return nearest;
  }

  BubbleFace& face_;
  std::vector<ConstraintSegment> lines_;  ///< and the outline
  std::size_t most_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges_;
};

}  // namespace

double add_constraints(BubbleFace& face, std::span<const ConstraintSegment> segments,
                       std::size_t most) {
  ConstraintAdder adder(face, segments, most);
  double lost_m = 0.0;
  for (const ConstraintSegment& s : segments) lost_m += adder.add(s);
  face.fixed = face.at.size();
  return lost_m;
}

}  // namespace tenku
