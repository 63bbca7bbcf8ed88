// Surfaces of a model into elements: mesh_benchmark FILE.obj MATERIALS.toml ELEMENT_M PATCH_M
// [options of google-benchmark]. docs/meshes.md and docs/bubble_mesh.md have the commands.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "meshing/bubble_mesh.h"
#include "meshing/mesh_surfaces.h"
#include "meshing/size_field.h"
#include "scene/flatten.h"
#include "scene/read_scene.h"

namespace tenku {
namespace {

/// Samples `step_m` apart on each polygon: waves of sizes from half of that to twice.
std::vector<SizeField> waves(const std::vector<FlatPolygon>& polygons, double step_m) {
  std::vector<SizeField> fields;
  for (const FlatPolygon& polygon : polygons) {
    Extent box;
    for (const auto& ring : polygon.rings) {
      for (const Vec3 corner : ring) {
        const PlanePoint p = polygon.flat(corner);
        box.add({p.x, p.y, 0.0});
      }
    }
    std::vector<SizeSample> samples;
    for (double y = box.min.y; y <= box.max.y; y += step_m) {
      for (double x = box.min.x; x <= box.max.x; x += step_m) {
        samples.push_back({{x, y}, step_m * std::exp2(std::sin(x + 0.7 * y))});
      }
    }
    fields.emplace_back(polygon, samples,
                        SizeFieldOptions{.least_m = 0.1 * step_m, .most_m = 10.0 * step_m});
  }
  return fields;
}

int measure(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 5) {
    std::cerr << "mesh_benchmark FILE.obj MATERIALS.toml ELEMENT_M PATCH_M\n";
    return 2;
  }
  ReadOptions reading;
  reading.ground.kind = GroundChoice::Kind::None;
  reading.materials = argv[2];
  Progress progress;
  const Scene scene = read_scene(argv[1], reading, progress);
  const TriangleSoup soup = flatten(scene);
  const MeshOptions sizes{.element_m = std::atof(argv[3]), .patch_m = std::atof(argv[4])};
  const auto count = [](benchmark::State& state, const ElementMesh& mesh) {
    state.counters["elements"] = static_cast<double>(mesh.size());
    state.counters["patches"] = static_cast<double>(mesh.patches());
  };
  benchmark::RegisterBenchmark("divide", [&](benchmark::State& state) {
    ElementMesh mesh;
    for (auto _ : state) mesh = mesh_surfaces(soup, scene.materials, sizes);
    count(state, mesh);
  })->UseRealTime();
  benchmark::RegisterBenchmark("divide_and_check", [&](benchmark::State& state) {
    ElementMesh mesh;
    for (auto _ : state) mesh = mesh_scene(scene, soup, sizes).mesh;
    count(state, mesh);
  })->UseRealTime();
  const auto polygons =
      join_coplanar(soup, scene.materials, JoinTolerance::of(soup.vertices)).polygons;
  benchmark::RegisterBenchmark("size_fields", [&](benchmark::State& state) {
    std::size_t nodes = 0;
    for (auto _ : state) {
      nodes = 0;
      for (const SizeField& field : waves(polygons, sizes.element_m)) nodes += field.nodes();
    }
    state.counters["nodes"] = static_cast<double>(nodes);
  })->MeasureProcessCPUTime();
  benchmark::RegisterBenchmark("bubbles", [&](benchmark::State& state) {
    const std::vector<SizeField> fields = waves(polygons, sizes.element_m);
    const auto size_at = [&](std::size_t i, PlanePoint p) { return fields[i].at(p); };
    std::size_t elements = 0;
    for (auto _ : state) {
      elements = 0;
      for (const PolygonMesh& mesh : bubble_mesh(polygons, size_at, {}, {}).meshes) {
        elements += mesh.elements.size();
      }
    }
    state.counters["elements"] = static_cast<double>(elements);
  })->MeasureProcessCPUTime();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace tenku

int main(int argc, char** argv) { return tenku::measure(argc, argv); }
