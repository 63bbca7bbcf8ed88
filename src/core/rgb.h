/// Linear light in three channels.
#pragma once

namespace tenku {

/// Linear Rec. 709 red, green and blue, in whatever unit the holder states.
struct Rgb {
  double r = 0.0, g = 0.0, b = 0.0;

  static constexpr Rgb grey(double value) { return {value, value, value}; }

  friend constexpr bool operator==(Rgb, Rgb) = default;
  friend constexpr Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
  friend constexpr Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
  friend constexpr Rgb operator*(double k, Rgb a) { return {k * a.r, k * a.g, k * a.b}; }
};

/// The photometric part: 0.2126 R + 0.7152 G + 0.0722 B.
///
/// Source   ITU-R BT.709-6, item 3.2 (four digits).
constexpr double luminance_of(Rgb c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

}  // namespace tenku
