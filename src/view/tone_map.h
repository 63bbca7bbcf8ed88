/// From luminance to what a screen can show.
#pragma once

#include <cstdint>
#include <optional>

#include "view/image.h"

namespace tenku {

/// How exposed light becomes a share of white.
enum class ToneCurve {
  Filmic,    ///< soft shoulder and toe; K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015
  Reinhard,  ///< E. Reinhard et al., "Photographic Tone Reproduction", SIGGRAPH 2002, eq. 4
  Linear     ///< cut off at white
};

/// What is made white.
enum class ExposureRule {
  LogAverage,  ///< the geometric mean of the luminance becomes `key`
  Percentile   ///< this percentile of the luminance becomes white
};

struct ToneMapOptions {
  ToneCurve curve = ToneCurve::Filmic;
  ExposureRule rule = ExposureRule::LogAverage;
  std::optional<double> ev100;  ///< exposure value at ISO 100, instead of the rule
  double key = 0.18;            ///< middle grey
  double percentile = 99.0;     ///< 0 to 100
};

/// Factor from cd/m2 to exposed light in which 1 is white before the curve.
///
/// Pixels that are black or not finite do not count. 1 for a picture that is all black.
///
/// Source   log average: Reinhard et al. 2002, eq. 1 and 2, over lit pixels only; `ev100`:
///          saturation-based speed of ISO 12232:2006, where white is 1.2 * 2^EV cd/m2.
/// @throws InputError if an option is out of its range
double exposure_of(const Image& luminance, const ToneMapOptions& options);

/// sRGB of a picture of luminance. Values that are not finite become black.
///
/// @throws InputError if an option is out of its range
Image8 tone_map(const Image& luminance, const ToneMapOptions& options = {});

/// 8-bit code of a share of white: clipped to [0, 1], sRGB transfer function, rounded.
///
/// Source   IEC 61966-2-1:1999.
std::uint8_t srgb_code(double linear);

/// Share of white that an 8-bit sRGB code stands for.
double linear_of_srgb(std::uint8_t code);

}  // namespace tenku
