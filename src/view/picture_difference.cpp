#include "view/picture_difference.h"

#include <cmath>
#include <cstdlib>

namespace tenku {
namespace {

constexpr int kSide = 8, kStep = 4;  // pixels: of a window, and from one to the next
constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);

double similarity_in_window(const Image8& a, const Image8& b, int x, int y) {
  constexpr double n = kSide * kSide;
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double u = a.at(x + i, y + j).g, v = b.at(x + i, y + j).g;
      sa += u, sb += v, saa += u * u, sbb += v * v, sab += u * v;
    }
  }
  const double ma = sa / n, mb = sb / n;
  const double va = saa / n - ma * ma, vb = sbb / n - mb * mb, cov = sab / n - ma * mb;
  return (2 * ma * mb + kC1) * (2 * cov + kC2) / ((ma * ma + mb * mb + kC1) * (va + vb + kC2));
}

}  // namespace

double mean_difference(const Image8& a, const Image8& b) {
  double sum = 0.0;
  for (std::size_t p = 0; p < a.pixels.size(); ++p) {
    sum += std::abs(a.pixels[p].r - b.pixels[p].r) + std::abs(a.pixels[p].g - b.pixels[p].g) +
           std::abs(a.pixels[p].b - b.pixels[p].b);
  }
  return sum / (3.0 * static_cast<double>(a.pixels.size()));
}

double structural_similarity(const Image8& a, const Image8& b) {
  double sum = 0.0;
  std::size_t windows = 0;
  for (int y = 0; y + kSide <= a.height; y += kStep) {
    for (int x = 0; x + kSide <= a.width; x += kStep, ++windows) {
      sum += similarity_in_window(a, b, x, y);
    }
  }
  return windows > 0 ? sum / static_cast<double>(windows) : 1.0;
}

}  // namespace tenku
