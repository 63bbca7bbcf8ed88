/// Angles and photometric quantities that cannot be mistaken for one another.
///
/// A quantity carries its unit symbol in its type, so that the symbol printed in a table, a
/// column header or a colour bar is the one the compiler has checked. Lengths are plain
/// `double` in metres: the program knows no other unit of length.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <numbers>
#include <string_view>

namespace tenku {

inline constexpr double kPi = std::numbers::pi;

/// Plane angle. Stored in radians; readable and writable in degrees.
class Angle {
 public:
  constexpr Angle() = default;
  static constexpr Angle radians(double value) { return Angle(value); }
  static constexpr Angle degrees(double value) { return Angle(value * kPi / 180.0); }

  constexpr double in_radians() const { return radians_; }
  constexpr double in_degrees() const { return radians_ * 180.0 / kPi; }

  friend constexpr auto operator<=>(Angle, Angle) = default;
  friend constexpr Angle operator+(Angle a, Angle b) { return Angle(a.radians_ + b.radians_); }
  friend constexpr Angle operator-(Angle a, Angle b) { return Angle(a.radians_ - b.radians_); }
  friend constexpr Angle operator-(Angle a) { return Angle(-a.radians_); }
  friend constexpr Angle operator*(double k, Angle a) { return Angle(k * a.radians_); }

 private:
  constexpr explicit Angle(double radians) : radians_(radians) {}
  double radians_ = 0.0;
};

/// Text of a unit symbol, usable as a template argument.
template <std::size_t N>
struct UnitSymbol {
  consteval UnitSymbol(const char (&symbol)[N]) { std::copy_n(symbol, N, text); }  // NOLINT
  char text[N];
};

/// A scalar that remembers its unit: `Quantity<"lx">` and `Quantity<"cd/m2">` do not mix.
template <UnitSymbol Symbol>
class Quantity {
 public:
  constexpr Quantity() = default;
  constexpr explicit Quantity(double value) : value_(value) {}

  constexpr double value() const { return value_; }
  static constexpr std::string_view unit() { return Symbol.text; }

  friend constexpr auto operator<=>(Quantity, Quantity) = default;
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity(a.value_ + b.value_);
  }
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity(a.value_ - b.value_);
  }
  friend constexpr Quantity operator*(double k, Quantity q) { return Quantity(k * q.value_); }
  friend constexpr double operator/(Quantity a, Quantity b) { return a.value_ / b.value_; }

 private:
  double value_ = 0.0;
};

using Luminance = Quantity<"cd/m2">;
using Illuminance = Quantity<"lx">;
using Irradiance = Quantity<"W/m2">;

inline namespace literals {
constexpr Angle operator""_deg(long double v) { return Angle::degrees(static_cast<double>(v)); }
}  // namespace literals

}  // namespace tenku
