#include "reports/plan_map.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "output/canvas.h"
#include "output/map_furniture.h"

namespace tenku {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr int kSamples = 2;  // a side of a pixel

// What is seen from above at each sample of the map.
struct Layers {
  int width, height;
  std::vector<float> value, ground_height, roof_height, roof_shade;
  std::vector<std::uint32_t> object;  // 0: none

  Layers(int columns, int rows)
      : width(columns),
        height(rows),
        value(size(), kNothing),
        ground_height(size(), kNothing),
        roof_height(size(), kNothing),
        roof_shade(size()),
        object(size()) {}

  std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

bool is_higher(float z, float than) { return std::isnan(than) || z > than; }

// Calls paint(sample, weights of the three corners) for each sample centre in the triangle.
template <class Paint>
void for_samples(const std::array<PixelPosition, 3>& p, const Layers& layers, Paint&& paint) {
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  const double twice_area =
      (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  if (twice_area == 0.0) return;
  const auto clip = [](double v, int limit) {
    return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(limit)));
  };
  constexpr double kEdge = -1e-9;  // samples on a shared edge belong to both
  for (int y = clip(std::floor(top), layers.height); y < clip(std::ceil(bottom), layers.height);
       ++y) {
    for (int x = clip(std::floor(left), layers.width); x < clip(std::ceil(right), layers.width);
         ++x) {
      const double qx = x + 0.5, qy = y + 0.5;
      const double b =
          ((qx - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (qy - p[0].y)) / twice_area;
      const double c =
          ((p[1].x - p[0].x) * (qy - p[0].y) - (qx - p[0].x) * (p[1].y - p[0].y)) / twice_area;
      if (b < kEdge || c < kEdge || b + c > 1.0 - kEdge) continue;
      paint(static_cast<std::size_t>(y) * static_cast<std::size_t>(layers.width) +
                static_cast<std::size_t>(x),
            std::array<double, 3>{1.0 - b - c, b, c});
    }
  }
}

std::array<PixelPosition, 3> samples_of(const std::array<Vec3, 3>& corners,
                                        const PlanCamera& camera) {
  std::array<PixelPosition, 3> p{};
  for (std::size_t k = 0; k < 3; ++k) p[k] = camera.pixel_of(corners[k]);
  return p;
}

double mix(const std::array<double, 3>& weights, double a, double b, double c) {
  return weights[0] * a + weights[1] * b + weights[2] * c;
}

void draw_ground(Layers& layers, const PlanMap& map, const PlanCamera& camera) {
  for (const PlanTriangle& t : map.ground) {
    for_samples(
        samples_of(t.corners, camera), layers, [&](std::size_t i, const std::array<double, 3>& w) {
          const auto z = static_cast<float>(mix(w, t.corners[0].z, t.corners[1].z, t.corners[2].z));
          if (!is_higher(z, layers.ground_height[i])) return;
          layers.ground_height[i] = z;
          layers.value[i] = static_cast<float>(mix(w, t.values[0], t.values[1], t.values[2]));
        });
  }
}

// Light from the north-west, the custom of maps: relief reads as relief.
float shade_of(const PlanFace& face) {
  const Vec3 n = cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
  if (!(length(n) > 0.0)) return 0.0F;
  const Vec3 up = n.z < 0.0 ? -n : n;
  const Vec3 light = direction_from(Angle::degrees(315.0), Angle::degrees(45.0));
  return static_cast<float>(std::clamp(dot(normalized(up), light), 0.0, 1.0));
}

void draw_buildings(Layers& layers, const PlanMap& map, const PlanCamera& camera) {
  for (const PlanFace& face : map.buildings) {
    const float shade = shade_of(face);
    for_samples(samples_of(face.corners, camera), layers,
                [&](std::size_t i, const std::array<double, 3>& w) {
                  const auto z = static_cast<float>(
                      mix(w, face.corners[0].z, face.corners[1].z, face.corners[2].z));
                  if (!is_higher(z, layers.roof_height[i])) return;
                  layers.roof_height[i] = z;
                  layers.roof_shade[i] = shade;
                  layers.object[i] = face.object + 1;
                });
  }
}

float grid_value(const PlanGrid& grid, double column, double row) {
  const auto at = [&](double x, double y) {
    const int c = std::clamp(static_cast<int>(x), 0, grid.columns - 1);
    const int r = std::clamp(static_cast<int>(y), 0, grid.rows - 1);
    return grid.values[static_cast<std::size_t>(r) * static_cast<std::size_t>(grid.columns) +
                       static_cast<std::size_t>(c)];
  };
  if (column < 0.0 || row < 0.0 || column >= grid.columns || row >= grid.rows) return kNothing;
  const double x = std::max(column - 0.5, 0.0), y = std::max(row - 0.5, 0.0);
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  const double smooth = (1.0 - fy) * ((1.0 - fx) * at(x, y) + fx * at(x + 1.0, y)) +
                        fy * ((1.0 - fx) * at(x, y + 1.0) + fx * at(x + 1.0, y + 1.0));
  return static_cast<float>(std::isnan(smooth) ? at(column, row) : smooth);
}

void draw_grid(Layers& layers, const PlanGrid& grid, const PlanCamera& camera) {
  parallel_for(static_cast<std::size_t>(layers.height), 16, [&](IndexRange rows) {
    for (std::size_t y = rows.begin; y < rows.end; ++y) {
      for (int x = 0; x < layers.width; ++x) {
        const Vec3 p = camera.point(x + 0.5, static_cast<double>(y) + 0.5, 0.0);
        layers.value[y * static_cast<std::size_t>(layers.width) + static_cast<std::size_t>(x)] =
            grid_value(grid, (p.x - grid.west) / grid.cell_m, (grid.north - p.y) / grid.cell_m);
      }
    }
  });
}

Rgb8 colour_of(const Layers& layers, int x, int y, const ValueScale& scale, ColourMap map) {
  const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(layers.width) +
                        static_cast<std::size_t>(x);
  const std::uint32_t object = layers.object[i];
  const auto width = static_cast<std::size_t>(layers.width);
  const bool at_outline =
      (x > 0 && layers.object[i - 1] != object) || (y > 0 && layers.object[i - width] != object);
  if (at_outline) return {72, 74, 78};
  if (object != 0) {
    const auto grey = static_cast<std::uint8_t>(std::lround(168.0F + 62.0F * layers.roof_shade[i]));
    return {grey, grey, grey};
  }
  return std::isnan(layers.value[i]) ? Rgb8{243, 243, 240}
                                     : colour_at(map, scale.position_of(layers.value[i]));
}

Image8 picture_of(const Layers& layers, const ValueScale& scale, ColourMap map) {
  Image8 picture(layers.width / kSamples, layers.height / kSamples);
  parallel_for(static_cast<std::size_t>(picture.height), 8, [&](IndexRange rows) {
    for (auto y = static_cast<int>(rows.begin); y < static_cast<int>(rows.end); ++y) {
      for (int x = 0; x < picture.width; ++x) {
        int r = 0, g = 0, b = 0;
        for (int k = 0; k < kSamples * kSamples; ++k) {
          const Rgb8 c = colour_of(layers, x * kSamples + k % kSamples, y * kSamples + k / kSamples,
                                   scale, map);
          r += c.r, g += c.g, b += c.b;
        }
        const auto mean = [](int sum) {
          return static_cast<std::uint8_t>((sum + 2) / (kSamples * kSamples));
        };
        picture.at(x, y) = {mean(r), mean(g), mean(b)};
      }
    }
  });
  return picture;
}

struct ExtentFinder {
  PlanExtent e{1e300, 1e300, -1e300, -1e300};

  void add(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y))
      throw InputError("a corner of the plan is not finite");
    e.west = std::min(e.west, x), e.east = std::max(e.east, x);
    e.south = std::min(e.south, y), e.north = std::max(e.north, y);
  }
};

PlanExtent extent_of(const PlanMap& map) {
  ExtentFinder found;
  for (const PlanTriangle& t : map.ground) {
    for (const Vec3 p : t.corners) found.add(p.x, p.y);
  }
  for (const PlanFace& f : map.buildings) {
    for (const Vec3 p : f.corners) found.add(p.x, p.y);
  }
  if (map.grid) {
    found.add(map.grid->west, map.grid->north);
    found.add(map.grid->west + map.grid->columns * map.grid->cell_m,
              map.grid->north - map.grid->rows * map.grid->cell_m);
  }
  if (map.extent) return *map.extent;
  PlanExtent e = found.e;
  if (!(e.west < e.east && e.south < e.north))
    throw InputError("there is nothing to draw on the plan");
  const double margin = 0.01 * std::max(e.east - e.west, e.north - e.south);
  return {e.west - margin, e.south - margin, e.east + margin, e.north + margin};
}

// A sheet neither a ribbon nor a tower: the shorter side is widened.
PlanExtent widened(PlanExtent e) {
  const double across = e.east - e.west, along = e.north - e.south;
  const double more_along = std::max(0.0, 0.45 * across - along);
  const double more_across = std::max(0.0, along / 1.1 - across);
  return {e.west - 0.5 * more_across, e.south - 0.5 * more_along, e.east + 0.5 * more_across,
          e.north + 0.5 * more_along};
}

ValueScale scale_of(const PlanMap& map) {
  if (map.scale) return *map.scale;
  std::vector<double> values;
  for (const PlanTriangle& t : map.ground)
    values.insert(values.end(), t.values.begin(), t.values.end());
  if (map.grid) values.insert(values.end(), map.grid->values.begin(), map.grid->values.end());
  return round_scale(values, map.logarithmic);
}

constexpr double kMargin = 36.0, kText = 15.0, kLegend = 92.0, kLine = 22.0;

// Everything but the map itself; `top` is where the map begins, `map` its size.
void draw_surroundings(Canvas& canvas, const PlanMap& plan, const PlanCamera& camera, double top,
                       const ValueScale& scale) {
  const double right = canvas.image().width - kMargin, bottom = top + camera.height() / kSamples;
  canvas.text({kMargin, 52.0}, plan.title, {25.0, {24, 28, 32}, true});
  canvas.box({kMargin - 0.5, top - 0.5}, {right + 0.5, bottom + 0.5}, {1.0, {72, 74, 78}});
  const double bar = 0.55 * (right - kMargin);
  draw_colour_bar(canvas, {kMargin, bottom + 18.0}, bar,
                  {scale, plan.map, plan.quantity, plan.unit}, kText);
  draw_north_arrow(canvas, {right - 18.0, bottom + 66.0}, 48.0);
  const double room = 0.22 * (right - kMargin);
  draw_scale_bar(canvas, {right - 90.0 - room, bottom + 52.0}, room,
                 camera.footprint_m() * kSamples, kText);
  double y = bottom + kLegend + kLine;
  for (const std::string_view line : wrapped(plan.caption, right - kMargin, {kText, {}})) {
    canvas.text({kMargin, y}, line, {kText, {70, 76, 82}});
    y += kLine;
  }
}

}  // namespace

Image8 plan_map(const PlanMap& map) {
  if (map.width < 600 || map.width > 8192) {
    throw InputError("width " + std::to_string(map.width) +
                     " of the plan is not in 600..8192 pixels");
  }
  if (map.grid) {
    expects(map.grid->values.size() == static_cast<std::size_t>(map.grid->columns) *
                                           static_cast<std::size_t>(map.grid->rows),
            "the grid has columns * rows values");
  }
  const PlanExtent e = widened(extent_of(map));
  const int map_width = map.width - 2 * static_cast<int>(kMargin);
  const double metres = (e.east - e.west) / map_width;  // whole pixels along, the same as across
  const double rows = std::max(1.0, std::round((e.north - e.south) / metres));
  const PlanCamera camera({e.west, e.north - rows * metres, e.east, e.north, map_width * kSamples});
  Layers layers(camera.width(), camera.height());
  if (map.grid) draw_grid(layers, *map.grid, camera);
  draw_ground(layers, map, camera);
  draw_buildings(layers, map, camera);
  const ValueScale scale = scale_of(map);
  const Image8 picture = picture_of(layers, scale, map.map);

  const double top = map.title.empty() ? kMargin : 74.0;
  const auto lines = wrapped(map.caption, map_width, {kText, {}}).size();
  const double height =
      top + picture.height + kLegend + kLine * static_cast<double>(lines) + kMargin;
  Canvas canvas(map.width, static_cast<int>(height));
  canvas.paste(picture, static_cast<int>(kMargin), static_cast<int>(top));
  draw_surroundings(canvas, map, camera, top, scale);
  return canvas.image();
}

}  // namespace tenku
