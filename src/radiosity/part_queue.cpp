#include "radiosity/part_queue.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

constexpr auto kLessDoubt = [](const auto& a, const auto& b) { return a.doubt < b.doubt; };

Vec3 centre_of(const std::array<Vec3, 3>& corner) {
  return (1.0 / 3.0) * (corner[0] + corner[1] + corner[2]);
}

double extent_along(const std::array<Vec3, 3>& corner, Vec3 direction) {
  const auto [low, high] = std::minmax(
      {dot(corner[0], direction), dot(corner[1], direction), dot(corner[2], direction)});
  return high - low;
}

/// Nearest point to `point` on the edge from `a` to `b`.
Vec3 nearest_on_edge(Vec3 point, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double at = dot(point - a, along) / dot(along, along);
  return a + std::clamp(at, 0.0, 1.0) * along;
}

}  // namespace

PartQueue::PartQueue(const FormFactorMethod& method, const ElementMesh& mesh,
                     const PatchFormFactorOptions& options, const std::vector<char>& wanted,
                     std::uint32_t side)
    : method_(method),
      mesh_(mesh),
      options_(options),
      wanted_(wanted),
      side_(side),
      normal_(mesh.normal(side)),
      value_(mesh.sides()),
      error_(mesh.sides()) {
  const auto& [a, b, c] = mesh.elements[side / 2];
  part_.push_back(make_part({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, 1.0));
  account(part_.front(), 1.0);
}

void PartQueue::refine() {
  constexpr std::size_t kPointsAPart = 3;
  for (std::size_t points = kPointsAPart; points + 2 * kPointsAPart <= options_.most_points;
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
  SparseRow sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 at = 0.5 * centre_of(part.corner) + 0.5 * part.corner[k];
    SparseRow row;
    for (const auto& [side, value] : method_.from_point(at + method_.lift_m() * normal_, normal_)) {
      if (wanted_[side]) row.push_back({side, value});
    }
    sum = combined(sum, 1.0, row, part.share / 3.0);
  }
  return sum;
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

/// Where an edge is nearer than the rule allows, what its element could at most cover may have
/// been missed, or counted in vain, by some of the part.
void PartQueue::add_doubt_of_edges(Part& part) const {
  constexpr double kSome = 0.1;
  const Vec3 centre = centre_of(part.corner);
  double worst = 0.0;
  SparseRow doubt;
  for (std::uint32_t e = 0; e < mesh_.size(); ++e) {
    if (e == side_ / 2 || !(wanted_[2 * e] || wanted_[2 * e + 1])) continue;
    const Vec3 normal = mesh_.normal(2 * e);
    const double height = dot(centre - mesh_.vertices[mesh_.elements[e][0]], normal);
    const std::uint32_t seen = 2 * e + (height < 0.0 ? 1 : 0);
    if (!wanted_[seen]) continue;
    double nearest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh_.vertices[mesh_.elements[e][k]];
      const Vec3 b = mesh_.vertices[mesh_.elements[e][(k + 1) % 3]];
      const Vec3 to = nearest_on_edge(centre, a, b) - centre;
      const double distance = length(to);
      Vec3 across = to - dot(to, normal_) * normal_;
      if (length(across) < 0.1 * distance) across = cross(normal_, b - a);
      across = normalized(across);
      const double extent = extent_along(part.corner, across);
      if (!(extent * options_.distance_ratio > distance)) continue;
      const double could =
          part.share * std::min(1.0, mesh_.area_m2(e) / (kPi * distance * distance));
      nearest = std::max(nearest, kSome * could);
      if (could > worst) worst = could, part.across = across;
    }
    if (nearest > 0.0) doubt.push_back({seen, nearest});
  }
  part.error = combined(part.error, 1.0, doubt, 1.0);
}

double PartQueue::tolerance(std::uint32_t side) const {
  return std::max(options_.absolute_tolerance, options_.relative_tolerance * value_[side]);
}

double PartQueue::doubt_of(const Part& part) const {
  double doubt = 0.0;
  for (const auto& [side, error] : part.error) doubt = std::max(doubt, error / tolerance(side));
  return doubt;
}

bool PartQueue::is_done() const {
  if (part_.size() == 1) return false;  // nothing is known of its error yet
  for (std::uint32_t side = 0; side < error_.size(); ++side) {
    if (error_[side] > tolerance(side)) return false;
  }
  return true;
}

void PartQueue::account(const Part& part, double sense) {
  for (const auto& [side, value] : part.row) value_[side] += sense * value;
  for (const auto& [side, error] : part.error) error_[side] += sense * error;
}

SparseRow PartQueue::total_of(SparseRow Part::*what) const {
  SparseRow total;
  for (const Part& part : part_) total = combined(total, 1.0, part.*what, 1.0);
  return total;
}

}  // namespace tenku
