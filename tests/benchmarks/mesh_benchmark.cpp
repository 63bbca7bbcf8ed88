// Surfaces of a model into elements: mesh_benchmark FILE.obj MATERIALS.toml ELEMENT_M PATCH_M
// [options of google-benchmark]. docs/meshes.md has the commands.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <iostream>

#include "meshing/mesh_surfaces.h"
#include "scene/flatten.h"
#include "scene/read_scene.h"

namespace tenku {
namespace {

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
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace tenku

int main(int argc, char** argv) { return tenku::measure(argc, argv); }
