#include "form_factors/part_queue.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

constexpr auto kLessDoubt = [](const auto& a, const auto& b) { return a.doubt < b.doubt; };

constexpr std::size_t kPointsAPart = 4;

/// Point of a quadrilateral at u along its first edge and v along its last one, from 0 to 1.
Vec3 point_at(const std::array<Vec3, 4>& q, double u, double v) {
  return (1.0 - v) * ((1.0 - u) * q[0] + u * q[1]) + v * ((1.0 - u) * q[3] + u * q[2]);
}

/// Area for which the point stands, in parts of du dv.
double area_at(const std::array<Vec3, 4>& q, double u, double v) {
  const Vec3 along_u = (1.0 - v) * (q[1] - q[0]) + v * (q[2] - q[3]);
  const Vec3 along_v = (1.0 - u) * (q[3] - q[0]) + u * (q[2] - q[1]);
  return length(cross(along_u, along_v));
}

}  // namespace

PartQueue::PartQueue(const PartTask& task, const std::vector<char>& wanted, std::uint32_t side)
    : task_(task),
      wanted_(wanted),
      side_(side),
      normal_(task.mesh.normal(side)),
      area_m2_(task.mesh.area_m2(side / 2)) {
  std::size_t columns = 0;
  for (const Column c : task.column) {
    if (c != kNoColumn) columns = std::max<std::size_t>(columns, c + 1);
  }
  value_.resize(columns);
  error_.resize(columns);
  const Vec3 centre = task.mesh.centre(side / 2);
  const auto& corner = task.mesh.elements[side / 2];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 at = task.mesh.vertices[corner[k]];
    const Vec3 next = task.mesh.vertices[corner[(k + 1) % 3]];
    const Vec3 last = task.mesh.vertices[corner[(k + 2) % 3]];
    Part part{.corner = {at, 0.5 * (at + next), centre, 0.5 * (at + last)}, .row = {}, .error = {}};
    part.row = row_of(part.corner);
    part.doubt = 1e300;  // nothing is known of it
    push(std::move(part));
  }
}

void PartQueue::push(Part part) {
  account(part, 1.0);
  part_.push_back(std::move(part));
  std::push_heap(part_.begin(), part_.end(), kLessDoubt);
}

void PartQueue::refine() {
  for (std::size_t points = 3 * kPointsAPart;
       points + 2 * kPointsAPart <= task_.options.most_points; points += 2 * kPointsAPart) {
    if (is_done()) return;
    if (task_.options.progress != nullptr) task_.options.progress->stop_if_cancelled();
    std::pop_heap(part_.begin(), part_.end(), kLessDoubt);
    const Part whole = std::move(part_.back());
    part_.pop_back();
    account(whole, -1.0);
    for (Part& half : halves(whole)) {
      half.doubt = doubt_of(half);
      push(std::move(half));
    }
  }
}

/// Gauss's rule with two points each way.
SparseRow PartQueue::row_of(const std::array<Vec3, 4>& corner) const {
  const std::array<double, 2> node{0.5 - std::sqrt(1.0 / 12.0), 0.5 + std::sqrt(1.0 / 12.0)};
  SparseRow all;
  for (const double u : node) {
    for (const double v : node) {
      const Vec3 at = point_at(corner, u, v) + task_.method.lift_m() * normal_;
      const double share = area_at(corner, u, v) / (kPointsAPart * area_m2_);
      for (const auto& [side, value] : task_.method.from_point(at, normal_)) {
        if (wanted_[side] && task_.column[side] != kNoColumn) {
          all.push_back({task_.column[side], value * share});
        }
      }
    }
  }
  return sorted(std::move(all));
}

std::array<PartQueue::Part, 2> PartQueue::halves(const Part& part) const {
  const std::array<Vec3, 4>& q = part.corner;
  const auto size = [&](Vec3 way) {
    return part.across == Vec3{} ? length(way) : std::abs(dot(way, part.across));
  };
  const Vec3 u = point_at(q, 1.0, 0.5) - point_at(q, 0.0, 0.5);
  const Vec3 v = point_at(q, 0.5, 1.0) - point_at(q, 0.5, 0.0);
  std::array<Part, 2> half;
  if (size(u) > size(v)) {
    const Vec3 low = 0.5 * (q[0] + q[1]), high = 0.5 * (q[3] + q[2]);
    half[0].corner = {q[0], low, high, q[3]};
    half[1].corner = {low, q[1], q[2], high};
  } else {
    const Vec3 left = 0.5 * (q[0] + q[3]), right = 0.5 * (q[1] + q[2]);
    half[0].corner = {q[0], q[1], right, left};
    half[1].corner = {left, right, q[2], q[3]};
  }
  for (Part& one : half) one.row = row_of(one.corner);
  SparseRow change = combined(part.row, 1.0, combined(half[0].row, 1.0, half[1].row, 1.0), -1.0);
  // Of what the halves together differ by, a quarter is what each may still be wrong by; and as
  // they may agree by chance, some of what the whole was in doubt of.
  for (SparseEntry& entry : change) entry.value = std::abs(entry.value);
  change = combined(change, 0.25, part.error, 0.025);
  for (Part& one : half) {
    one.error = change;
    add_doubt_of_edges(one);
  }
  return half;
}

void PartQueue::add_doubt_of_edges(Part& part) const {
  SparseRow all;
  double worst = 0.0;
  const double share = area_at(part.corner, 0.5, 0.5) / area_m2_;
  for (const auto& [column, value, across] :
       task_.edges.doubts(part.corner, side_, task_.options.distance_ratio, wanted_)) {
    all.push_back({column, share * value});
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
  if (part_.front().doubt > 1e200) return false;  // nothing is known of it
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
