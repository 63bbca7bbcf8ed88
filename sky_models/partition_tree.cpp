#include "sky_models/partition_tree.h"

#include <cmath>

namespace tenku {
namespace {

constexpr int kIntegratedDepth = 9;  // 512 cells of some seven degrees
constexpr std::array kPatchesInBand{30, 30, 24, 24, 18, 12, 6};

double sine_of_degrees(double degrees) { return std::sin(degrees * kPi / 180.0); }

}  // namespace

std::pair<SkyCell, SkyCell> halves(const SkyCell& cell) {
  SkyCell first = cell, second = cell;
  const double sine = 0.5 * (cell.sine_from + cell.sine_to);
  const double width = (cell.azimuth_to - cell.azimuth_from) * std::sqrt(1.0 - sine * sine);
  const double height = std::asin(cell.sine_to) - std::asin(cell.sine_from);
  if (width >= height) {
    first.azimuth_to = second.azimuth_from = 0.5 * (cell.azimuth_from + cell.azimuth_to);
  } else {
    first.sine_to = second.sine_from = sine;
  }
  return {first, second};
}

PartitionTree::PartitionTree(const SkyModel& sky) : sky_(sky) {
  nodes_.reserve(std::size_t{4} << static_cast<unsigned>(kIntegratedDepth));
  nodes_.push_back({SkyCell{}, {}, 0});
  build(0, kIntegratedDepth);
}

void PartitionTree::build(std::size_t index, int depth) {
  if (depth == 0) {
    nodes_[index].moments = element_moments(sky_, nodes_[index].cell);
    return;
  }
  const std::size_t child = append_children(index);
  build(child, depth - 1);
  build(child + 1, depth - 1);
  ElementMoments sum = nodes_[child].moments;
  sum += nodes_[child + 1].moments;
  nodes_[index].moments = sum;
}

std::size_t PartitionTree::append_children(std::size_t index) {
  const auto [first, second] = halves(nodes_[index].cell);
  const std::size_t child = nodes_.size();
  nodes_[index].first_child = child;
  nodes_.push_back({first, {}, 0});
  nodes_.push_back({second, {}, 0});
  return child;
}

std::size_t PartitionTree::divide(std::size_t index) {
  if (nodes_[index].first_child != 0) return nodes_[index].first_child;
  const std::size_t child = append_children(index);
  for (const std::size_t i : {child, child + 1}) {
    nodes_[i].moments = element_moments(sky_, nodes_[i].cell);
  }
  return child;
}

std::vector<SkyCell> banded_cells(int m) {
  const int times = m == 0 ? 1 : m;
  const double band = m == 0 ? 12.0 : 90.0 / (7.0 * m + 0.5);
  std::vector<SkyCell> cells;
  int row = 0;
  for (const int patches : kPatchesInBand) {
    for (int repeat = 0; repeat < times; ++repeat, ++row) {
      const int count = patches * times;
      const double width = 2.0 * kPi / count;
      const double low = sine_of_degrees(row * band), high = sine_of_degrees((row + 1) * band);
      for (int i = 0; i < count; ++i) {
        cells.push_back({(i - 0.5) * width, (i + 0.5) * width, low, high});
      }
    }
  }
  cells.push_back({0.0, 2.0 * kPi, sine_of_degrees(row * band), 1.0});
  return cells;
}

}  // namespace tenku
