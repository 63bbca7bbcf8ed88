#include "visibility/shadow_maps.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/extent.h"
#include "core/parallel.h"
#include "visibility/caster_map.h"
#include "visibility/caster_set.h"
#include "visibility/ray_visibility.h"

namespace tenku {
namespace {

constexpr double kRounding = 1e-4;       // m: points and planes of a scene meet within this
constexpr double kSmallestTexel = 1e-3;  // m: positions in float are good to 0.25 mm at 4 km
// Local origins lie on a grid of this pitch, in metres, so that neighbouring regions share one.
constexpr double kOriginPitch = 4096.0;
// Depth is resolved up to this distance in front of the points, in metres: 32-bit floats tell 1 mm
// there. All that is farther shades alike.
constexpr double kDepthReach = 16384.0;
constexpr std::size_t kGrain = 4096;  // points in a task

/// Where a map lies and how it is divided.
struct MapPlan {
  LightAxes axes;
  Vec3 origin;     ///< of what is drawn
  Vec3 low, high;  ///< of the points, along the axes, from `origin`
  int width, height;
  double texel_u, texel_v;
  double corner_u, corner_v;  ///< of the map

  MapPlan(Vec3 direction, std::span<const Vec3> points, const ShadowMapOptions& options)
      : axes(direction) {
    Extent all;
    std::vector<Extent> parts(  // along the axes of the light
        (points.size() + kGrain - 1) / kGrain);
    parallel_for(parts.size(), 1, [&](IndexRange range) {
      for (std::size_t k = range.begin; k < range.end; ++k) {
        Extent part;
        for (std::size_t i = k * kGrain; i < std::min(points.size(), (k + 1) * kGrain); ++i) {
          const Vec3& p = points[i];
          part.add({dot(axes.u, p), dot(axes.v, p), dot(axes.w, p)});
        }
        parts[k] = part;
      }
    });
    for (const Extent& part : parts) all.add(part.min), all.add(part.max);
    const Vec3 middle = all.middle();
    const Vec3 centre = middle.x * axes.u + middle.y * axes.v + middle.z * axes.w;
    const auto on_grid = [](double x) { return kOriginPitch * std::round(x / kOriginPitch); };
    origin = {on_grid(centre.x), on_grid(centre.y), on_grid(centre.z)};
    const Vec3 shift{dot(axes.u, origin), dot(axes.v, origin), dot(axes.w, origin)};
    low = all.min - shift, high = all.max - shift;
    divide(options);
  }

  /// The points and a texel all around them: each look-up needs the centres on either side.
  void divide(const ShadowMapOptions& options) {
    const auto across = [&](double range) {
      return std::max(kSmallestTexel, range / (options.texels - 2));
    };
    texel_u = across(high.x - low.x), texel_v = across(high.y - low.y);
    width = height = options.texels;
    if (options.square_texels) {
      const double side = std::max(texel_u, texel_v);
      const auto count = [&](double range) {
        return std::min(options.texels, static_cast<int>(std::ceil(range / side)) + 2);
      };
      width = count(high.x - low.x), height = count(high.y - low.y);
      texel_u = texel_v = side;
    }
    corner_u = 0.5 * (low.x + high.x) - 0.5 * width * texel_u;
    corner_v = 0.5 * (low.y + high.y) - 0.5 * height * texel_v;
  }

  LightBox box() const {
    const Vec3 shift{dot(axes.u, origin), dot(axes.v, origin), dot(axes.w, origin)};
    const Vec3 from{corner_u, corner_v, low.z};
    const Vec3 to{corner_u + width * texel_u, corner_v + height * texel_v, high.z};
    return {axes, from + shift, to + shift};
  }

  /// Where the points lie, each with a texel about it.
  LightCells cells(const LightBox& box, std::span<const Vec3> points) const {
    LightCells made(box.low.x, box.low.y, box.high.x, box.high.y);
    for (const Vec3& p : points) {
      const double u = dot(axes.u, p), v = dot(axes.v, p);
      made.add(u - texel_u, v - texel_v), made.add(u + texel_u, v - texel_v);
      made.add(u - texel_u, v + texel_v), made.add(u + texel_u, v + texel_v);
    }
    made.sum_up();
    return made;
  }

  /// @param nearest  coordinate along w of the caster nearest to the light, from `origin`
  MapFrame frame(double nearest) const {
    const double back = low.z - 1.0;
    const double front = std::min(nearest, high.z + kDepthReach) + 1.0;
    const auto row = [](Vec3 axis, double from, double to) {
      const double scale = 2.0 / (to - from);
      return std::array<float, 4>{
          static_cast<float>(scale * axis.x), static_cast<float>(scale * axis.y),
          static_cast<float>(scale * axis.z), static_cast<float>(-scale * 0.5 * (from + to))};
    };
    return {width,
            height,
            {row(axes.u, corner_u, corner_u + width * texel_u),
             row(axes.v, corner_v, corner_v + height * texel_v), row(axes.w, front, back)}};
  }
};

/// A map that has been drawn, to be asked.
class DrawnMap {
 public:
  DrawnMap(const MapPlan& plan, const CasterSet& casters, const std::vector<std::uint32_t>& id)
      : plan_(plan),
        casters_(casters),
        id_(id),
        step_u_(plan.texel_u * plan.axes.u),
        step_v_(plan.texel_v * plan.axes.v),
        to_u_(1.0 / plan.texel_u * plan.axes.u),
        to_v_(1.0 / plan.texel_v * plan.axes.v),
        first_u_(dot(to_u_, plan.origin) + plan.corner_u / plan.texel_u + 0.5),
        first_v_(dot(to_v_, plan.origin) + plan.corner_v / plan.texel_v + 0.5) {}

  /// Visible fraction of the light at a point of a surface.
  float lit_fraction(Vec3 point, Vec3 normal) const {
    if (!(dot(normal, plan_.axes.w) > 0.0)) return 0.0F;
    const double x = dot(to_u_, point) - first_u_, y = dot(to_v_, point) - first_v_;
    // The points lie half a texel or more inside the outermost centres, but for rounding; a
    // coordinate that is no number goes to the edge.
    const int i = static_cast<int>(std::min(std::max(0.0, x), plan_.width - 2.0));
    const int j = static_cast<int>(std::min(std::max(0.0, y), plan_.height - 2.0));
    const auto width = static_cast<std::size_t>(plan_.width);
    const std::uint32_t* below =
        &id_[static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i)];
    const std::array<std::uint32_t, 4> id{below[0], below[1], below[width], below[width + 1]};
    if (id[0] == id[1] && id[0] == id[2] && id[0] == id[3]) {
      // A triangle about all four centres is about the point.
      return id[0] == CasterMap::kNothing || !is_behind(id[0] - 1, point) ? 1.0F : 0.0F;
    }
    return filtered(id, point, normal, {x - i, y - j});
  }

 private:
  enum class Texel {
    Open,     ///< its triangle cannot shade the point
    Hides,    ///< its triangle shades the point
    Beside,   ///< an outline of its triangle runs between
    Blurred,  ///< its triangle shades something there, too much lies between to tell what
  };
  struct Across {
    double u, v;  ///< texels from the point to the centre of the texel
  };

  /// @param id  of the texels at the left and right, below and then above
  /// @param at  texels from the first one's centre to the point, 0 to 1
  float filtered(const std::array<std::uint32_t, 4>& id, Vec3 point, Vec3 normal, Across at) const {
    const double right = std::clamp(at.u, 0.0, 1.0), up = std::clamp(at.v, 0.0, 1.0);
    double lit = 0.0;
    bool is_open = false;
    std::uint32_t last = CasterMap::kNothing;
    Texel found = Texel::Open;
    const unsigned nearest = (right > 0.5 ? 1U : 0U) | (up > 0.5 ? 2U : 0U);
    for (const unsigned step : {0U, 1U, 3U, 2U}) {  // around: neighbours often show the same
      const unsigned k = nearest ^ step;
      const bool is_right = (k & 1U) != 0, is_up = (k & 2U) != 0;
      if (id[k] == CasterMap::kNothing) {
        found = Texel::Open;
      } else if (id[k] != last) {
        found = ask(id[k] - 1, point, normal,
                    {(is_right ? 1.0 : 0.0) - at.u, (is_up ? 1.0 : 0.0) - at.v});
      }
      last = id[k];
      if (found == Texel::Hides) return 0.0F;
      is_open = is_open || found == Texel::Open;
      if (found != Texel::Blurred) lit += (is_right ? right : 1 - right) * (is_up ? up : 1 - up);
    }
    return is_open ? static_cast<float>(std::min(1.0, lit)) : 0.0F;
  }

  bool is_behind(std::uint32_t triangle, Vec3 point) const {
    return casters_.is_behind(triangle, point, plan_.axes.w, kRounding);
  }

  Texel ask(std::uint32_t triangle, Vec3 point, Vec3 normal, Across across) const {
    if (!is_behind(triangle, point)) return Texel::Open;
    const CasterPlane& plane = casters_.plane(triangle);
    const Cover cover = casters_.cover(triangle, point, plan_.axes, kRounding);
    if (cover == Cover::Hides) return Texel::Hides;
    // The triangle at the centre of the texel, above the plane of the point's surface.
    const Vec3 way = across.u * step_u_ + across.v * step_v_;
    const double depth =
        -(dot(plane.normal, point + way) - plane.offset) / dot(plane.normal, plan_.axes.w);
    if (!(dot(normal, way + depth * plan_.axes.w) > kRounding)) return Texel::Open;
    return cover == Cover::Beside ? Texel::Beside : Texel::Blurred;
  }

  const MapPlan& plan_;
  const CasterSet& casters_;
  const std::vector<std::uint32_t>& id_;
  Vec3 step_u_, step_v_;      ///< from texel to texel
  Vec3 to_u_, to_v_;          ///< from position to texels
  double first_u_, first_v_;  ///< of the centre of the first texel
};

/// A context with the casters about one origin.
struct Drawer {
  CasterMap map;
  std::optional<Vec3> origin;

  Drawer(GlPlatform platform, const GlLibraries& libraries) : map(platform, libraries) {}

  void fill(const CasterSet& casters, Vec3 about) {
    if (origin == about) return;
    origin.reset();
    map.upload(casters.vertices(about));
    origin = about;
  }
};

/// The triangles of glass alone.
TriangleSoup panes_of(const TriangleSoup& soup, const std::vector<Material>& materials) {
  TriangleSoup panes;
  for (std::size_t t = 0; t < soup.size(); ++t) {
    if (!materials[soup.material[t]].is_glass()) continue;
    if (panes.vertices.empty()) panes.vertices = soup.vertices;
    panes.triangles.push_back(soup.triangles[t]);
    panes.object.push_back(soup.object[t]);
    panes.surface_type.push_back(soup.surface_type[t]);
    panes.material.push_back(soup.material[t]);
  }
  return panes;
}

void check_texels(int texels) {
  constexpr int kLeast = 8, kMost = 16384;
  if (!(texels >= kLeast && texels <= kMost)) {
    throw InputError("a shadow map has 8 to 16384 texels on a side, not " + std::to_string(texels));
  }
}

/// The box about the points and `reach_m` more on every side.
Extent reach_of(std::span<const Vec3> points, double reach_m) {
  Extent box;
  if (std::isinf(reach_m)) {
    constexpr double kAll = std::numeric_limits<double>::infinity();
    box.min = {-kAll, -kAll, -kAll}, box.max = {kAll, kAll, kAll};
    return box;
  }
  box = extent_of(points);
  box.min = box.min - Vec3{reach_m, reach_m, reach_m};
  box.max = box.max + Vec3{reach_m, reach_m, reach_m};
  return box;
}

}  // namespace

struct ShadowMaps::State {
  GlPlatform platform;
  GlLibraries libraries;
  CasterSet casters;
  TriangleSoup pane_soup;
  std::unique_ptr<RayVisibility> panes;  ///< null without glass
  std::atomic<std::uint64_t> drawn = 0;
  std::mutex lock;
  std::vector<std::unique_ptr<Drawer>> idle;

  State(const TriangleSoup& soup, const std::vector<Material>& materials,
        const ShadowMapOptions& how)
      : libraries(how.libraries), casters(soup, materials), pane_soup(panes_of(soup, materials)) {
    if (pane_soup.size() > 0) panes = std::make_unique<RayVisibility>(pane_soup, materials);
    idle.push_back(std::make_unique<Drawer>(how.platform, how.libraries));
    platform = idle.front()->map.context().platform();
  }

  /// A context that no other call uses, if possible with the casters about the same origin.
  std::unique_ptr<Drawer> take(Vec3 origin) {
    {
      const std::lock_guard<std::mutex> guard(lock);
      const auto same = std::find_if(idle.begin(), idle.end(),
                                     [&](const auto& one) { return one->origin == origin; });
      if (!idle.empty()) {
        std::swap(same == idle.end() ? idle.back() : *same, idle.back());
        std::unique_ptr<Drawer> taken = std::move(idle.back());
        idle.pop_back();
        return taken;
      }
    }
    return std::make_unique<Drawer>(platform, libraries);
  }

  CasterSet::Selection select(const MapPlan& plan, std::span<const Vec3> points,
                              double reach_m) const {
    LightBox box = plan.box();
    const LightCells cells = plan.cells(box, points);
    box.cells = &cells;
    return casters.before(box, reach_of(points, reach_m));
  }

  /// Draws and hands the context back before anything runs in parallel: a thread that waits for a
  /// loop may take up another direction, which needs a context of its own.
  std::vector<std::uint32_t> draw(const MapPlan& plan, std::span<const Vec3> points,
                                  double reach_m) {
    const CasterSet::Selection found = select(plan, points, reach_m);
    std::vector<std::uint32_t> id;
    if (found.casters.empty()) {
      id.assign(static_cast<std::size_t>(plan.width) * plan.height, CasterMap::kNothing);
      return id;
    }
    std::unique_ptr<Drawer> drawer = take(plan.origin);
    drawer->fill(casters, plan.origin);
    drawer->map.draw(plan.frame(found.nearest - dot(plan.axes.w, plan.origin)), found.casters, id);
    ++drawn;
    const std::lock_guard<std::mutex> guard(lock);
    idle.push_back(std::move(drawer));
    return id;
  }
};

ShadowMaps::ShadowMaps(const TriangleSoup& soup, const std::vector<Material>& materials,
                       const ShadowMapOptions& options)
    : options_(options) {
  check_texels(options.texels);
  state_ = std::make_shared<State>(soup, materials, options);
  description_ = state_->idle.front()->map.context().description();
}

ShadowMaps::ShadowMaps(std::shared_ptr<State> state, const ShadowMapOptions& options,
                       double reach_m)
    : state_(std::move(state)), options_(options), reach_m_(reach_m) {}

ShadowMaps ShadowMaps::with(int texels, double reach_m) const {
  check_texels(texels);
  ShadowMapOptions options = options_;
  options.texels = texels;
  ShadowMaps made(state_, options, reach_m);
  made.description_ = description_;
  return made;
}

ShadowMaps::~ShadowMaps() = default;

void ShadowMaps::transmission_from(Vec3 direction, std::span<const Vec3> point,
                                   std::span<const Vec3> normal, std::span<float> result) const {
  expects(point.size() == result.size() && (normal.empty() || normal.size() == point.size()),
          "a point has a normal and a result");
  if (point.empty()) return;
  const MapPlan plan(direction, point, options_);
  const std::vector<std::uint32_t> id = state_->draw(plan, point, reach_m_);
  const DrawnMap map(plan, state_->casters, id);
  parallel_for(point.size(), kGrain, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      result[k] = map.lit_fraction(point[k], normal.empty() ? direction : normal[k]);
      if (state_->panes && result[k] > 0.0F) {
        result[k] *= static_cast<float>(state_->panes->glass_transmission(point[k], direction));
      }
    }
  });
}

void ShadowMaps::transmission(std::span<const Vec3> origin, std::span<const Vec3> direction,
                              std::span<float> result) const {
  expects(origin.size() == direction.size() && origin.size() == result.size(),
          "a ray has an origin, a direction and a result");
  std::vector<std::size_t> order(origin.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t k) {
    return std::tuple(direction[k].x, direction[k].y, direction[k].z);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<Vec3> point;
  std::vector<float> seen;
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    point.clear();
    for (end = begin; end < order.size() && key(order[end]) == key(order[begin]); ++end) {
      point.push_back(origin[order[end]]);
    }
    seen.resize(point.size());
    transmission_from(direction[order[begin]], point, {}, seen);
    for (std::size_t k = begin; k < end; ++k) result[order[k]] = seen[k - begin];
  }
}

ShadowMaps::Texel ShadowMaps::texel(Vec3 direction, std::span<const Vec3> point) const {
  const MapPlan plan(direction, point, options_);
  return {plan.texel_u, plan.texel_v};
}

std::size_t ShadowMaps::triangles_drawn(Vec3 direction, std::span<const Vec3> point) const {
  const MapPlan plan(direction, point, options_);
  std::size_t count = 0;
  for (const CasterRange& range : state_->select(plan, point, reach_m_).casters) {
    count += range.count;
  }
  return count;
}

std::uint64_t ShadowMaps::maps_drawn() const { return state_->drawn; }

}  // namespace tenku
