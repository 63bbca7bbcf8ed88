// Time of a shadow map, of its look-ups, and of the same pairs by rays.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "visibility/ray_visibility.h"
#include "visibility/shadow_maps.h"

namespace tenku {
namespace {

/// 300,000 triangles: 30,000 boxes without floors on 4 x 4 km, and points on the ground between.
struct City {
  TriangleSoup soup;
  std::vector<Material> materials{1};

  City() {
    SampleRandom random(1, 2, 3);
    for (int b = 0; b < 30000; ++b) add_box(random);
  }

  void add_box(SampleRandom& random) {
    const double x = 4000.0 * random.uniform() - 2000.0, y = 4000.0 * random.uniform() - 2000.0;
    const double w = 5.0 + 15.0 * random.uniform(), h = 3.0 + 40.0 * random.uniform();
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (int k = 0; k < 8; ++k) {
      soup.vertices.push_back({x + w * (k & 1), y + w * (k >> 1 & 1), h * (k >> 2)});
    }
    constexpr std::uint32_t kFaces[10][3]{{0, 1, 5}, {0, 5, 4}, {1, 3, 7}, {1, 7, 5}, {3, 2, 6},
                                          {3, 6, 7}, {2, 0, 4}, {2, 4, 6}, {4, 5, 7}, {4, 7, 6}};
    for (const auto& face : kFaces) {
      soup.triangles.push_back({first + face[0], first + face[1], first + face[2]});
      soup.object.push_back(first / 8);
      soup.surface_type.push_back(SurfaceType::Unknown);
      soup.material.push_back(0);
    }
  }
};

const City& city() {
  static const City made;
  return made;
}

/// Points on a square of ground about the middle of the city, row by row.
struct Ground {
  std::vector<Vec3> point, normal;

  Ground(std::size_t count, double half_m) {
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(count)));
    for (std::size_t k = 0; k < side * side; ++k) {
      const double step = 2.0 * half_m / static_cast<double>(side);
      point.push_back({step * (static_cast<double>(k % side) + 0.5) - half_m,
                       step * (static_cast<double>(k / side) + 0.5) - half_m, 0.5});
      normal.push_back(kZenith);
    }
  }
};

Vec3 direction(int k) {
  return direction_from(Angle::degrees(137.5 * k), Angle::degrees(10.0 + 7.0 * (k % 11)));
}

ShadowMapOptions with_texels(std::int64_t texels) {
  ShadowMapOptions options;
  options.texels = static_cast<int>(texels);
  return options;
}

constexpr std::size_t kAtOnce = 4;  // directions in one turn: the time is that of four

/// Arguments: threads, points, half the side of the region in metres, texels (0: rays).
void BM_Directions(benchmark::State& state) {
  const ThreadLimit limit(static_cast<unsigned>(state.range(0)));
  const Ground ground(static_cast<std::size_t>(state.range(1)),
                      static_cast<double>(state.range(2)));
  std::unique_ptr<Visibility> engine;
  if (state.range(3) == 0) {
    engine = std::make_unique<RayVisibility>(city().soup, city().materials);
  } else {
    engine =
        std::make_unique<ShadowMaps>(city().soup, city().materials, with_texels(state.range(3)));
  }
  std::vector<std::vector<float>> seen(kAtOnce, std::vector<float>(ground.point.size()));
  int turn = 0;
  const auto ask = [&] {
    parallel_for(kAtOnce, 1, [&](IndexRange range) {
      for (std::size_t k = range.begin; k < range.end; ++k) {
        engine->transmission_from(direction(turn + static_cast<int>(k)), ground.point,
                                  ground.normal, seen[k]);
      }
    });
    turn += kAtOnce;
  };
  ask();  // the contexts take the triangles
  for (auto _ : state) ask();
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(kAtOnce * ground.point.size()));
}

void all_cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"threads", "points", "half_m", "texels"})
      ->MeasureProcessCPUTime()
      ->UseRealTime();
  benchmark->Unit(benchmark::kMillisecond);
  for (const int threads : {1, 2}) {
    for (const int texels : {512, 1024, 2048}) benchmark->Args({threads, 100, 2000, texels});
    for (const int points : {10'000, 100'000, 1'000'000}) {
      for (const int texels : {1024, 0}) benchmark->Args({threads, points, 2000, texels});
    }
  }
  for (const int texels : {1024, 0}) benchmark->Args({2, 4'000'000, 2000, texels});
  for (const int points : {100, 1'000'000, 4'000'000}) {
    for (const int texels : {1024, 0}) benchmark->Args({2, points, 250, texels});
  }
}
BENCHMARK(BM_Directions)->Apply(all_cases);

}  // namespace
}  // namespace tenku

BENCHMARK_MAIN();
