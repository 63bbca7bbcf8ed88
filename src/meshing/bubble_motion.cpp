#include "meshing/bubble_motion.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"

namespace tenku {
namespace {

// Of the motion, per step, with mass, damping and stiffness in one: what is left of the velocity,
// and what a force of 1 adds to it. Six neighbours at rest pull back with a stiffness of 3, and up
// to 6 where they move against one another: well below what oscillates.
constexpr double kKept = 0.6, kGained = 0.2;
constexpr double kDisorder = 0.2;      // range of the first velocities, in sizes
constexpr double kLongestStep = 0.15;  // in sizes
constexpr double kReach = 1.5;         // of the force, in mean sizes
constexpr double kNearlyAll = 1.0;     // times the mean, a way that only some exceed
constexpr double kSkin = 0.3;          // that neighbours may come nearer before they are looked up
// Nearer to a piece than this a bubble is pushed away, in sizes.
constexpr double kFromPiece = 0.8;
// Of the sizes of neighbours; where a size jumps by more, few forces are missed.
constexpr double kMostRatio = 1.5;
constexpr std::size_t kGrain = 256;

/// Lists of different lengths, one after the other.
struct Lists {
  std::vector<std::size_t> begin{0};
  std::vector<std::uint32_t> item;

  std::span<const std::uint32_t> operator[](std::size_t i) const {
    return {item.data() + begin[i], item.data() + begin[i + 1]};
  }
};

class Motion {
 public:
  explicit Motion(BubbleFace& face)
      : face_(face),
        marks_(face),
        moving_(face.at.size() - face.fixed),
        velocity_(moving_),
        next_(moving_) {
    // A little disorder, lest bubbles rest in an order that is not the best.
    for (std::size_t i = 0; i < moving_; ++i) {
      SampleRandom chance(0, i, 0);
      velocity_[i] = {kDisorder * (chance.uniform() - 0.5), kDisorder * (chance.uniform() - 0.5)};
    }
  }

  std::size_t run(std::size_t steps_most, double motion) {
    double moved = kSkin;  // by nearly all at most, since neighbours were looked up
    for (std::size_t step = 0; step < steps_most; ++step) {
      // Two may come nearer by twice that.
      if (2.0 * moved >= kSkin) look_up(), moved = 0.0;
      const double mean = move_all();
      if (mean <= motion) return step + 1;
      moved += kNearlyAll * mean;
    }
    return steps_most;
  }

 private:
  void look_up() {
    const BubbleGrid grid = all();
    const std::size_t chunks = (moving_ + kGrain - 1) / kGrain;
    near_.assign(chunks, {});
    near_pieces_.assign(chunks, {});
    parallel_for(chunks, 1, [&](IndexRange range) {
      for (std::size_t c = range.begin; c < range.end; ++c) {
        const std::size_t end = std::min(moving_, (c + 1) * kGrain);
        for (std::size_t i = c * kGrain; i < end; ++i) append_near(grid, i);
      }
    });
  }

  BubbleGrid all() const {
    BubbleGrid grid(face_.at.size(), kMostRatio);
    for (std::uint32_t i = 0; i < face_.at.size(); ++i)
      grid.insert(i, face_.at[i], face_.size_m[i]);
    return grid;
  }

  void append_near(const BubbleGrid& grid, std::size_t moving) {
    const auto i = static_cast<std::uint32_t>(face_.fixed + moving);
    const PlanePoint p = face_.at[i];
    const double size = face_.size_m[i];
    Lists& near = near_[moving / kGrain];
    grid.for_each_near(p, size, kReach + kSkin, [&](std::uint32_t j) {
      const double reach = 0.5 * (kReach + kSkin) * (size + face_.size_m[j]);
      const double dx = face_.at[j].x - p.x, dy = face_.at[j].y - p.y;
      if (j != i && dx * dx + dy * dy < reach * reach) near.item.push_back(j);
    });
    near.begin.push_back(near.item.size());
    Lists& pieces = near_pieces_[moving / kGrain];
    marks_.for_each_near(p, size, kFromPiece + kSkin, [&](std::uint32_t k) {
      const auto& [a, b, is_outline] = face_.pieces[k];
      if (distance_to_segment(p, face_.at[a], face_.at[b]) > (kFromPiece + kSkin) * size) return;
      if (pieces.item.size() > pieces.begin.back() && pieces.item.back() == k) return;
      pieces.item.push_back(k);
    });
    pieces.begin.push_back(pieces.item.size());
  }

  /// Moves all by one step.
  /// @return  root mean square of the way, in sizes
  double move_all() {
    const double squares = parallel_sum(moving_, kGrain, [&](IndexRange range) {
      double sum = 0.0;
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const double step = move(i);
        sum += step * step;
      }
      return sum;
    });
    parallel_for(moving_, kGrain, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        face_.at[face_.fixed + i] = next_[i];
        const double size = face_.size_at(next_[i]);
        if (is_size(size)) face_.size_m[face_.fixed + i] = size;
      }
    });
    return std::sqrt(squares / static_cast<double>(moving_));
  }

  /// @return  how far it goes, in sizes
  double move(std::size_t i) {
    const PlanePoint p = face_.at[face_.fixed + i];
    const double size = face_.size_m[face_.fixed + i];
    const PlanePoint force = force_on(i, p, size);
    PlanePoint& v = velocity_[i];
    v = {kKept * v.x + kGained * force.x, kKept * v.y + kGained * force.y};
    const double speed = std::sqrt(v.x * v.x + v.y * v.y);
    if (speed > kLongestStep) v = {kLongestStep / speed * v.x, kLongestStep / speed * v.y};
    next_[i] = {p.x + size * v.x, p.y + size * v.y};
    for (const std::uint32_t k : near_pieces_[i / kGrain][i % kGrain]) {
      const BubblePiece& piece = face_.pieces[k];
      if (!segments_meet(p, next_[i], face_.at[piece.a], face_.at[piece.b])) continue;
      next_[i] = p;
      v = {};
    }
    return std::min(speed, kLongestStep);
  }

  PlanePoint force_on(std::size_t i, PlanePoint p, double size) const {
    PlanePoint force;
    const auto add = [&](PlanePoint from, double stable) {
      const double dx = p.x - from.x, dy = p.y - from.y, square = dx * dx + dy * dy;
      if (!(square > 0.0) || square >= kReach * kReach * stable * stable) return;
      const double apart = std::sqrt(square), f = bubble_force(apart / stable) / apart;
      force = {force.x + f * dx, force.y + f * dy};
    };
    for (const std::uint32_t j : near_[i / kGrain][i % kGrain]) {
      add(face_.at[j], 0.5 * (size + face_.size_m[j]));
    }
    for (const std::uint32_t k : near_pieces_[i / kGrain][i % kGrain]) {
      const PlanePoint a = face_.at[face_.pieces[k].a], b = face_.at[face_.pieces[k].b];
      const double apart = distance_to_segment(p, a, b);
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      if (!(apart < kFromPiece * size) || !(length > 0.0)) continue;
      const double side = doubled_area(a, b, p) > 0.0 ? 1.0 : -1.0;
      const double f = bubble_force(apart / (kFromPiece * size));
      force = {force.x - side * f * (b.y - a.y) / length,
               force.y + side * f * (b.x - a.x) / length};
    }
    return force;
  }

  BubbleFace& face_;
  PieceMarks marks_;
  std::size_t moving_;
  std::vector<PlanePoint> velocity_;       ///< [moving] in sizes
  std::vector<PlanePoint> next_;           ///< [moving]
  std::vector<Lists> near_, near_pieces_;  ///< [kGrain of them]
};

}  // namespace

std::size_t move_bubbles(BubbleFace& face, std::size_t steps_most, double motion) {
  if (face.at.size() == face.fixed) return 0;
  return Motion(face).run(steps_most, motion);
}

}  // namespace tenku
