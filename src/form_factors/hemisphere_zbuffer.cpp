#include <cmath>

#include "form_factors/disc_outlines.h"
#include "form_factors/form_factor_methods.h"
#include "form_factors/item_buffer.h"

namespace tenku {
namespace {

/// The disc as a picture in which each pixel keeps the number of what is nearest.
///
/// Source  Doi and Itoh (see `DiscOutlines`), section 2, eqs. 6 and 7. The unit is one part of the
///         pixels in the disc, which are nearly pi / 4 of all.
class HemisphereZBuffer : public FormFactorMethod {
 public:
  HemisphereZBuffer(const ElementMesh& mesh, const FormFactorOptions& options)
      : mesh_(mesh), options_(options), step_(2.0 / options.resolution) {
    const auto side = static_cast<std::size_t>(options.resolution);
    height_.resize(side * side);
    for (std::size_t k = 0; k < height_.size(); ++k) {
      const double x = at(k % side), y = at(k / side), square = 1.0 - x * x - y * y;
      height_[k] = static_cast<float>(std::sqrt(std::max(0.0, square)));
      pixels_ += square > 0.0 ? 1.0 : 0.0;
    }
  }

  std::string_view name() const override { return "hemisphere-zbuffer"; }

  FormFactorRow from_point(Vec3 position, Vec3 normal) const override {
    const std::uint64_t key = key_of(position, normal, options_.seed);
    const PointView view(mesh_, position, PointAxes(normal, key));
    DiscOutlines outlines(mesh_, view, options_.polyline_deg);
    ScanLines scan({at(0), step_, options_.resolution});
    ItemBuffer buffer(options_.resolution, options_.resolution);
    for (std::uint32_t s = 0; s < view.seen.size(); ++s) {
      const Vec3 nearness = view.seen[s].nearness;
      const auto fill = [&](int row, double x0, double x1) {
        const double of_row = nearness.y * at(static_cast<std::size_t>(row));
        const std::size_t first = buffer.index(row, 0);
        buffer.fill(row, (x0 + 1.0) / step_, (x1 + 1.0) / step_, s, [&](std::size_t column) {
          return nearness.x * at(column) + of_row + nearness.z * height_[first + column];
        });
      };
      outlines.spans(view.seen[s], scan, fill);
    }
    std::vector<double> covered(view.seen.size());
    for (const std::uint32_t item : buffer.item()) {
      if (item != ItemBuffer::kNothing) covered[item] += 1.0;
    }
    return row_of(view, covered, 1.0 / pixels_);
  }

 private:
  double at(std::size_t pixel) const { return -1.0 + (static_cast<double>(pixel) + 0.5) * step_; }

  const ElementMesh& mesh_;
  FormFactorOptions options_;
  double step_, pixels_ = 0.0;
  std::vector<float> height_;  ///< z of the direction of each pixel, [row][column]
};

}  // namespace

std::unique_ptr<FormFactorMethod> make_hemisphere_zbuffer(const ElementMesh& mesh,
                                                          const FormFactorOptions& options) {
  return std::make_unique<HemisphereZBuffer>(mesh, options);
}

}  // namespace tenku
