#include "sky_models/sky_partition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <queue>

#include "core/error.h"
#include "core/parallel.h"
#include "sky_models/partition_tree.h"

namespace tenku {
namespace {

constexpr double kDefaultTolerance = 0.005;
constexpr std::size_t kDefaultElements = 512, kMostElements = 1000000;

struct Piece {
  SkyCell cell;
  ElementMoments moments;
};

SkyElement element_of(const Piece& piece) {
  const auto& [cell, m] = piece;
  SkyElement e;
  e.cell = cell;
  e.direction = cell.centre();
  e.solid_angle = m.solid_angle;
  e.luminance = Luminance(m.luminance / m.solid_angle);
  e.illuminance_vector = m.vector;
  e.standard_error_lux = std::sqrt(largest_eigenvalue(sample_covariance(m)));
  return e;
}

double priority(PartitionMethod method, const ElementMoments& m) {
  switch (method) {
    case PartitionMethod::Energy:
      return m.luminance;
    case PartitionMethod::Uniform:
      return m.solid_angle;
    default:
      return std::sqrt(largest_eigenvalue(sample_covariance(m)));
  }
}

void add(Symmetric3& sum, const Symmetric3& term, double sign) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += sign * term[k];
}

/// Halves cells of the tree, the first in the method's order first, until the request is met.
class Splitter {
 public:
  Splitter(PartitionTree& tree, const PartitionRequest& request)
      : tree_(tree), request_(request), horizontal_lux_(tree.node(0).moments.vector.z) {
    push(0);
  }

  void run() {
    while (!is_done()) {
      const std::size_t index = queue_.top().second;
      queue_.pop();
      add(covariance_, sample_covariance(tree_.node(index).moments), -1.0);
      const std::size_t child = tree_.divide(index);
      push(child);
      push(child + 1);
    }
  }

  std::vector<Piece> pieces() {
    std::vector<std::size_t> leaves;
    for (; !queue_.empty(); queue_.pop()) leaves.push_back(queue_.top().second);
    std::sort(leaves.begin(), leaves.end(), [this](std::size_t a, std::size_t b) {
      const SkyCell &p = tree_.node(a).cell, &q = tree_.node(b).cell;
      return std::pair(p.azimuth_from, p.sine_from) < std::pair(q.azimuth_from, q.sine_from);
    });
    std::vector<Piece> result;
    for (const std::size_t i : leaves) {
      result.push_back({tree_.node(i).cell, tree_.node(i).moments});
    }
    return result;
  }

 private:
  void push(std::size_t index) {
    const ElementMoments& m = tree_.node(index).moments;
    // Earlier nodes first where the order is a tie, so that the result is one.
    queue_.push({priority(request_.method, m), index});
    add(covariance_, sample_covariance(m), 1.0);
  }

  bool is_done() const {
    if (queue_.size() >= kMostElements) return true;
    if (request_.elements) return queue_.size() >= *request_.elements;
    if (request_.energy_threshold_lux) return queue_.top().first < *request_.energy_threshold_lux;
    return std::sqrt(largest_eigenvalue(covariance_)) <= *request_.tolerance * horizontal_lux_;
  }

  struct Later {
    bool operator()(const std::pair<double, std::size_t>& a,
                    const std::pair<double, std::size_t>& b) const {
      return a.first != b.first ? a.first < b.first : a.second > b.second;
    }
  };

  PartitionTree& tree_;
  PartitionRequest request_;
  double horizontal_lux_;
  Symmetric3 covariance_{};
  std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>,
                      Later>
      queue_;
};

std::vector<Piece> fixed_pieces(const SkyModel& sky, int reinhart) {
  const std::vector<SkyCell> cells = banded_cells(reinhart);
  std::vector<Piece> pieces(cells.size());
  parallel_for(cells.size(), 16, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      pieces[i] = {cells[i], element_moments(sky, cells[i])};
    }
  });
  return pieces;
}

PartitionRequest with_defaults(PartitionRequest r) {
  if (r.energy_threshold_lux) r.method = PartitionMethod::Energy;
  if (r.elements || r.energy_threshold_lux || r.tolerance) return r;
  if (r.method == PartitionMethod::Adaptive) {
    r.tolerance = kDefaultTolerance;
  } else {
    r.elements = kDefaultElements;
  }
  return r;
}

std::string_view name_of(PartitionMethod method) {
  switch (method) {
    case PartitionMethod::Adaptive:
      return "adaptive";
    case PartitionMethod::Energy:
      return "energy";
    case PartitionMethod::Uniform:
      return "uniform";
    case PartitionMethod::Tregenza:
      return "tregenza";
    case PartitionMethod::Reinhart:
      return "reinhart";
  }
  return "";
}

std::vector<Piece> pieces_of(const SkyModel& sky, const PartitionRequest& request) {
  if (request.method == PartitionMethod::Tregenza) return fixed_pieces(sky, 0);
  if (request.method == PartitionMethod::Reinhart) return fixed_pieces(sky, request.reinhart);
  PartitionTree tree(sky);
  Splitter splitter(tree, request);
  splitter.run();
  return splitter.pieces();
}

}  // namespace

PartitionRequest parse_partition(std::string_view text) {
  PartitionRequest request;
  for (const PartitionMethod method : {PartitionMethod::Adaptive, PartitionMethod::Energy,
                                       PartitionMethod::Uniform, PartitionMethod::Tregenza}) {
    request.method = method;
    if (text == name_of(method)) return request;
  }
  request.method = PartitionMethod::Reinhart;
  if (text.size() == 10 && text.starts_with("reinhart:") && text[9] >= '1' && text[9] <= '6') {
    request.reinhart = text[9] - '0';
    return request;
  }
  throw InputError(
      fmt::format("partition '{}' is unknown; there are adaptive, energy, uniform, "
                  "tregenza and reinhart:1 .. reinhart:6",
                  text));
}

void check_partition(const PartitionRequest& r) {
  if (r.elements && !(*r.elements >= 1 && *r.elements <= kMostElements)) {
    throw InputError(fmt::format("{} sky elements: not in 1..{}", *r.elements, kMostElements));
  }
  if (r.energy_threshold_lux && !(*r.energy_threshold_lux > 0.0)) {
    throw InputError(
        fmt::format("energy threshold {} must be above zero", *r.energy_threshold_lux));
  }
  if (r.tolerance && !(*r.tolerance > 0.0)) {
    throw InputError(fmt::format("tolerance {} must be above zero", *r.tolerance));
  }
  if (r.elements.has_value() + r.energy_threshold_lux.has_value() + r.tolerance.has_value() > 1) {
    throw InputError("sky elements: give a count, an energy threshold or a tolerance, not two");
  }
  const bool is_fixed =
      r.method == PartitionMethod::Tregenza || r.method == PartitionMethod::Reinhart;
  if (is_fixed && (r.elements || r.energy_threshold_lux || r.tolerance)) {
    throw InputError("the tregenza and reinhart partitions know their own count of elements");
  }
  if (r.energy_threshold_lux && r.method == PartitionMethod::Uniform) {
    throw InputError("an energy threshold goes with the energy partition, not with uniform");
  }
}

double SkyPartition::horizontal_lux() const {
  double sum = 0.0;
  for (const SkyElement& e : elements) sum += e.illuminance_vector.z;
  return sum;
}

SkyPartition partition_sky(const SkyModel& sky, const PartitionRequest& request) {
  check_partition(request);
  SkyPartition partition;
  Symmetric3 covariance{};
  for (const Piece& piece : pieces_of(sky, with_defaults(request))) {
    partition.elements.push_back(element_of(piece));
    add(covariance, sample_covariance(piece.moments), 1.0);
  }
  const double horizontal = partition.horizontal_lux();
  if (horizontal > 0.0) {
    partition.standard_error = std::sqrt(largest_eigenvalue(covariance)) / horizontal;
  }
  partition.description =
      fmt::format("{}, {} elements", name_of(request.method), partition.elements.size());
  return partition;
}

}  // namespace tenku
