#include "reports/histogram.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "reports/html.h"
#include "view/false_colour.h"

namespace tenku {
namespace {

constexpr double kLeft = 58.0, kTop = 16.0, kAcross = 640.0, kDown = 220.0;

std::vector<double> shares_of(const Histogram& h, const ValueScale& scale) {
  expects(h.weights.empty() || h.weights.size() == h.values.size(), "each value has a weight");
  std::vector<double> shares(static_cast<std::size_t>(std::max(h.bars, 1)));
  double sum = 0.0;
  for (std::size_t i = 0; i < h.values.size(); ++i) {
    if (!std::isfinite(h.values[i])) continue;
    const double weight = h.weights.empty() ? 1.0 : h.weights[i];
    const double at = scale.position_of(h.values[i]) * static_cast<double>(shares.size());
    shares[std::min(static_cast<std::size_t>(at), shares.size() - 1)] += weight;
    sum += weight;
  }
  for (double& share : shares) share = sum > 0.0 ? share / sum : 0.0;
  return shares;
}

std::string hex(Rgb8 c) {
  std::string text = "#";
  for (const int v : {int{c.r}, int{c.g}, int{c.b}}) {
    text += "0123456789abcdef"[v >> 4];
    text += "0123456789abcdef"[v & 15];
  }
  return text;
}

std::string label(double x, double y, const std::string& text, const char* anchor) {
  return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor +
         "\">" + escaped(text) + "</text>\n";
}

std::string rule(double x1, double y1, double x2, double y2, const char* colour) {
  return "<path d=\"M" + coordinate(x1) + " " + coordinate(y1) + "L" + coordinate(x2) + " " +
         coordinate(y2) + "\" stroke=\"" + colour + "\"/>\n";
}

std::string bars(const std::vector<double>& shares, double top_share) {
  std::string svg;
  const double width = kAcross / static_cast<double>(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double height = kDown * shares[i] / top_share, x = kLeft + width * static_cast<double>(i);
    const double middle = (static_cast<double>(i) + 0.5) / static_cast<double>(shares.size());
    if (!(height > 0.0)) continue;
    svg += "<rect x=\"" + coordinate(x + 0.5) + "\" y=\"" + coordinate(kTop + kDown - height) +
           "\" width=\"" + coordinate(width - 1.0) + "\" height=\"" + coordinate(height) +
           "\" fill=\"" + hex(colour_at(ColourMap::Viridis, middle)) +
           "\" stroke=\"#4a4f55\" stroke-width=\"0.5\"/>\n";
  }
  return svg;
}

}  // namespace

std::string histogram_svg(const Histogram& h) {
  const ValueScale scale = round_scale(h.values, h.logarithmic);
  const std::vector<double> shares = shares_of(h, scale);
  const double largest = *std::max_element(shares.begin(), shares.end());
  const ValueScale share_scale = round_scale(std::vector<double>{100.0 * std::max(largest, 1e-3)});
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 730 296\" role=\"img\""
      " aria-label=\"" +
      escaped(h.title) +
      "\" font-family=\"system-ui,-apple-system,"
      "'Segoe UI','Noto Sans',sans-serif\" font-size=\"13\" fill=\"#3a4047\">\n<title>" +
      escaped(h.title) + "</title>\n";
  for (const double tick : share_scale.ticks(4)) {
    const double y = kTop + kDown * (1.0 - share_scale.position_of(tick));
    svg += rule(kLeft, y, kLeft + kAcross, y, "#e3e5e7");
    svg += label(kLeft - 8.0, y + 4.5, number_text(tick) + " %", "end");
  }
  svg += bars(shares, 0.01 * share_scale.high);
  svg += rule(kLeft, kTop + kDown, kLeft + kAcross, kTop + kDown, "#4a4f55");
  for (const double tick : scale.ticks()) {
    const double x = kLeft + kAcross * scale.position_of(tick);
    svg += rule(x, kTop + kDown, x, kTop + kDown + 5.0, "#4a4f55");
    svg += label(x, kTop + kDown + 20.0, number_text(tick), "middle");
  }
  svg +=
      label(kLeft + 0.5 * kAcross, kTop + kDown + 44.0, h.quantity + " (" + h.unit + ")", "middle");
  return svg + "</svg>\n";
}

}  // namespace tenku
