/// What the sky in one vertical half-plane gives to one surface.
#pragma once

#include <cmath>
#include <optional>

#include "core/altitude.h"
#include "illuminance/sky_table.h"

namespace tenku {

/// Illuminance (lux) and cosine-weighted share of the sky; of slices, per radian of azimuth.
struct LuxAndView {
  double lux = 0.0, view = 0.0;

  friend constexpr LuxAndView operator+(LuxAndView a, LuxAndView b) {
    return {a.lux + b.lux, a.view + b.view};
  }
  friend constexpr LuxAndView operator-(LuxAndView a, LuxAndView b) {
    return {a.lux - b.lux, a.view - b.view};
  }
  friend constexpr LuxAndView operator*(double k, LuxAndView a) { return {k * a.lux, k * a.view}; }
};

/// The unobstructed sky in the half-plane at one azimuth, as a surface receives it.
class SliceLight {
 public:
  /// @param table   null for no sky: only the view of it is found
  /// @param normal  of the surface, unit vector
  /// @param along   horizontal unit vector toward the azimuth
  SliceLight(const SkyTable* table, Vec3 normal, double azimuth_rad, Vec3 along)
      : along_(normal.x * along.x + normal.y * along.y),
        up_(normal.z),
        front_(front_range(along_, up_)) {
    if (table != nullptr) column_ = table->column(azimuth_rad);
  }

  /// Altitudes in front of the surface.
  FrontRange front() const { return front_; }
  bool is_behind() const { return !(front_.low < front_.high); }
  Altitude low() const { return Altitude::of(front_.low); }
  Altitude high() const {
    return front_.high == kPi / 2.0 ? Altitude::zenith() : Altitude::of(front_.high);
  }

  double view(const Altitude& from, const Altitude& to) const {
    return weighted(uniform_moments(to) - uniform_moments(from)) / kPi;
  }
  double lux(double from, double to) const {
    return column_ ? weighted(column_->to(to) - column_->to(from)) : 0.0;
  }
  LuxAndView both(const Altitude& from, const Altitude& to) const {
    return {lux(from.radians, to.radians), view(from, to)};
  }

  /// What checks are drawn in proportion to: skylight, or the view of a uniform sky without one.
  double measure(double from, double to) const {
    return column_ ? lux(from, to) : view(Altitude::of(from), Altitude::of(to));
  }
  SkyTable::Column::Row row_reaching(double wanted, double low, double high) const {
    if (!column_) return {low, high};
    return column_->row_reaching(wanted + weighted(column_->to(low)), along_, up_, low, high);
  }

 private:
  /// Moments of a sky of luminance 1.
  static SliceMoments uniform_moments(const Altitude& a) {
    return {0.5 * (a.radians + a.sine * a.cosine), 0.5 * a.sine * a.sine};
  }
  double weighted(SliceMoments m) const { return along_ * m.along + up_ * m.up; }

  double along_, up_;
  FrontRange front_;
  std::optional<SkyTable::Column> column_;
};

}  // namespace tenku
