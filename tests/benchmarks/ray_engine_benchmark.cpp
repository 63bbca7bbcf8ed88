// Rays per second through the visibility interface against a bare Embree loop over the same rays.

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"
#include "visibility/ray_visibility.h"

namespace tenku {
namespace {

/// 3000 boxes on 1 km2, and rays from the ground between them to the whole sky.
struct Town {
  TriangleSoup soup;
  std::vector<Material> materials{1};
  std::vector<Vec3> origin, direction;

  Town() {
    SampleRandom random(1, 2, 3);
    for (int b = 0; b < 3000; ++b) add_box(random);
    for (int s = 0; s < 1000; ++s) {
      const Vec3 at{1000.0 * random.uniform() - 500.0, 1000.0 * random.uniform() - 500.0, 0.5};
      for (int k = 0; k < 256; ++k) {
        const double u = random.uniform(), turn = 2.0 * kPi * (k + random.uniform()) / 256.0;
        origin.push_back(at);
        direction.push_back(
            {std::sqrt(u) * std::sin(turn), std::sqrt(u) * std::cos(turn), std::sqrt(1.0 - u)});
      }
    }
  }

  void add_box(SampleRandom& random) {
    const double x = 1000.0 * random.uniform() - 500.0, y = 1000.0 * random.uniform() - 500.0;
    const double w = 5.0 + 10.0 * random.uniform(), h = 3.0 + 27.0 * random.uniform();
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

const Town& town() {
  static const Town made;
  return made;
}

void BM_VisibilityInterface(benchmark::State& state) {
  const RayVisibility rays(town().soup, town().materials);
  std::vector<float> seen(town().origin.size());
  for (auto _ : state) rays.transmission(town().origin, town().direction, seen);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * seen.size()));
}
BENCHMARK(BM_VisibilityInterface)->Unit(benchmark::kMillisecond);

void BM_BareEmbreeLoop(benchmark::State& state) {
  const Town& t = town();
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, t.soup.vertices.size()));
  for (const Vec3& p : t.soup.vertices) {
    *v++ = static_cast<float>(p.x), *v++ = static_cast<float>(p.y), *v++ = static_cast<float>(p.z);
  }
  auto* i = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, t.soup.size()));
  for (const auto& triangle : t.soup.triangles) {
    for (const std::uint32_t corner : triangle) *i++ = corner;
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcCommitScene(scene);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (auto _ : state) {
    for (std::size_t k = 0; k < t.origin.size(); ++k) {
      RTCRay ray{};
      ray.org_x = static_cast<float>(t.origin[k].x),
      ray.dir_x = static_cast<float>(t.direction[k].x);
      ray.org_y = static_cast<float>(t.origin[k].y),
      ray.dir_y = static_cast<float>(t.direction[k].y);
      ray.org_z = static_cast<float>(t.origin[k].z),
      ray.dir_z = static_cast<float>(t.direction[k].z);
      ray.tfar = std::numeric_limits<float>::infinity();
      ray.mask = ~0U;
      rtcOccluded1(scene, &context, &ray);
      benchmark::DoNotOptimize(ray.tfar);
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * t.origin.size()));
  rtcReleaseGeometry(geometry);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
BENCHMARK(BM_BareEmbreeLoop)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tenku

BENCHMARK_MAIN();
