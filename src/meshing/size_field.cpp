#include "meshing/size_field.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>

#include "core/error.h"

namespace tenku {
namespace {

constexpr double kLeastNodes = 64.0, kMostNodes = 4096.0, kNodesPerSample = 0.5;
// Of the samples against the bending of one node.
constexpr double kStiffness = 1e3;
// Of the slope, which makes the answer unique where the samples are fewer than three or on a line.
constexpr double kMembrane = 1e-6;
constexpr double kSame = 1e-12;

bool is_length(double x) { return x > 0.0 && std::isfinite(x); }

void check(std::span<const SizeSample> samples, const SizeFieldOptions& options) {
  if (!is_length(options.least_m) || !is_length(options.most_m) ||
      options.least_m > options.most_m) {
    throw InputError("sizes from " + std::to_string(options.least_m) + " to " +
                     std::to_string(options.most_m) + " m should be two lengths, the lesser first");
  }
  if (!is_length(options.grading)) throw InputError("the grading of sizes should be positive");
  for (const SizeSample& s : samples) {
    if (is_length(s.size_m) && std::isfinite(s.at.x) && std::isfinite(s.at.y)) continue;
    throw InputError("a size of " + std::to_string(s.size_m) + " m at " + std::to_string(s.at.x) +
                     ", " + std::to_string(s.at.y) + " should be a length at a place");
  }
}

/// Sum of squares of weighted sums of unknowns, as the sparse system of its least value.
class LeastSquares {
 public:
  explicit LeastSquares(std::size_t unknowns)
      : right_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns))) {}

  struct Term {
    std::size_t unknown;
    double factor;
  };

  /// Adds `weight` times the square of the sum of `terms` less `value`.
  void add(std::initializer_list<Term> terms, double weight, double value = 0.0) {
    for (const Term& a : terms) {
      right_[index(a)] += weight * a.factor * value;
      for (const Term& b : terms) {
        if (index(b) > index(a)) continue;
        entries_.emplace_back(index(a), index(b), weight * a.factor * b.factor);
      }
    }
  }

  Eigen::VectorXd solution() const {
    Eigen::SparseMatrix<double> matrix(right_.size(), right_.size());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    expects(factors.info() == Eigen::Success, "a plate that samples hold has one shape");
    return factors.solve(right_);
  }

 private:
  static Eigen::Index index(const Term& t) { return static_cast<Eigen::Index>(t.unknown); }

  std::vector<Eigen::Triplet<double>> entries_;  ///< of the lower half
  Eigen::VectorXd right_;
};

/// Energy of a plate bent over a grid, and a little for its slope.
void add_plate(std::size_t columns, std::size_t rows, LeastSquares& system) {
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t at = j * columns + i, up = at + columns;
      if (i + 1 < columns) system.add({{at, -1.0}, {at + 1, 1.0}}, kMembrane);
      if (j + 1 < rows) system.add({{at, -1.0}, {up, 1.0}}, kMembrane);
      if (i + 2 < columns) system.add({{at, 1.0}, {at + 1, -2.0}, {at + 2, 1.0}}, 1.0);
      if (j + 2 < rows) system.add({{at, 1.0}, {up, -2.0}, {up + columns, 1.0}}, 1.0);
      if (i + 1 < columns && j + 1 < rows) {
        system.add({{at, 1.0}, {at + 1, -1.0}, {up, -1.0}, {up + 1, 1.0}}, 2.0);
      }
    }
  }
}

}  // namespace

SizeField::SizeField(const FlatPolygon& polygon, std::span<const SizeSample> samples,
                     const SizeFieldOptions& options) {
  check(samples, options);
  uniform_m_ = options.most_m;
  if (samples.empty()) return;
  std::vector<SizeSample> bounded(samples.begin(), samples.end());
  for (SizeSample& s : bounded) s.size_m = std::clamp(s.size_m, options.least_m, options.most_m);
  const auto [least, most] =
      std::minmax_element(bounded.begin(), bounded.end(),
                          [](const auto& a, const auto& b) { return a.size_m < b.size_m; });
  uniform_m_ = least->size_m;
  const double low = least->size_m, high = most->size_m;
  if (high <= (1.0 + kSame) * low) return;
  lay_grid(polygon, bounded);
  if (size_m_.empty()) return;
  bend(bounded);
  for (double& size : size_m_) size = std::clamp(size, low, high);
  limit_by(bounded, options.grading);
  grade(options.grading);
}

void SizeField::lay_grid(const FlatPolygon& polygon, std::span<const SizeSample> samples) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  PlanePoint low{kFar, kFar}, high{-kFar, -kFar};
  for (const auto& ring : polygon.rings) {
    for (const Vec3 corner : ring) {
      const PlanePoint p = polygon.flat(corner);
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const double width = high.x - low.x, height = high.y - low.y;
  if (!is_length(width) || !(height >= 0.0)) return;
  const double most =
      std::clamp(kNodesPerSample * static_cast<double>(samples.size()), kLeastNodes, kMostNodes);
  spacing_m_ = uniform_m_;
  const auto nodes = [&](double h) {
    return (std::ceil(width / h) + 1.0) * (std::ceil(height / h) + 1.0);
  };
  while (nodes(spacing_m_) > most) spacing_m_ *= 1.1;
  origin_ = low;
  columns_ = static_cast<std::size_t>(std::max(1.0, std::ceil(width / spacing_m_))) + 1;
  rows_ = static_cast<std::size_t>(std::max(1.0, std::ceil(height / spacing_m_))) + 1;
  size_m_.assign(columns_ * rows_, 0.0);
}

SizeField::Cell SizeField::cell(PlanePoint p) const {
  const double x =
      std::clamp((p.x - origin_.x) / spacing_m_, 0.0, static_cast<double>(columns_ - 1));
  const double y = std::clamp((p.y - origin_.y) / spacing_m_, 0.0, static_cast<double>(rows_ - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(x), columns_ - 2);
  const std::size_t j = std::min(static_cast<std::size_t>(y), rows_ - 2);
  return {j * columns_ + i, x - static_cast<double>(i), y - static_cast<double>(j)};
}

double SizeField::at(PlanePoint p) const {
  if (size_m_.empty()) return uniform_m_;
  const Cell c = cell(p);
  const double* low = size_m_.data() + c.node;
  const double* high = low + columns_;
  return (1.0 - c.y) * ((1.0 - c.x) * low[0] + c.x * low[1]) +
         c.y * ((1.0 - c.x) * high[0] + c.x * high[1]);
}

void SizeField::bend(std::span<const SizeSample> samples) {
  LeastSquares system(size_m_.size());
  add_plate(columns_, rows_, system);
  for (const SizeSample& s : samples) {
    const auto [n, x, y] = cell(s.at);
    system.add({{n, (1.0 - x) * (1.0 - y)},
                {n + 1, x * (1.0 - y)},
                {n + columns_, (1.0 - x) * y},
                {n + columns_ + 1, x * y}},
               kStiffness, std::log(s.size_m));
  }
  const Eigen::VectorXd log_size = system.solution();
  for (std::size_t n = 0; n < size_m_.size(); ++n) {
    size_m_[n] = std::exp(log_size[static_cast<Eigen::Index>(n)]);
  }
}

/// Lowers the nodes about each sample to what grading allows beside it.
void SizeField::limit_by(std::span<const SizeSample> samples, double grading) {
  for (const SizeSample& s : samples) {
    const auto [n, x, y] = cell(s.at);
    const auto limit = [&](std::size_t node, double dx, double dy) {
      size_m_[node] = std::min(size_m_[node], s.size_m + grading * spacing_m_ * std::hypot(dx, dy));
    };
    limit(n, x, y);
    limit(n + 1, 1.0 - x, y);
    limit(n + columns_, x, 1.0 - y);
    limit(n + columns_ + 1, 1.0 - x, 1.0 - y);
  }
}

/// Lowers what rises too fast, to and fro over the grid until nothing changes.
void SizeField::grade(double grading) {
  const double straight = grading * spacing_m_, slanted = std::sqrt(2.0) * straight;
  const auto columns = static_cast<std::ptrdiff_t>(columns_);
  const auto rows = static_cast<std::ptrdiff_t>(rows_);
  bool has_changed = true;
  const auto lower = [&](std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t sense) {
    double& size = size_m_[static_cast<std::size_t>(j * columns + i)];
    const auto from = [&](std::ptrdiff_t di, std::ptrdiff_t dj, double rise) {
      const std::ptrdiff_t x = i - sense * di, y = j - sense * dj;
      if (x < 0 || y < 0 || x >= columns || y >= rows) return;
      const double allowed = size_m_[static_cast<std::size_t>(y * columns + x)] + rise;
      if (!(allowed < size)) return;
      size = allowed;
      has_changed = true;
    };
    from(1, 0, straight);
    from(0, 1, straight);
    from(1, 1, slanted);
    from(-1, 1, slanted);
  };
  while (has_changed) {
    has_changed = false;
    for (std::ptrdiff_t j = 0; j < rows; ++j) {
      for (std::ptrdiff_t i = 0; i < columns; ++i) lower(i, j, 1);
    }
    for (std::ptrdiff_t j = rows; j-- > 0;) {
      for (std::ptrdiff_t i = columns; i-- > 0;) lower(i, j, -1);
    }
  }
}

}  // namespace tenku
