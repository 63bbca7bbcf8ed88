#include "view/value_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"

namespace tenku {
namespace {

std::vector<double> finite_of(std::span<const double> values, bool positive_only) {
  std::vector<double> kept;
  kept.reserve(values.size());
  for (const double v : values) {
    if (std::isfinite(v) && (!positive_only || v > 0.0)) kept.push_back(v);
  }
  return kept;
}

double value_at_rank(std::vector<double>& values, double share) {
  const auto rank =
      static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

ValueScale round_log_scale(double low, double high) {
  const double top = std::pow(10.0, std::ceil(std::log10(high) - 1e-9));
  const double bottom = std::pow(10.0, std::floor(std::log10(low) + 1e-9));
  return {std::clamp(bottom, top * 1e-6, top * 0.1), top, true};
}

std::vector<double> linear_ticks(double low, double high, int wanted) {
  const double step = round_up_125((high - low) / std::max(wanted, 1) * (1.0 - 1e-9));
  std::vector<double> ticks;
  const double slack = 1e-6 * step;
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) {
    ticks.push_back(k * step + 0.0);  // + 0.0 turns -0 into 0
  }
  return ticks;
}

std::vector<double> log_ticks(double low, double high, int wanted) {
  const double decades = std::log10(high / low);
  const bool with_2_and_5 = decades * 3.0 <= wanted + 1.0;
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / std::max(wanted, 1))));
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
  for (int decade = first; std::pow(10.0, decade) <= high * (1.0 + 1e-9); decade += stride) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double tick = digit * std::pow(10.0, decade);
      const bool inside = tick >= low * (1.0 - 1e-9) && tick <= high * (1.0 + 1e-9);
      if (inside && (digit == 1.0 || with_2_and_5)) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::string with_commas(std::string digits) {
  std::size_t end = digits.find('.');
  if (end == std::string::npos) end = digits.size();
  const std::size_t begin = digits.starts_with('-') ? 1 : 0;
  for (std::size_t at = end; at > begin + 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

}  // namespace

double ValueScale::position_of(double value) const {
  if (logarithmic) {
    if (!(value > low)) return 0.0;
    return std::min(1.0, std::log(value / low) / std::log(high / low));
  }
  return std::clamp((value - low) / (high - low), 0.0, 1.0);
}

double ValueScale::value_at(double position) const {
  return logarithmic ? low * std::pow(high / low, position) : low + position * (high - low);
}

std::vector<double> ValueScale::ticks(int wanted) const {
  return logarithmic ? log_ticks(low, high, wanted) : linear_ticks(low, high, wanted);
}

double round_up_125(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {1.0, 2.0, 5.0, 10.0}) {
    if (digit * power >= value * (1.0 - 1e-12)) return digit * power;
  }
  return 10.0 * power;
}

ValueScale round_scale(std::span<const double> values, bool logarithmic, double cut) {
  std::vector<double> kept = finite_of(values, logarithmic);
  if (kept.empty()) return {logarithmic ? 0.1 : 0.0, 1.0, logarithmic};
  const double high = value_at_rank(kept, 1.0 - cut);
  const double low = *std::min_element(kept.begin(), kept.end());
  if (logarithmic) return round_log_scale(low, high);
  if (low >= 0.0) {
    if (!(high > 0.0)) return {0.0, 1.0, false};
    const double step = round_up_125(high / 5.0);
    return {0.0, step * std::ceil(high / step - 1e-9), false};
  }
  const double span = high > low ? high - low : std::abs(low);
  const double step = round_up_125(span / 5.0);
  const double bottom = step * std::floor(low / step + 1e-9);
  return {bottom, std::max(step * std::ceil(high / step - 1e-9), bottom + step), false};
}

ValueScale scale_between(double low, double high, bool logarithmic) {
  if (!(std::isfinite(low) && std::isfinite(high) && low < high)) {
    throw InputError("the scale " + std::to_string(low) + " to " + std::to_string(high) +
                     " is empty or not finite");
  }
  if (logarithmic && !(low > 0.0)) {
    throw InputError("a logarithmic scale must begin above zero, not at " + std::to_string(low));
  }
  return {low, high, logarithmic};
}

std::string number_text(double value, int decimals) {
  const double size = std::abs(value);
  char text[64];
  if (!std::isfinite(value)) return "no value";
  if (size >= 1e9 || (size > 0.0 && size < 1e-4)) {
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string digits = text;
  if (digits.find('.') != std::string::npos) {
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.ends_with('.')) digits.pop_back();
  }
  return digits == "-0" ? "0" : with_commas(digits);
}

std::string rounded_text(double value, int digits) {
  if (!std::isfinite(value) || value == 0.0) return number_text(value);
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  const int decimals = digits - 1 - exponent;
  if (decimals >= 0) return number_text(value, decimals);
  const double unit = std::pow(10.0, -decimals);
  return number_text(std::round(value / unit) * unit, 0);
}

}  // namespace tenku
