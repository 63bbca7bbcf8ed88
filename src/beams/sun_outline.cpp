#include "beams/sun_outline.h"

#include <algorithm>

namespace tenku {
namespace {

constexpr double kOnLine = 1e-9;     // m
constexpr double kSmallest = 1e-10;  // m2: a tenth of a millimetre by a micrometre

void drop_if_nothing(SunOutline& outline) {
  if (outline.size() < 3 || area_of(outline) < kSmallest) outline.clear();
}

}  // namespace

BeamFrame::BeamFrame(Vec3 direction) : along(direction) {
  const TangentFrame frame = tangent_frame(direction);
  x_axis = frame.tangent;
  y_axis = frame.bitangent;
}

DepthPlane::DepthPlane(const BeamFrame& frame, Vec3 point, Vec3 normal) {
  const double along = dot(normal, frame.along);
  at_origin = dot(normal, point) / along;
  slope_x = -dot(normal, frame.x_axis) / along;
  slope_y = -dot(normal, frame.y_axis) / along;
}

HalfPlane HalfPlane::left_of(AcrossPoint from, AcrossPoint to) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double far = std::max(std::hypot(dx, dy), 1e-300);
  return {-dy / far, dx / far, (dy * from.x - dx * from.y) / far};
}

std::pair<SunOutline, SunOutline> split(const SunOutline& outline, const HalfPlane& half) {
  std::vector<double> height;
  height.reserve(outline.size());
  bool any_in = false, any_out = false;
  for (const AcrossPoint& p : outline) {
    double h = half.height(p);
    if (std::abs(h) < kOnLine) h = 0.0;
    any_in = any_in || h > 0.0;
    any_out = any_out || h < 0.0;
    height.push_back(h);
  }
  if (!any_out) return {outline, {}};
  if (!any_in) return {{}, outline};
  SunOutline in, out;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const std::size_t next = k + 1 < outline.size() ? k + 1 : 0;
    const AcrossPoint a = outline[k], b = outline[next];
    if (height[k] >= 0.0) in.push_back(a);
    if (height[k] <= 0.0) out.push_back(a);
    if (height[k] * height[next] < 0.0) {
      const double t = height[k] / (height[k] - height[next]);
      const AcrossPoint at{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
      in.push_back(at);
      out.push_back(at);
    }
  }
  drop_if_nothing(in);
  drop_if_nothing(out);
  return {std::move(in), std::move(out)};
}

CutOutline cut_by(const SunOutline& outline, const SunOutline& knife) {
  CutOutline cut{outline, {}};
  for (std::size_t k = 0; k < knife.size() && !cut.inside.empty(); ++k) {
    auto [in, out] =
        split(cut.inside, HalfPlane::left_of(knife[k], knife[k + 1 < knife.size() ? k + 1 : 0]));
    cut.inside = std::move(in);
    if (!out.empty()) cut.outside.push_back(std::move(out));
  }
  return cut;
}

double area_of(const SunOutline& outline) {
  double twice = 0.0;
  for (std::size_t k = 2; k < outline.size(); ++k) {
    const AcrossPoint o = outline[0], a = outline[k - 1], b = outline[k];
    twice += (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
  }
  return 0.5 * twice;
}

SunOutline outline_of(const BeamFrame& frame, const std::vector<Vec3>& corners) {
  SunOutline outline;
  outline.reserve(corners.size());
  for (const Vec3& p : corners) outline.push_back(frame.across(p));
  if (area_of(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  return outline;
}

}  // namespace tenku
