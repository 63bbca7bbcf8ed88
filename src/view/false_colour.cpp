#include "view/false_colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/error.h"

namespace tenku {
namespace {

using Polynomial = std::array<Rgb, 7>;  // coefficients of t^0 to t^6

constexpr Polynomial kViridis{{
    {0.2777273272234177, 0.005407344544966578, 0.3340998053353061},
    {0.1050930431085774, 1.404613529898575, 1.384590162594685},
    {-0.3308618287255563, 0.214847559468213, 0.09509516302823659},
    {-4.634230498983486, -5.799100973351585, -19.33244095627987},
    {6.228269936347081, 14.17993336680509, 56.69055260068105},
    {4.776384997670288, -13.74514537774601, -65.35303263337234},
    {-5.435455855934631, 4.645852612178535, 26.3124352495832},
}};

constexpr Polynomial kInferno{{
    {0.0002189403691192265, 0.001651004631001012, -0.01948089843709184},
    {0.1065134194856116, 0.5639564367884091, 3.932712388889277},
    {11.60249308247187, -3.972853965665698, -15.9423941062914},
    {-41.70399613139459, 17.43639888205313, 44.35414519872813},
    {77.162935699427, -33.40235894210092, -81.80730925738993},
    {-71.31942824499214, 32.62606426397723, 73.20951985803202},
    {25.13112622477341, -12.24266895238567, -23.07032500287172},
}};

Rgb value_of(const Polynomial& polynomial, double t) {
  Rgb sum{};
  for (std::size_t i = polynomial.size(); i-- > 0;) sum = t * sum + polynomial[i];
  return sum;
}

std::uint8_t code_of(double share) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

Rgb8 colour_at(ColourMap map, double position) {
  const double t = position > 0.0 ? std::min(position, 1.0) : 0.0;
  Rgb c = Rgb::grey(t);
  if (map == ColourMap::Viridis) c = value_of(kViridis, t);
  if (map == ColourMap::Inferno) c = value_of(kInferno, t);
  return {code_of(c.r), code_of(c.g), code_of(c.b)};
}

Image8 false_colour(std::span<const double> values, int width, const ValueScale& scale,
                    ColourMap map) {
  expects(width > 0 && values.size() % static_cast<std::size_t>(width) == 0,
          "values fill whole rows");
  Image8 image(width, static_cast<int>(values.size() / static_cast<std::size_t>(width)));
  std::transform(values.begin(), values.end(), image.pixels.begin(), [&](double value) {
    return std::isnan(value) ? kNoValueColour : colour_at(map, scale.position_of(value));
  });
  return image;
}

Image8 false_colour(const Image& image, const ValueScale& scale, ColourMap map) {
  std::vector<double> values(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), values.begin(), luminance_of);
  return false_colour(values, image.width, scale, map);
}

}  // namespace tenku
