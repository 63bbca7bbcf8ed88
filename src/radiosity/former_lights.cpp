#include "radiosity/former_lights.h"

#include <array>
#include <cmath>
#include <utility>

namespace tenku {
namespace {

constexpr double kDependent = 1e-9;  // of its square: what is left of a light made up of others

double product(std::span<const double> weight, std::span<const double> a,
               std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t s = 0; s < weight.size(); ++s) sum += weight[s] * a[s] * b[s];
  return sum;
}

void add(std::vector<Rgb>& sum, double factor, std::span<const Rgb> more) {
  sum.resize(more.size());
  for (std::size_t s = 0; s < sum.size(); ++s) sum[s] = sum[s] + factor * more[s];
}

}  // namespace

/// Least squares by normal equations: L D L^T, lights that others make up left out.
std::vector<double> FormerLights::factors(std::span<const double> source,
                                          std::span<const double> weight) const {
  const std::size_t n = former_.size();
  std::array<std::array<double, kMost>, kMost> lower{};
  std::array<double, kMost> square{}, right{};
  for (std::size_t i = 0; i < n; ++i) {
    right[i] = product(weight, former_[i].source, source);
    const double whole = former_[i].product[i];
    square[i] = whole;
    for (std::size_t j = 0; j < i; ++j) {
      if (!(square[j] > 0.0)) continue;
      double sum = former_[i].product[j];
      for (std::size_t k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k] * square[k];
      lower[i][j] = sum / square[j];
      square[i] -= lower[i][j] * sum;
      right[i] -= lower[i][j] * right[j];
    }
    if (!(square[i] > kDependent * whole)) square[i] = 0.0;
  }
  std::vector<double> factor(n);
  for (std::size_t i = n; i-- > 0;) {
    if (!(square[i] > 0.0)) continue;
    factor[i] = right[i] / square[i];
    for (std::size_t k = i + 1; k < n; ++k) factor[i] -= lower[k][i] * factor[k];
  }
  return factor;
}

LightStart FormerLights::start(std::span<const double> source,
                               std::span<const double> weight) const {
  LightStart start;
  const std::vector<double> factor = factors(source, weight);
  for (std::size_t i = 0; i < factor.size(); ++i) {
    if (factor[i] == 0.0) continue;
    const LightStart& former = former_[i].start;
    add(start.sent.radiosity, factor[i], former.sent.radiosity);
    add(start.sent.received, factor[i], former.sent.received);
    add(start.beyond_shots, factor[i], former.beyond_shots);
    start.sent.escaped_lm += factor[i] * former.sent.escaped_lm;
  }
  return start;
}

void FormerLights::keep(std::vector<double> source, std::span<const double> weight,
                        const RefinementResult& shots, std::span<const Rgb> of_corners) {
  std::vector<double> rest = source;
  const std::vector<double> factor = factors(source, weight);
  for (std::size_t i = 0; i < factor.size(); ++i) {
    for (std::size_t s = 0; s < rest.size(); ++s) rest[s] -= factor[i] * former_[i].source[s];
  }
  const double whole = product(weight, source, source);
  if (!(product(weight, rest, rest) > kSame * kSame * whole)) return;
  if (former_.size() == kMost) {
    former_.erase(former_.begin());
    for (Former& former : former_) former.product.erase(former.product.begin());
  }
  Former& next = former_.emplace_back();
  next.source = std::move(source);
  for (const Former& former : former_) {
    next.product.push_back(product(weight, former.source, next.source));
  }
  next.start.sent.received = shots.sides.received;
  next.start.sent.escaped_lm = shots.balance.escaped_lm;
  add(next.start.sent.radiosity, 1.0, shots.sides.radiosity);
  add(next.start.sent.radiosity, -1.0, shots.sides.unshot);
  add(next.start.beyond_shots, 1.0, of_corners);
  add(next.start.beyond_shots, -1.0, shots.sides.radiosity);
}

}  // namespace tenku
