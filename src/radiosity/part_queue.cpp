#include "radiosity/part_queue.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

constexpr auto kLessDoubt = [](const auto& a, const auto& b) { return a.doubt < b.doubt; };

Vec3 centre_of(const std::array<Vec3, 3>& corner) {
  return (1.0 / 3.0) * (corner[0] + corner[1] + corner[2]);
}

}  // namespace

PartQueue::PartQueue(const PartTask& task, const std::vector<char>& wanted, std::uint32_t side)
    : task_(task), wanted_(wanted), side_(side), normal_(task.mesh.normal(side)) {
  std::size_t columns = 0;
  for (const Column c : task.column) {
    if (c != kNoColumn) columns = std::max<std::size_t>(columns, c + 1);
  }
  value_.resize(columns);
  error_.resize(columns);
  const auto& [a, b, c] = task.mesh.elements[side / 2];
  part_.push_back(
      make_part({task.mesh.vertices[a], task.mesh.vertices[b], task.mesh.vertices[c]}, 1.0));
  account(part_.front(), 1.0);
}

void PartQueue::refine() {
  constexpr std::size_t kPointsAPart = 3;
  for (std::size_t points = kPointsAPart; points + 2 * kPointsAPart <= task_.options.most_points;
       points += 2 * kPointsAPart) {
    if (is_done()) return;
    std::pop_heap(part_.begin(), part_.end(), kLessDoubt);
    const Part whole = std::move(part_.back());
    part_.pop_back();
    account(whole, -1.0);
    for (Part& half : halves(whole)) {
      account(half, 1.0);
      half.doubt = doubt_of(half);
      part_.push_back(std::move(half));
      std::push_heap(part_.begin(), part_.end(), kLessDoubt);
    }
  }
}

PartQueue::Part PartQueue::make_part(const std::array<Vec3, 3>& corner, double share) const {
  Part part{.corner = corner, .share = share, .row = {}, .error = {}};
  part.row = row_of(part);
  return part;
}

/// Three points, which are exact for what bends like a parabola.
SparseRow PartQueue::row_of(const Part& part) const {
  SparseRow all;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 at = 0.5 * centre_of(part.corner) + 0.5 * part.corner[k];
    for (const auto& [side, value] :
         task_.method.from_point(at + task_.method.lift_m() * normal_, normal_)) {
      if (wanted_[side] && task_.column[side] != kNoColumn) {
        all.push_back({task_.column[side], value * part.share / 3.0});
      }
    }
  }
  return sorted(std::move(all));
}

std::array<PartQueue::Part, 2> PartQueue::halves(const Part& part) const {
  std::size_t cut = 0;
  double longest = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = part.corner[(k + 1) % 3] - part.corner[k];
    const double size = part.across == Vec3{} ? length(edge) : std::abs(dot(edge, part.across));
    if (size > longest) longest = size, cut = k;
  }
  const Vec3 a = part.corner[cut], b = part.corner[(cut + 1) % 3], c = part.corner[(cut + 2) % 3];
  const Vec3 middle = 0.5 * (a + b);
  std::array<Part, 2> half{make_part({a, middle, c}, 0.5 * part.share),
                           make_part({middle, b, c}, 0.5 * part.share)};
  SparseRow change = combined(part.row, 1.0, combined(half[0].row, 1.0, half[1].row, 1.0), -1.0);
  // Of what the halves together differ by, a quarter is what each may still be wrong by.
  for (SparseEntry& entry : change) entry.value = 0.25 * std::abs(entry.value);
  for (Part& one : half) {
    one.error = change;
    add_doubt_of_edges(one);
  }
  return half;
}

void PartQueue::add_doubt_of_edges(Part& part) const {
  SparseRow all;
  double worst = 0.0;
  for (const auto& [column, value, across] :
       task_.edges.doubts(part.corner, side_, task_.options.distance_ratio, wanted_)) {
    all.push_back({column, part.share * value});
    if (value / tolerance(column) > worst) {
      worst = value / tolerance(column), part.across = across;
    }
  }
  part.error = combined(part.error, 1.0, sorted(std::move(all)), 1.0);
}

double PartQueue::tolerance(Column column) const {
  return std::max(task_.options.absolute_tolerance,
                  task_.options.relative_tolerance * value_[column]);
}

double PartQueue::doubt_of(const Part& part) const {
  double doubt = 0.0;
  for (const auto& [column, error] : part.error) {
    doubt = std::max(doubt, error / tolerance(column));
  }
  return doubt;
}

bool PartQueue::is_done() const {
  if (part_.size() == 1) return false;  // nothing is known of its error yet
  for (Column column = 0; column < error_.size(); ++column) {
    if (error_[column] > tolerance(column)) return false;
  }
  return true;
}

void PartQueue::account(const Part& part, double sense) {
  for (const auto& [column, value] : part.row) value_[column] += sense * value;
  for (const auto& [column, error] : part.error) error_[column] += sense * error;
}

SparseRow PartQueue::total_of(SparseRow Part::*what) const {
  SparseRow total;
  for (const Part& part : part_) total = combined(total, 1.0, part.*what, 1.0);
  return total;
}

}  // namespace tenku
