#include "visibility/ray_visibility.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/closest_point.h"
#include "core/error.h"
#include "core/handle.h"

namespace tenku {
namespace {

using EmbreeDevice = Handle<RTCDeviceTy, &rtcReleaseDevice>;
using EmbreeScene = Handle<RTCSceneTy, &rtcReleaseScene>;
using EmbreeGeometry = Handle<RTCGeometryTy, &rtcReleaseGeometry>;

constexpr unsigned kPacket = 16;
constexpr double kUsualIndex = 1.52;      // soda-lime float glass
constexpr double kOnePlane = 1.0 - 1e-6;  // cosine between the normals of one pane's triangles

void throw_on_error(RTCDevice device, const char* doing) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE) return;
  throw ResourceError(std::string("the ray-tracing device failed while ") + doing + " (code " +
                      std::to_string(static_cast<int>(code)) + ")");
}

void copy_vertices(RTCGeometry geometry, const TriangleSoup& soup) {
  auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                         RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                         soup.vertices.size()));
  if (to == nullptr) throw ResourceError("no memory for the vertices");
  for (const Vec3& v : soup.vertices) {
    *to++ = static_cast<float>(v.x);
    *to++ = static_cast<float>(v.y);
    *to++ = static_cast<float>(v.z);
  }
}

void copy_triangles(RTCGeometry geometry, const TriangleSoup& soup,
                    const std::vector<std::uint32_t>& chosen) {
  auto* to = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), chosen.size()));
  if (to == nullptr) throw ResourceError("no memory for the triangles");
  for (const std::uint32_t t : chosen) to = std::copy_n(soup.triangles[t].data(), 3, to);
}

EmbreeScene build_scene(RTCDevice device, const TriangleSoup& soup,
                        const std::vector<std::uint32_t>& chosen) {
  EmbreeScene scene(rtcNewScene(device));
  throw_on_error(device, "making a scene");
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  if (!chosen.empty()) {
    EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    copy_vertices(geometry.get(), soup);
    copy_triangles(geometry.get(), soup, chosen);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene.get(), geometry.get());
  }
  rtcCommitScene(scene.get());
  throw_on_error(device, "building the tree of boxes");
  return scene;
}

void set_ray(RTCRay& ray, Vec3 origin, Vec3 direction) {
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = 0.0F;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.time = 0.0F;
  ray.mask = ~0U;
  ray.id = 0;
  ray.flags = 0;
}

/// What the filter of a glass query gathers along one ray.
struct GlassQuery {
  RTCIntersectContext context;  // first, so that the filter finds the rest behind it
  const RayVisibility* visibility;
  const std::vector<std::uint32_t>* glass;
  Vec3 direction;
  double transmission;
};

void gather_pane(const RTCFilterFunctionNArguments* arguments) {
  auto* query = reinterpret_cast<GlassQuery*>(arguments->context);
  const RTCHit hit = rtcGetHitFromHitN(arguments->hit, arguments->N, 0);
  const std::uint32_t triangle = (*query->glass)[hit.primID];
  const double cosine = std::abs(dot(query->visibility->normal(triangle), query->direction));
  const auto& soup = query->visibility->soup();
  query->transmission *= pane_transmittance(query->visibility->materials()[soup.material[triangle]],
                                            std::min(1.0, cosine));
  arguments->valid[0] = 0;  // not a stop: go on to the next pane
}

/// What the filter of a search for panes gathers along one ray.
struct PaneQuery {
  RTCIntersectContext context;  // first, as above
  const std::vector<std::uint32_t>* glass;
  std::vector<RayHit>* panes;
};

void gather_hit(const RTCFilterFunctionNArguments* arguments) {
  auto* query = reinterpret_cast<PaneQuery*>(arguments->context);
  const RTCHit hit = rtcGetHitFromHitN(arguments->hit, arguments->N, 0);
  query->panes->push_back(
      {(*query->glass)[hit.primID], RTCRayN_tfar(arguments->ray, arguments->N, 0)});
  arguments->valid[0] = 0;
}

/// What a search for a triangle at a point has found.
struct PointSearch {
  const TriangleSoup& soup;
  const std::vector<std::uint32_t>& opaque;
  Vec3 point;
  double within_m;
  std::optional<std::uint32_t> found;
};

bool is_at_point(RTCPointQueryFunctionArguments* arguments) {
  auto* search = static_cast<PointSearch*>(arguments->userPtr);
  const std::uint32_t triangle = search->opaque[arguments->primID];
  const auto& [a, b, c] = search->soup.triangles[triangle];
  const auto& v = search->soup.vertices;
  const Vec3 closest = closest_on_triangle(search->point, v[a], v[b], v[c]);
  if (length(closest - search->point) <= search->within_m) search->found = triangle;
  return false;  // the radius stays
}

double extent_of(const TriangleSoup& soup) {
  double largest = 1.0;
  for (const Vec3& v : soup.vertices) {
    largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  }
  return largest;
}

/// Reflectance of one face of glass, for the two polarisations.
struct FresnelPair {
  double s, p;
};

FresnelPair fresnel(double cos_incidence, double index) {
  const double sin_inside = std::sqrt(std::max(0.0, 1.0 - cos_incidence * cos_incidence)) / index;
  const double cos_inside = std::sqrt(std::max(0.0, 1.0 - sin_inside * sin_inside));
  const double s = (cos_incidence - index * cos_inside) / (cos_incidence + index * cos_inside);
  const double p = (index * cos_incidence - cos_inside) / (index * cos_incidence + cos_inside);
  return {s * s, p * p};
}

double clear_pane(double cos_incidence, double index) {
  const auto [s, p] = fresnel(cos_incidence, index);
  return 0.5 * ((1.0 - s) / (1.0 + s) + (1.0 - p) / (1.0 + p));
}

}  // namespace

constexpr std::size_t kFewEdges = 256;

struct RayVisibility::Device {
  EmbreeDevice device;
  std::vector<std::uint32_t> opaque, glass;  ///< triangle of the soup behind each primitive
  EmbreeScene opaque_scene, glass_scene;
};

RayVisibility::RayVisibility(const TriangleSoup& soup, const std::vector<Material>& materials)
    : soup_(soup),
      materials_(materials),
      adjacency_(soup),
      lift_m_(std::max(1e-5, 4.0 * 0x1.0p-24 * extent_of(soup))),
      device_(std::make_unique<Device>()) {
  for (std::uint32_t t = 0; t < soup.size(); ++t) {
    (materials[soup.material[t]].is_glass() ? device_->glass : device_->opaque).push_back(t);
  }
  device_->device.reset(rtcNewDevice(nullptr));
  if (!device_->device) throw ResourceError("there is no ray-tracing device");
  device_->opaque_scene = build_scene(device_->device.get(), soup, device_->opaque);
  device_->glass_scene = build_scene(device_->device.get(), soup, device_->glass);
  if (!has_glass()) few_edges_ = few_sharp_edges(soup, adjacency_, kFewEdges);
  std::vector<bool> is_opaque(soup.size(), false);
  for (const std::uint32_t t : device_->opaque) is_opaque[t] = true;
  const auto look_down = [this](Vec3 from) -> std::optional<FloatingParts::Below> {
    const auto hit = first_hit(from, -1.0 * kZenith);
    if (!hit) return std::nullopt;
    return FloatingParts::Below{hit->triangle, hit->distance_m};
  };
  floating_parts_ = FloatingParts(soup, adjacency_, is_opaque, look_down);
}

RayVisibility::~RayVisibility() = default;

bool RayVisibility::has_glass() const { return !device_->glass.empty(); }

Vec3 RayVisibility::normal(std::uint32_t triangle) const {
  const auto& [a, b, c] = soup_.triangles[triangle];
  return normalized(
      cross(soup_.vertices[b] - soup_.vertices[a], soup_.vertices[c] - soup_.vertices[a]));
}

Vec3 RayVisibility::on_plane(std::uint32_t triangle, Vec3 point) const {
  const Vec3 n = normal(triangle);
  if (!is_finite(n)) return point;  // a sliver without a plane
  return point - dot(point - soup_.vertices[soup_.triangles[triangle][0]], n) * n;
}

bool RayVisibility::is_occluded(Vec3 origin, Vec3 direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  alignas(16) RTCRay ray;
  set_ray(ray, origin, direction);
  rtcOccluded1(device_->opaque_scene.get(), &context, &ray);
  return ray.tfar < 0.0F;
}

std::optional<RayHit> RayVisibility::first_hit(Vec3 origin, Vec3 direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  alignas(16) RTCRayHit query;
  set_ray(query.ray, origin, direction);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(device_->opaque_scene.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{device_->opaque[query.hit.primID], query.ray.tfar};
}

std::optional<std::uint32_t> RayVisibility::triangle_at(Vec3 point) const {
  // Point and triangle are off by half a step of a float each.
  constexpr double kStep = 0x1.0p-23;
  const double largest = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z), 1e-3});
  PointSearch search{soup_, device_->opaque, point, kStep * largest, std::nullopt};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  alignas(16) RTCPointQuery query;
  query.x = static_cast<float>(point.x);
  query.y = static_cast<float>(point.y);
  query.z = static_cast<float>(point.z);
  query.time = 0.0F;
  query.radius = static_cast<float>(4.0 * search.within_m);  // the tree of boxes is of floats
  rtcPointQuery(device_->opaque_scene.get(), &query, &context, is_at_point, &search);
  return search.found;
}

void RayVisibility::first_triangles(Vec3 origin, std::span<const Vec3> direction,
                                    std::span<std::uint32_t> triangle) const {
  expects(direction.size() == triangle.size(), "a ray has a direction and a result");
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) RTCRayHit16 query{};
  alignas(64) int valid[kPacket];
  for (std::size_t begin = 0; begin < direction.size(); begin += kPacket) {
    const std::size_t count = std::min<std::size_t>(kPacket, direction.size() - begin);
    for (std::size_t i = 0; i < kPacket; ++i) {
      const Vec3 d = direction[begin + std::min(i, count - 1)];
      valid[i] = i < count ? -1 : 0;
      query.ray.org_x[i] = static_cast<float>(origin.x);
      query.ray.org_y[i] = static_cast<float>(origin.y);
      query.ray.org_z[i] = static_cast<float>(origin.z);
      query.ray.dir_x[i] = static_cast<float>(d.x);
      query.ray.dir_y[i] = static_cast<float>(d.y);
      query.ray.dir_z[i] = static_cast<float>(d.z);
      query.ray.tfar[i] = std::numeric_limits<float>::infinity();
      query.ray.mask[i] = ~0U;
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, device_->opaque_scene.get(), &context, &query);
    for (std::size_t i = 0; i < count; ++i) {
      triangle[begin + i] = query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                                ? kNoTriangle
                                : device_->opaque[query.hit.primID[i]];
    }
  }
}

double RayVisibility::glass_transmission(Vec3 origin, Vec3 direction, double distance_m) const {
  if (!has_glass()) return 1.0;
  GlassQuery query{{}, this, &device_->glass, direction, 1.0};
  rtcInitIntersectContext(&query.context);
  query.context.filter = &gather_pane;
  alignas(16) RTCRay ray;
  set_ray(ray, origin, direction);
  ray.tfar = static_cast<float>(distance_m);
  rtcOccluded1(device_->glass_scene.get(), &query.context, &ray);
  return query.transmission;
}

void RayVisibility::find_panes(Vec3 origin, Vec3 direction, double distance_m,
                               std::vector<RayHit>& panes) const {
  panes.clear();
  if (!has_glass()) return;
  PaneQuery query{{}, &device_->glass, &panes};
  rtcInitIntersectContext(&query.context);
  query.context.filter = &gather_hit;
  alignas(16) RTCRay ray;
  set_ray(ray, origin, direction);
  ray.tfar = static_cast<float>(distance_m);
  rtcOccluded1(device_->glass_scene.get(), &query.context, &ray);
  const auto height_m = [&](std::uint32_t t, Vec3 p) {
    return std::abs(dot(normal(t), p - soup_.vertices[soup_.triangles[t][0]]));
  };
  std::erase_if(
      panes, [&](const RayHit& hit) { return !(height_m(hit.triangle, origin) > 0.5 * lift_m_); });
  std::sort(panes.begin(), panes.end(), [](const RayHit& a, const RayHit& b) {
    return a.distance_m < b.distance_m || (a.distance_m == b.distance_m && a.triangle < b.triangle);
  });
  const auto is_again = [&](const RayHit& a, const RayHit& b) {
    return height_m(a.triangle, origin + b.distance_m * direction) < lift_m_ &&
           std::abs(dot(normal(a.triangle), normal(b.triangle))) > kOnePlane;
  };
  panes.erase(std::unique(panes.begin(), panes.end(), is_again), panes.end());
}

void RayVisibility::transmission(std::span<const Vec3> origin, std::span<const Vec3> direction,
                                 std::span<float> result) const {
  expects(origin.size() == direction.size() && origin.size() == result.size(),
          "a ray has an origin, a direction and a result");
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t begin = 0; begin < origin.size(); begin += kPacket) {
    const std::size_t count = std::min<std::size_t>(kPacket, origin.size() - begin);
    alignas(64) RTCRay16 rays;
    alignas(64) int valid[kPacket];
    for (std::size_t i = 0; i < kPacket; ++i) {
      const std::size_t k = begin + std::min(i, count - 1);
      valid[i] = i < count ? -1 : 0;
      RTCRay ray;
      set_ray(ray, origin[k], direction[k]);
      rays.org_x[i] = ray.org_x, rays.org_y[i] = ray.org_y, rays.org_z[i] = ray.org_z;
      rays.dir_x[i] = ray.dir_x, rays.dir_y[i] = ray.dir_y, rays.dir_z[i] = ray.dir_z;
      rays.tnear[i] = ray.tnear, rays.tfar[i] = ray.tfar, rays.time[i] = 0.0F;
      rays.mask[i] = ~0U, rays.id[i] = 0, rays.flags[i] = 0;
    }
    rtcOccluded16(valid, device_->opaque_scene.get(), &context, &rays);
    for (std::size_t i = 0; i < count; ++i) result[begin + i] = rays.tfar[i] < 0.0F ? 0.0F : 1.0F;
  }
  if (!has_glass()) return;
  for (std::size_t k = 0; k < origin.size(); ++k) {
    if (result[k] > 0.0F) {
      result[k] = static_cast<float>(glass_transmission(origin[k], direction[k]));
    }
  }
}

double pane_transmittance(const Material& glass, double cos_incidence) {
  if (glass.index > 0.0) return clear_pane(cos_incidence, glass.index);
  return glass.transmittance * clear_pane(cos_incidence, kUsualIndex) /
         clear_pane(1.0, kUsualIndex);
}

double pane_reflectance(const Material& glass, double cos_incidence) {
  const double clear =
      1.0 - clear_pane(cos_incidence, glass.index > 0.0 ? glass.index : kUsualIndex);
  return std::min(clear, 1.0 - pane_transmittance(glass, cos_incidence));
}

}  // namespace tenku
