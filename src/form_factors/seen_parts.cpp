#include "form_factors/seen_parts.h"

#include <algorithm>
#include <cstddef>

namespace tenku {
namespace {

/// What a side is taken to cover, and how much of that may be wrong.
struct Estimate {
  double value = 0.0, doubt = 0.0;
};

/// Of each side of a sheet the visible part; of those between lines the mean of the nearest before
/// and after them, in a sheet of which some side is met.
std::vector<double> shares(std::span<const SidePart> sheet) {
  constexpr double kUnknown = -1.0;
  std::vector<double> before(sheet.size()), after(sheet.size());
  const auto share_of = [&](std::size_t k, double beside) {
    return sheet[k].whole > 0.0 ? std::min(1.0, sheet[k].visible / sheet[k].whole) : beside;
  };
  double last = kUnknown;
  for (std::size_t k = 0; k < sheet.size(); ++k) before[k] = last = share_of(k, last);
  last = kUnknown;
  for (std::size_t k = sheet.size(); k-- > 0;) after[k] = last = share_of(k, last);
  for (std::size_t k = 0; k < sheet.size(); ++k) {
    if (before[k] == kUnknown) before[k] = after[k];
    if (after[k] == kUnknown) after[k] = before[k];
    before[k] = 0.5 * (before[k] + after[k]);
  }
  return before;
}

void estimate_sheet(std::span<const SidePart> sheet, double step, std::span<Estimate> estimate) {
  double low = 1.0, high = -1.0;
  bool is_met = false;
  for (const SidePart& side : sheet) {
    low = std::min(low, side.low), high = std::max(high, side.high);
    is_met = is_met || side.whole > 0.0;
  }
  if (!is_met) return;
  const double chance = std::min(1.0, (high - low) / step);
  const std::vector<double> share = shares(sheet);
  for (std::size_t k = 0; k < sheet.size(); ++k) {
    const double value = sheet[k].area * share[k] / chance;
    estimate[k] = {value, value * (1.0 - share[k] * chance)};
  }
}

/// Makes the values of all, and of the sky, add up to 1.
void share_out(std::vector<Estimate>& all) {
  constexpr double kLeast = 1e-6;  // where nothing is in doubt, everything is, a little
  constexpr double kMost = 0.9;    // of what is in doubt is taken away
  double sum = 0.0, doubt = 0.0;
  for (Estimate& e : all) {
    e.doubt += kLeast * e.value;
    sum += e.value, doubt += e.doubt;
  }
  if (!(sum > 0.0)) return;
  const double more = std::clamp((1.0 - sum) / doubt, -kMost, kMost);
  const double in_all = sum + more * doubt;
  for (Estimate& e : all) e.value = (e.value + more * e.doubt) / in_all;
}

}  // namespace

FormFactorRow row_of_parts(const PointView& view, std::span<const SidePart> part,
                           std::span<const std::uint32_t> sheet, double step, double unit) {
  std::vector<Estimate> estimate(part.size() + 1);  // the last is the sky
  double covered = 0.0;
  for (std::size_t begin = 0, end = 0; begin < part.size(); begin = end) {
    for (; end < part.size() && sheet[end] == sheet[begin]; ++end) covered += part[end].visible;
    estimate_sheet(part.subspan(begin, end - begin), step,
                   std::span(estimate).subspan(begin, end - begin));
  }
  const double sky = std::max(0.0, 1.0 - covered * unit);
  estimate.back() = {sky, sky};
  share_out(estimate);
  FormFactorRow row;
  for (std::size_t s = 0; s < part.size(); ++s) {
    if (estimate[s].value > 0.0) {
      row.push_back({view.seen[s].side, static_cast<float>(estimate[s].value)});
    }
  }
  return row;
}

}  // namespace tenku
