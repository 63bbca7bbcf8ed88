#include "radiosity/sizes_by_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr double kShape = 0.1;        // see the header
constexpr double kLeastOrder = 1.0;   // see the header
constexpr double kOff = 0.5;          // see the header
constexpr double kFineShare = 0.25;   // of the present size: no less in one step
constexpr double kCoarseShare = 8.0;  // nor more
constexpr double kNoise = 1.5;        // standard deviations of the residual that are noise
constexpr std::size_t kTerms = 6, kGrain = 64;

using Terms = std::array<double, kTerms>;

/// Least squares with a parabola; a ridge keeps what the points do not tell at zero.
class ParabolaFit {
 public:
  void add(const Terms& t, double value) {
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j <= i; ++j) matrix_[i][j] += t[i] * t[j];
      right_[i] += t[i] * value;
    }
  }
  Terms solve() {
    constexpr double kRidge = 1e-6;
    for (std::size_t i = 0; i < kTerms; ++i) matrix_[i][i] += kRidge * (1.0 + matrix_[0][0]);
    for (std::size_t i = 0; i < kTerms; ++i) {  // Cholesky's factors
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = matrix_[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= matrix_[i][k] * matrix_[j][k];
        matrix_[i][j] = i == j ? std::sqrt(sum) : sum / matrix_[j][j];
      }
    }
    Terms x = right_;
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t k = 0; k < i; ++k) x[i] -= matrix_[i][k] * x[k];
      x[i] /= matrix_[i][i];
    }
    for (std::size_t i = kTerms; i-- > 0;) {
      for (std::size_t k = i + 1; k < kTerms; ++k) x[i] -= matrix_[k][i] * x[k];
      x[i] /= matrix_[i][i];
    }
    return x;
  }

 private:
  std::array<Terms, kTerms> matrix_{};
  Terms right_{};
};

class PointFit {
 public:
  PointFit(const LightOnMesh& light, const PointNeighbours& neighbours)
      : light_(light), neighbours_(neighbours) {}

  InterpolationError at(std::uint32_t i) {
    gather(i);
    InterpolationError found;
    const auto ring = neighbours_.of(i);
    for (const std::uint32_t k : ring) found.size_m += length(position(k) - position(i));
    if (ring.empty()) return found;
    found.size_m /= static_cast<double>(ring.size());
    const Vec3 normal = light_.points.sensors.normal[i];
    const Vec3 along = normalized(position(ring[0]) - position(i)), across = cross(normal, along);
    const auto terms = [&](std::uint32_t k) {
      const Vec3 way = (1.0 / found.size_m) * (position(k) - position(i));
      const double x = dot(way, along), y = dot(way, across);
      return Terms{1.0, x, y, x * x, x * y, y * y};
    };
    ParabolaFit fit;
    for (const std::uint32_t k : about_) fit.add(terms(k), light_.lux[k] - light_.lux[i]);
    const Terms c = fit.solve();
    const double xx = 2.0 * c[3], xy = c[4], yy = 2.0 * c[5];  // by size_m squared
    const double bent = kShape * std::sqrt((xx * xx + 2.0 * xy * xy + yy * yy) / 2.0);
    double square = 0.0, noise = 0.0;
    for (const std::uint32_t k : about_) {
      const Terms t = terms(k);
      double value = 0.0;
      for (std::size_t n = 0; n < kTerms; ++n) value += c[n] * t[n];
      square += std::pow(light_.lux[k] - light_.lux[i] - value, 2);
      noise += light_.variance[k];
    }
    const auto count = static_cast<double>(about_.size());
    const double off = kOff * kOff * std::max(0.0, square - kNoise * kNoise * noise) / count;
    found.lux = std::sqrt(bent * bent + off);
    found.order = found.lux > 0.0 ? 2.0 * bent * bent / (bent * bent + off) : 2.0;
    return found;
  }

 private:
  Vec3 position(std::uint32_t i) const { return light_.points.sensors.position[i]; }

  /// Points up to two edges away.
  void gather(std::uint32_t i) {
    about_.assign(1, i);
    for (const std::uint32_t k : neighbours_.of(i)) {
      about_.push_back(k);
      const auto second = neighbours_.of(k);
      about_.insert(about_.end(), second.begin(), second.end());
    }
    std::sort(about_.begin(), about_.end());
    about_.erase(std::unique(about_.begin(), about_.end()), about_.end());
  }

  const LightOnMesh& light_;
  const PointNeighbours& neighbours_;
  std::vector<std::uint32_t> about_;
};

/// Calls `use(side, corner, third of the area)` for the corners of lit sides.
template <class Use>
void for_corners(const LightOnMesh& light, const Use& use) {
  for (std::size_t s = 0; s < light.mesh.sides(); ++s) {
    if (light.is_lit[light.points.corner[s][0]] == 0) continue;
    const double third = light.mesh.area_m2(s / 2) / 3.0;
    for (const std::uint32_t i : light.points.corner[s]) use(i, third);
  }
}

/// Size with which an element has this share of the squared error, lux^2 m^2.
double size_for(const InterpolationError& error, double share, const SizeRange& range) {
  double size = range.most_m;
  if (error.lux > 0.0) {
    const double now = std::pow(error.lux * error.size_m, 2);
    size = error.size_m *
           std::pow(share / now, 1.0 / (2.0 + 2.0 * std::max(kLeastOrder, error.order)));
  }
  size = std::clamp(size, kFineShare * error.size_m, kCoarseShare * error.size_m);
  return std::clamp(size, range.least_m, std::max(range.least_m, range.most_m));
}

/// What sizes for a share come to.
struct Outlook {
  double square = 0.0;  ///< error, lux^2 m^2
  double elements = 0.0;
};

Outlook outlook(const std::vector<InterpolationError>& error, std::span<const double> side_area,
                std::span<const double> area, double share, const SizeRange& range) {
  constexpr double kPerArea = 2.309;  // equilateral triangles: 4 / sqrt(3)
  Outlook sum;
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (!(side_area[i] > 0.0) || !(error[i].size_m > 0.0)) continue;
    const double size = size_for(error[i], share, range), ratio = size / error[i].size_m;
    // A jump is a strip as wide as the elements.
    const double order = 2.0 * error[i].order + 1.0 - error[i].order / 2.0;
    sum.square += side_area[i] * error[i].lux * error[i].lux * std::pow(ratio, order);
    sum.elements += kPerArea * area[i] / (size * size);
  }
  return sum;
}

}  // namespace

std::vector<InterpolationError> interpolation_error(const LightOnMesh& light) {
  const PointNeighbours neighbours(light);
  std::vector<InterpolationError> error(light.points.size());
  parallel_for(error.size(), kGrain, [&](IndexRange range) {
    PointFit fit(light, neighbours);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (light.is_lit[i] != 0) error[i] = fit.at(static_cast<std::uint32_t>(i));
    }
  });
  return error;
}

double interpolation_rms(const LightOnMesh& light, const std::vector<InterpolationError>& error) {
  double square = 0.0, area = 0.0;
  for_corners(light, [&](std::uint32_t i, double third) {
    square += third * error[i].lux * error[i].lux;
    area += third;
  });
  return area > 0.0 ? std::sqrt(square / area) : 0.0;
}

std::vector<double> sizes_by_error(const LightOnMesh& light,
                                   const std::vector<InterpolationError>& error,
                                   const ErrorSizes& asked) {
  std::vector<double> lit_area(error.size()), element_area(error.size());
  double area = 0.0;
  for_corners(light, [&](std::uint32_t i, double third) {
    lit_area[i] += third;
    area += third;
  });
  // Where both faces are lit each vertex counts once, by its front.
  const std::vector<std::uint32_t> vertex = vertices_of(light);
  std::vector<std::uint8_t> is_counted(light.mesh.vertices.size());
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (!(lit_area[i] > 0.0) || is_counted[vertex[i]] != 0) continue;
    is_counted[vertex[i]] = 1;
    element_area[i] = lit_area[i];
  }
  const double allowed = asked.allowed_lux * asked.allowed_lux * area;
  const auto most = static_cast<double>(asked.elements_max);
  const auto is_too_fine = [&](double share) {
    const Outlook is = outlook(error, lit_area, element_area, share, asked.range);
    return (asked.elements_max > 0 && is.elements > most) || is.square < allowed;
  };
  double low = -120.0, high = 120.0;  // powers of two of the share
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (is_too_fine(std::exp2(middle)) ? low : high) = middle;
  }
  std::vector<double> size(light.mesh.vertices.size(), asked.range.most_m);
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (!(lit_area[i] > 0.0)) continue;
    size[vertex[i]] = std::min(size[vertex[i]], size_for(error[i], std::exp2(high), asked.range));
  }
  return size;
}

}  // namespace tenku
