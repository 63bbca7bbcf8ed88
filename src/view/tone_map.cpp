#include "view/tone_map.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"

namespace tenku {
namespace {

bool is_lit(double luminance) { return luminance > 0.0 && std::isfinite(luminance); }

double log_average_of(const Image& image) {
  constexpr std::size_t kGrain = 16384;
  const auto sum_over_lit = [&](auto&& term) {
    return parallel_sum(image.pixels.size(), kGrain, [&](IndexRange range) {
      double sum = 0.0;
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const double luminance = luminance_of(image.pixels[i]);
        if (is_lit(luminance)) sum += term(luminance);
      }
      return sum;
    });
  };
  const double lit = sum_over_lit([](double) { return 1.0; });
  return lit > 0.0 ? std::exp(sum_over_lit([](double l) { return std::log(l); }) / lit) : 0.0;
}

double percentile_of(const Image& image, double percentile) {
  std::vector<double> lit;
  for (const Rgb& pixel : image.pixels) {
    if (is_lit(luminance_of(pixel))) lit.push_back(luminance_of(pixel));
  }
  if (lit.empty()) return 0.0;
  const double rank = percentile / 100.0 * static_cast<double>(lit.size() - 1);
  const auto nth = lit.begin() + static_cast<std::ptrdiff_t>(std::lround(rank));
  std::nth_element(lit.begin(), nth, lit.end());
  return *nth;
}

void check(const ToneMapOptions& options) {
  if (!(options.key > 0.0 && std::isfinite(options.key))) {
    throw InputError("key of the exposure must be positive");
  }
  if (!(options.percentile >= 0.0 && options.percentile <= 100.0)) {
    throw InputError("percentile " + std::to_string(options.percentile) + " is not in 0..100");
  }
  if (options.ev100 && !(std::abs(*options.ev100) <= 100.0)) {
    throw InputError("exposure value " + std::to_string(*options.ev100) + " is not in -100..100");
  }
}

double filmic(double x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

double curve_value(ToneCurve curve, double x, double white) {
  switch (curve) {
    case ToneCurve::Filmic:
      return filmic(x);
    case ToneCurve::Reinhard:
      return x * (1.0 + x / (white * white)) / (1.0 + x);
    case ToneCurve::Linear:
      return x;
  }
  return x;
}

Rgb8 screen_colour(Rgb exposed, ToneCurve curve, double white) {
  const auto code = [&](double x) {
    if (!std::isfinite(x)) return std::uint8_t{0};
    return srgb_code(curve_value(curve, std::max(x, 0.0), white));
  };
  return {code(exposed.r), code(exposed.g), code(exposed.b)};
}

}  // namespace

double exposure_of(const Image& luminance, const ToneMapOptions& options) {
  check(options);
  if (options.ev100) return 1.0 / (1.2 * std::exp2(*options.ev100));
  const bool by_average = options.rule == ExposureRule::LogAverage;
  const double level =
      by_average ? log_average_of(luminance) : percentile_of(luminance, options.percentile);
  return level > 0.0 ? (by_average ? options.key : 1.0) / level : 1.0;
}

Image8 tone_map(const Image& luminance, const ToneMapOptions& options) {
  const double exposure = exposure_of(luminance, options);
  // The brightest pixels but for a few hundredths (glints, the sun's disc) are Reinhard's white.
  const double white = options.curve == ToneCurve::Reinhard
                           ? std::max(1.0, exposure * percentile_of(luminance, 99.5))
                           : 1.0;
  Image8 screen(luminance.width, luminance.height);
  parallel_for(luminance.pixels.size(), 16384, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      screen.pixels[i] = screen_colour(exposure * luminance.pixels[i], options.curve, white);
    }
  });
  return screen;
}

std::uint8_t srgb_code(double linear) {
  if (!(linear > 0.0)) return 0;
  if (linear >= 1.0) return 255;
  const double encoded =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

double linear_of_srgb(std::uint8_t code) {
  const double encoded = code / 255.0;
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace tenku
