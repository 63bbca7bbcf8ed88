#include "illuminance/sky_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr double kHalfPi = kPi / 2.0;

// Lobatto's rule of four points on [0, 1], two of which are the ends.
constexpr std::array<double, 2> kInside{0.27639320225002103, 0.7236067977499790};
constexpr double kEndWeight = 1.0 / 12.0, kInsideWeight = 5.0 / 12.0;

constexpr float kSame = 1e-6F;  // of the largest value of a column

/// Cubic through (0, p0) and (1, p1) with slopes m0, m1 per unit.
double hermite(double t, double p0, double m0, double p1, double m1) {
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * p0 + (t3 - 2 * t2 + t) * m0 + (3 * t2 - 2 * t3) * p1 +
         (t3 - t2) * m1;
}

int count_for(double whole_deg, double step_deg, int least, int most) {
  return std::clamp(static_cast<int>(std::ceil(whole_deg / step_deg)), least, most);
}

}  // namespace

SkyTable::SkyTable(const SkyModel& sky)
    : columns_(count_for(360.0, sky.detail().in_degrees(), 360, 8192)),
      rows_(count_for(90.0, sky.detail().in_degrees(), 90, 2048)),
      row_rad_(kHalfPi / rows_),
      rows_per_rad_(rows_ / kHalfPi),
      node_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_ + 1) *
            kNodeFloats) {
  std::vector<Altitude> altitude;
  for (int row = 0; row < rows_; ++row) {
    altitude.push_back(Altitude::of(row * row_rad_));
    for (const double inside : kInside) altitude.push_back(Altitude::of((row + inside) * row_rad_));
  }
  altitude.push_back(Altitude::zenith());
  parallel_for(static_cast<std::size_t>(columns_), 8, [&](IndexRange range) {
    for (std::size_t c = range.begin; c < range.end; ++c) {
      fill_column(sky, altitude, static_cast<int>(c));
    }
  });
  drop_equal_columns();
  find_column_errors();
  horizontal_lux_ = unobstructed_lux(kZenith);
}

/// A sky that is the same all round needs one column, which stays in the cache.
void SkyTable::drop_equal_columns() {
  const std::size_t pitch = static_cast<std::size_t>(rows_ + 1) * kNodeFloats;
  const float largest = *std::max_element(node_.begin(), node_.begin() + static_cast<long>(pitch));
  for (std::size_t k = pitch; k < node_.size(); ++k) {
    if (!(std::abs(node_[k] - node_[k % pitch]) <= kSame * largest)) return;
  }
  node_.resize(pitch);
  columns_ = 1;
}

/// Half-way between two columns a line misses what a cubic through four does not; over the whole
/// way two thirds of that.
void SkyTable::find_column_errors() {
  const auto whole = [&](int column) {
    const auto row =
        static_cast<std::size_t>(column % columns_) * static_cast<std::size_t>(rows_ + 1) +
        static_cast<std::size_t>(rows_);
    return static_cast<double>(node_[row * kNodeFloats + 2]);
  };
  column_error_.assign(1, 0.0);
  for (int c = 0; c < columns_; ++c) {
    const double inner = whole(c) + whole(c + 1), outer = whole(c + columns_ - 1) + whole(c + 2);
    const double missed = inner > 0.0 ? std::abs(inner - outer) / (8.0 * inner) : 0.0;
    column_error_.push_back(column_error_.back() + 2.0 / 3.0 * missed);
  }
}

double SkyTable::column_error(double azimuth_rad, double width_rad) const {
  if (columns_ == 1) return 0.0;
  const double turns = azimuth_rad / (2.0 * kPi);
  const double from = (turns - std::floor(turns)) * columns_;
  const double to = from + width_rad / (2.0 * kPi) * columns_;
  const auto sum_to = [&](double place) {
    const int column = static_cast<int>(place), round = column / columns_;
    const auto c = static_cast<std::size_t>(column % columns_);
    return round * column_error_.back() + column_error_[c] +
           (place - column) * (column_error_[c + 1] - column_error_[c]);
  };
  return to > from ? (sum_to(to) - sum_to(from)) / (to - from) : 0.0;
}

void SkyTable::fill_column(const SkyModel& sky, std::span<const Altitude> altitude, int column) {
  const double azimuth = 2.0 * kPi * column / columns_;
  const double east = std::sin(azimuth), north = std::cos(azimuth);
  const auto moments = [&](const Altitude& at) {
    const Vec3 direction{at.cosine * east, at.cosine * north, at.sine};
    const double weighted = row_rad_ * at.cosine * sky.luminance(direction).value();
    return SliceMoments{weighted * at.cosine, weighted * at.sine};
  };
  SliceMoments sum, here = moments(altitude[0]);
  float* node =
      &node_[static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_ + 1) * kNodeFloats];
  for (std::size_t k = 0;; k += kInside.size() + 1, node += kNodeFloats) {
    node[0] = static_cast<float>(sum.along);
    node[1] = static_cast<float>(here.along);
    node[2] = static_cast<float>(sum.up);
    node[3] = static_cast<float>(here.up);
    if (k + 1 == altitude.size()) return;
    const SliceMoments low = moments(altitude[k + 1]), high = moments(altitude[k + 2]),
                       next = moments(altitude[k + 3]);
    sum.along += kEndWeight * (here.along + next.along) + kInsideWeight * (low.along + high.along);
    sum.up += kEndWeight * (here.up + next.up) + kInsideWeight * (low.up + high.up);
    here = next;
  }
}

SkyTable::Column SkyTable::column(double azimuth_rad) const {
  if (columns_ == 1) return {this, node_.data(), node_.data(), 0.0};
  const double turns = azimuth_rad / (2.0 * kPi);
  const double place = (turns - std::floor(turns)) * columns_;
  const int left = std::min(static_cast<int>(place), columns_ - 1);
  const std::size_t pitch = static_cast<std::size_t>(rows_ + 1) * kNodeFloats;
  return {this, &node_[static_cast<std::size_t>(left) * pitch],
          &node_[static_cast<std::size_t>((left + 1) % columns_) * pitch], place - left};
}

SliceMoments SkyTable::Column::to(double altitude_rad) const {
  if (altitude_rad <= 0.0) return {};
  if (altitude_rad >= kHalfPi) {
    const std::size_t top = static_cast<std::size_t>(table_->rows_) * kNodeFloats;
    return {left_[top] + weight_ * (right_[top] - left_[top]),
            left_[top + 2] + weight_ * (right_[top + 2] - left_[top + 2])};
  }
  const double place = altitude_rad * table_->rows_per_rad_;
  const int row = std::min(static_cast<int>(place), table_->rows_ - 1);
  const double t = place - row;
  const std::size_t at = static_cast<std::size_t>(row) * kNodeFloats;
  if (left_ == right_) {
    const float* node = left_ + at;
    return {hermite(t, node[0], node[1], node[4], node[5]),
            hermite(t, node[2], node[3], node[6], node[7])};
  }
  const auto blend = [&](std::size_t k) {
    return left_[at + k] + weight_ * (right_[at + k] - left_[at + k]);
  };
  return {hermite(t, blend(0), blend(1), blend(4), blend(5)),
          hermite(t, blend(2), blend(3), blend(6), blend(7))};
}

SkyTable::Column::Row SkyTable::Column::row_reaching(double wanted, double h, double z,
                                                     double low_rad, double high_rad) const {
  const auto summed = [&](const float* column, std::size_t k) {
    return h * static_cast<double>(column[k]) + z * static_cast<double>(column[k + 2]);
  };
  const auto at_node = [&](int row) {
    const std::size_t k = static_cast<std::size_t>(row) * kNodeFloats;
    const double left = summed(left_, k);
    return left_ == right_ ? left : left + weight_ * (summed(right_, k) - left);
  };
  const double pitch = table_->row_rad_;
  int below = static_cast<int>(low_rad / pitch);
  int above = std::min(static_cast<int>(std::ceil(high_rad / pitch)), table_->rows_);
  while (above - below > 1) {
    const int middle = (below + above) / 2;
    (at_node(middle) < wanted ? below : above) = middle;
  }
  return {std::max(low_rad, below * pitch), std::min(high_rad, above * pitch)};
}

double SkyTable::unobstructed_lux(Vec3 normal) const {
  // Between the columns the table is linear, so a few points a column sum it up well.
  const int slices = std::max(720, 2 * columns_);
  double sum = 0.0;
  for (int k = 0; k < slices; ++k) {
    const double azimuth = 2.0 * kPi * (k + 0.5) / slices;
    const double along = normal.x * std::sin(azimuth) + normal.y * std::cos(azimuth);
    const FrontRange front = front_range(along, normal.z);
    if (!(front.low < front.high)) continue;
    const Column at = column(azimuth);
    const SliceMoments m = at.to(front.high) - at.to(front.low);
    sum += along * m.along + normal.z * m.up;
  }
  return sum * 2.0 * kPi / slices;
}

FrontRange front_range(double normal_along, double normal_up) {
  if (normal_up > 0.0) {
    return {normal_along >= 0.0 ? 0.0 : std::atan(-normal_along / normal_up), kHalfPi};
  }
  if (!(normal_along > 0.0)) return {0.0, 0.0};
  return {0.0, normal_up == 0.0 ? kHalfPi : std::atan(normal_along / -normal_up)};
}

}  // namespace tenku
