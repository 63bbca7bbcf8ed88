#include <cmath>

#include "core/random.h"
#include "form_factors/disc_outlines.h"
#include "form_factors/form_factor_methods.h"
#include "form_factors/seen_parts.h"
#include "form_factors/visible_spans.h"

namespace tenku {
namespace {

/// Lines over the height of what is seen, so that little and far things get as many as near ones
/// when they are alone. All are moved by a random part of their distance.
LineSet lines_over(const DiscOutlines::Range& range, int count, std::uint64_t key) {
  const double step = (range.high - range.low) / count;
  const double phase = SampleRandom(key, 1, 0).uniform();
  return {range.low + phase * step, step, count};
}

double area_below(double y) {
  const double at = std::clamp(y, -1.0, 1.0);
  return at * std::sqrt(1.0 - at * at) + std::asin(at);
}

/// Form factor of one unit of length on a line.
///
/// Source  the paper's eq. 8, 2 / (pi N) for N lines over the whole disc. The lengths of all lines
///         across the disc then only nearly make its area; here they make it exactly.
double unit_of(const LineSet& lines, const DiscOutlines::Range& range) {
  double across = 0.0;
  for (int k = 0; k < lines.count; ++k) {
    across += 2.0 * std::sqrt(std::max(0.0, 1.0 - lines.y(k) * lines.y(k)));
  }
  return (area_below(range.high) - area_below(range.low)) / (kPi * across);
}

/// Elements of one line, of all elements of a view.
class LineSpans {
 public:
  LineSpans(const PointView& view, DiscOutlines& outlines, const LineSet& lines)
      : part_(view.seen.size()), begin_(static_cast<std::size_t>(lines.count) + 1) {
    std::vector<std::uint32_t> line_of;
    std::vector<DiscSpan> all;
    line_of.reserve(4 * view.seen.size());
    all.reserve(4 * view.seen.size());
    ScanLines scan(lines);
    for (std::uint32_t s = 0; s < view.seen.size(); ++s) {
      const auto add = [&](int line, double x0, double x1) {
        line_of.push_back(static_cast<std::uint32_t>(line));
        all.push_back({x0, x1, s});
        part_[s].whole += x1 - x0;
        ++begin_[static_cast<std::size_t>(line) + 1];
      };
      outlines.spans(view.seen[s], scan, add);
      const auto [low, high] = outlines.height();
      part_[s].area = outlines.area() / kPi, part_[s].low = low, part_[s].high = high;
    }
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    span_.resize(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) span_[next[line_of[k]]++] = all[k];
  }

  std::span<DiscSpan> operator[](int line) {
    const auto k = static_cast<std::size_t>(line);
    return {span_.data() + begin_[k], begin_[k + 1] - begin_[k]};
  }

  /// [seen], but for what is visible.
  std::vector<SidePart>& parts() { return part_; }

 private:
  std::vector<SidePart> part_;
  std::vector<std::size_t> begin_;
  std::vector<DiscSpan> span_;
};

/// The disc measured along scan lines: spans are exact, nearest is what is nearest, and what is
/// seen as a whole has its exact area (`row_of_parts`).
///
/// Source  Doi and Itoh (see `DiscOutlines`), section 2.
class HemisphereScanline : public FormFactorMethod {
 public:
  HemisphereScanline(const ElementMesh& mesh, const FormFactorOptions& options)
      : mesh_(mesh), options_(options) {}

  std::string_view name() const override { return "hemisphere-scanline"; }

  FormFactorRow from_point(Vec3 position, Vec3 normal) const override {
    const std::uint64_t key = key_of(position, normal, options_.seed);
    const PointView view(mesh_, position, PointAxes(normal, key));
    DiscOutlines outlines(mesh_, view, options_.polyline_deg);
    const DiscOutlines::Range range = outlines.range();
    if (!(range.low < range.high)) return {};
    const LineSet lines = lines_over(range, options_.resolution, key);
    LineSpans spans(view, outlines, lines);
    const std::vector<std::uint32_t> sheet = sheets_of(view);
    VisibleSpans visible(view, sheet);
    for (int line = 0; line < lines.count; ++line) visible.add_line(lines.y(line), spans[line]);
    for (std::size_t s = 0; s < sheet.size(); ++s) spans.parts()[s].visible = visible.length()[s];
    return row_of_parts(view, spans.parts(), sheet, lines.step, unit_of(lines, range));
  }

 private:
  const ElementMesh& mesh_;
  FormFactorOptions options_;
};

}  // namespace

std::unique_ptr<FormFactorMethod> make_hemisphere_scanline(const ElementMesh& mesh,
                                                           const FormFactorOptions& options) {
  return std::make_unique<HemisphereScanline>(mesh, options);
}

}  // namespace tenku
