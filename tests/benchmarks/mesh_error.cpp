// How wrong the light is on meshes by three meshers, against the number of elements:
//   mesh_error SCENE.obj MATERIALS.toml SKY_LUX REFERENCE_ELEMENTS TOLERANCE_PCT CASE...
// A case is uniform:ELEMENTS, refine:FIRST:MOST:ROUNDS[:THRESHOLD_PCT],
// bubble:FIRST:MOST:ROUNDS[:GRADING] or shadow:FIRST:MOST:ROUNDS (bubbles and shadow edges).
// SKY_LUX is that of a CIE overcast sky, 0 for none. docs/benchmarks.md says what is compared; a
// line of CSV for each mesh that was solved.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/extent.h"
#include "radiosity/mesh_loop.h"
#include "scene/flatten.h"
#include "scene/read_scene.h"
#include "sky_models/make_sky.h"

namespace tenku {
namespace {

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Scene and light.
struct Lit {
  Scene scene;
  TriangleSoup soup;
  std::unique_ptr<Engines> engines;
  Sky sky;
  DaylightSource source;
  Vec3 middle;

  Lit(const char* file, const char* materials, double sky_lux) {
    ReadOptions reading;
    reading.ground.kind = GroundChoice::Kind::None;
    reading.materials = materials;
    Progress quiet;
    scene = read_scene(file, reading, quiet);
    soup = flatten(scene);
    engines = std::make_unique<Engines>(soup, scene.materials);
    middle = extent_of(soup.vertices).middle();
    if (!(sky_lux > 0.0)) return;
    SkyRequest request;
    request.sky_illuminance = Illuminance(sky_lux);
    request.sun_illuminance = Illuminance(0.0);
    sky = make_sky(request);
    source.sky = std::make_unique<SkyTable>(*sky.model);
    source.model = sky.model.get();
  }

  MeshedScene mesh(std::size_t elements) const {
    return mesh_scene(scene, soup, {.elements_max = elements});
  }
  std::vector<ShadowEdges> edges() const {
    return shadow_edges(mesh(1).polygons, scene.materials, engines->rays(), {});
  }
  /// Of equilateral triangles, so many on all polygons.
  double size_for(std::size_t elements) const {
    double area = 0.0;
    const MeshedScene coarse = mesh(1);
    for (std::uint32_t e = 0; e < coarse.mesh.size(); ++e) area += coarse.mesh.area_m2(e);
    return std::sqrt(area / static_cast<double>(elements) * 4.0 / std::sqrt(3.0));
  }
  /// What is compared: that which faces the middle of the scene.
  bool counts(Vec3 at, Vec3 normal) const { return dot(middle - at, normal) > 0.0; }
};

/// A mesh solved again and again.
struct Solver {
  const Lit& lit;
  double tolerance_pct;
  std::uint64_t seed = 1;

  InteriorOptions interior() const {
    InteriorOptions how;
    how.tolerance_pct = tolerance_pct;
    how.shot.seed = seed;
    how.lift_m = lit.engines->rays().lift_m();
    return how;
  }
  std::unique_ptr<MeshLoop> run(MeshedScene first, MeshLoopOptions options) const {
    auto loop =
        std::make_unique<MeshLoop>(std::move(first), lit.scene.materials, interior(), options);
    IlluminanceOptions direct;
    direct.tolerance_pct = tolerance_pct;
    direct.seed = seed;
    direct.bounces = 0;
    const DaylightMethod daylight{*lit.engines, lit.source, direct, {}};
    Progress quiet;
    loop->run({lit.source.unobstructed_lux() > 0.0 ? &daylight : nullptr, 1.0}, quiet);
    return loop;
  }
};

/// Elements of a mesh by where they are on their polygons.
class Places {
 public:
  Places(const MeshLoop& loop)
      : mesh_(loop.mesh()),
        polygons_(loop.polygons()),
        polygon_of_(loop.polygon_of()),
        grid_(polygons_.size()) {
    for (std::uint32_t e = 0; e < mesh_.size(); ++e) {
      Grid& grid = grid_[polygon_of_[e]];
      ++grid.count;
      for (const std::uint32_t v : mesh_.elements[e]) grid.add(flat(e, v));
    }
    for (Grid& grid : grid_) grid.divide();
    for (std::uint32_t e = 0; e < mesh_.size(); ++e) {
      Extent box;
      for (const std::uint32_t v : mesh_.elements[e]) {
        const PlanePoint p = flat(e, v);
        box.add({p.x, p.y, 0.0});
      }
      grid_[polygon_of_[e]].for_cells(box, [&](auto& cell) { cell.push_back(e); });
    }
  }

  /// Calls `use(element, weights of its corners)` for the element at a place of a polygon.
  struct Found {
    std::uint32_t element;
    std::array<double, 3> weight;
  };
  Found at(std::uint32_t polygon, Vec3 place) const {
    const PlanePoint p = polygons_[polygon].flat(place);
    Found best{0, {}};
    double least = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t e : grid_[polygon].cell_at(p)) {
      const auto weight = weights(e, p);
      const double inside = *std::min_element(weight.begin(), weight.end());
      if (inside > least) least = inside, best = {e, weight};
    }
    return best;
  }

 private:
  struct Grid {
    std::size_t count = 0, n = 1;
    PlanePoint low{1e30, 1e30}, high{-1e30, -1e30};
    std::vector<std::vector<std::uint32_t>> cell;

    void add(PlanePoint p) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    void divide() {
      n = 1 + static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
      cell.resize(n * n);
    }
    std::size_t column(double v, double from, double to) const {
      const double k = (v - from) / (to - from) * static_cast<double>(n);
      return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(n) - 1.0));
    }
    template <class Use>
    void for_cells(const Extent& box, const Use& use) {
      for (auto y = column(box.min.y, low.y, high.y); y <= column(box.max.y, low.y, high.y); ++y) {
        for (auto x = column(box.min.x, low.x, high.x); x <= column(box.max.x, low.x, high.x);
             ++x) {
          use(cell[y * n + x]);
        }
      }
    }
    const std::vector<std::uint32_t>& cell_at(PlanePoint p) const {
      return cell[column(p.y, low.y, high.y) * n + column(p.x, low.x, high.x)];
    }
  };

  PlanePoint flat(std::uint32_t e, std::uint32_t v) const {
    return polygons_[polygon_of_[e]].flat(mesh_.vertices[v]);
  }
  std::array<double, 3> weights(std::uint32_t e, PlanePoint p) const {
    std::array<PlanePoint, 3> c;
    for (unsigned k = 0; k < 3; ++k) c[k] = flat(e, mesh_.elements[e][k]);
    const auto area = [](PlanePoint a, PlanePoint b, PlanePoint d) {
      return (b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x);
    };
    const double all = area(c[0], c[1], c[2]);
    return {area(p, c[1], c[2]) / all, area(c[0], p, c[2]) / all, area(c[0], c[1], p) / all};
  }

  const ElementMesh& mesh_;
  std::span<const FlatPolygon> polygons_;
  std::span<const std::uint32_t> polygon_of_;
  std::vector<Grid> grid_;
};

/// Light on a fine mesh, by two solutions with other samples: the noise of neither adds to the mean
/// of the product of the differences to both.
struct Reference {
  std::vector<Vec3> at;
  std::vector<std::uint32_t> polygon, face;
  std::vector<std::size_t> side;
  std::vector<double> area;
  std::array<std::vector<double>, 2> lux;
  double mean = 0.0, noise_lux = 0.0, missed_pct = 0.0;
  std::size_t elements = 0;

  Reference(const Lit& lit, std::size_t count, double tolerance_pct) {
    const std::vector<ShadowEdges> edges = lit.edges();
    for (unsigned look = 0; look < 2; ++look) {
      MeshLoopOptions options;
      options.mesher = Mesher::Bubble;
      options.sizes = {lit.size_for(count), lit.size_for(count)};
      options.edges = edges;
      const auto loop =
          Solver{lit, tolerance_pct, 1 + 1000 * look}.run(lit.mesh(count / 20), options);
      const LightOnMesh light = light_on_mesh(loop->mesh(), loop->interior(), loop->light());
      elements = loop->mesh().size();
      missed_pct = loop->rounds().back().missed_pct;
      if (look == 0) take(lit, *loop, light);
      for (const std::size_t s : side) lux[look].push_back(side_lux(light, s));
    }
    const double all = std::accumulate(area.begin(), area.end(), 0.0);
    for (std::size_t i = 0; i < at.size(); ++i) {
      mean += area[i] / all * 0.5 * (lux[0][i] + lux[1][i]);
      noise_lux += area[i] / all * std::pow(0.5 * (lux[0][i] - lux[1][i]), 2);
    }
    noise_lux = std::sqrt(noise_lux);
  }

  /// What counts, but for what stands under something: no light comes there.
  void take(const Lit& lit, const MeshLoop& loop, const LightOnMesh& light) {
    for (std::size_t s = 0; s < loop.mesh().sides(); ++s) {
      const Vec3 centre = loop.mesh().centre(s / 2);
      if (!lit.counts(centre, loop.mesh().normal(s)) || !(side_lux(light, s) > 0.0)) continue;
      side.push_back(s);
      at.push_back(centre);
      polygon.push_back(loop.polygon_of()[s / 2]);
      face.push_back(s % 2);
      area.push_back(loop.mesh().area_m2(s / 2));
    }
  }

  /// Area-weighted root mean square of what the values drawn on a mesh are wrong by.
  double rms(const MeshLoop& loop) const {
    const LightOnMesh light = light_on_mesh(loop.mesh(), loop.interior(), loop.light());
    const Places places(loop);
    double square = 0.0, all = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto [element, weight] = places.at(polygon[i], at[i]);
      const auto& corner = light.points.corner[2 * std::size_t{element} + face[i]];
      double here = 0.0;
      for (unsigned k = 0; k < 3; ++k) here += weight[k] * light.lux[corner[k]];
      square += area[i] * (here - lux[0][i]) * (here - lux[1][i]);
      all += area[i];
    }
    return std::sqrt(std::max(0.0, square / all));
  }
};

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
  return parts;
}

MeshLoopOptions options_of(const std::vector<std::string>& part) {
  MeshLoopOptions options;
  options.mesher = mesher_named(part[0] == "shadow" ? "bubble" : part[0]);
  options.tolerance_pct = 1e-3;  // never: the number of elements ends it
  if (part.size() < 4) return options;
  options.elements_max = std::strtoul(part[2].c_str(), nullptr, 10);
  options.rounds = std::atoi(part[3].c_str());
  if (part.size() > 4) {
    (part[0] == "refine" ? options.threshold_pct : options.grading) = std::atof(part[4].c_str());
  }
  return options;
}

int measure(int argc, char** argv) {
  if (argc < 7) {
    std::cerr << "mesh_error SCENE.obj MATERIALS.toml SKY_LUX REFERENCE_ELEMENTS TOLERANCE_PCT "
                 "CASE...\n";
    return 2;
  }
  const Lit lit(argv[1], argv[2], std::atof(argv[3]));
  const double tolerance_pct = std::atof(argv[5]);
  const Reference reference(lit, std::strtoul(argv[4], nullptr, 10), tolerance_pct);
  std::printf("# reference: %zu elements, mean %.6g lx, noise %.3g %%, interpolation %.3g %%\n",
              reference.elements, reference.mean, 100.0 * reference.noise_lux / reference.mean,
              reference.missed_pct);
  std::printf("case,elements,rms_pct,estimated_pct,processor_s,interior_s,size_field_s,remesh_s\n");
  for (int k = 6; k < argc; ++k) {
    const auto part = parts_of(argv[k]);
    const double before = processor_s();
    MeshedScene first = lit.mesh(std::strtoul(part.at(1).c_str(), nullptr, 10));
    MeshLoopOptions options = options_of(part);
    if (part[0] == "shadow") {
      options.edges = shadow_edges(first.polygons, lit.scene.materials, lit.engines->rays(), {});
    }
    const auto loop = Solver{lit, tolerance_pct, 7}.run(std::move(first), options);
    const double spent = processor_s() - before;
    const InteriorTimes times = loop->times();
    std::printf("%s,%zu,%.4f,%.4f,%.2f,%.3f,%.4f,%.4f\n", argv[k], loop->mesh().size(),
                100.0 * reference.rms(*loop) / reference.mean, loop->rounds().back().missed_pct,
                spent, times.form_factors_s + times.daylight_s + times.solve_s,
                loop->size_field_s(), loop->remesh_s());
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace tenku

int main(int argc, char** argv) {
  try {
    return tenku::measure(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
