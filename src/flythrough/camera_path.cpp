#include "flythrough/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/error.h"

namespace tenku {
namespace {

constexpr int kPieces = 256;  // of a span, to measure its length
constexpr double kMostFrames = 1e6;

/// The four keys about a span; at the ends the outer one is mirrored.
using Around = std::array<Vec3, 4>;

Vec3 blend(Vec3 a, Vec3 b, double ta, double tb, double t) {
  return tb > ta ? ((tb - t) / (tb - ta)) * a + ((t - ta) / (tb - ta)) * b : a;
}

/// Barry and Goldman's pyramid over centripetal knots.
Vec3 catmull_rom(const Around& p, double u) {
  std::array<double, 4> k{};
  for (std::size_t i = 1; i < 4; ++i) k[i] = k[i - 1] + std::sqrt(length(p[i] - p[i - 1]));
  if (!(k[2] > k[1])) return p[1];
  const double t = k[1] + u * (k[2] - k[1]);
  const Vec3 a1 = blend(p[0], p[1], k[0], k[1], t), a2 = blend(p[1], p[2], k[1], k[2], t),
             a3 = blend(p[2], p[3], k[2], k[3], t);
  const Vec3 b1 = blend(a1, a2, k[0], k[2], t), b2 = blend(a2, a3, k[1], k[3], t);
  return blend(b1, b2, k[1], k[2], t);
}

class PathSampler {
 public:
  explicit PathSampler(const CameraPathRequest& request) : request_(request) {
    travelled_.push_back(0.0);
    for (std::size_t s = 0; s + 1 < request_.keys.size(); ++s) measure(s);
  }

  CameraFrame at(double time_s) const {
    const auto& keys = request_.keys;
    if (keys.size() == 1) return frame(0, 0.0, time_s);
    if (request_.speed == PathSpeed::Keyed) {
      std::size_t s = 0;
      while (s + 2 < keys.size() && keys[s + 1].time_s <= time_s) ++s;
      const double whole = keys[s + 1].time_s - keys[s].time_s;
      return frame(s, by_length(s, (time_s - keys[s].time_s) / whole), time_s);
    }
    const double whole = keys.back().time_s - keys.front().time_s;
    double u = (time_s - keys.front().time_s) / whole;
    if (request_.speed == PathSpeed::Eased) u = u * u * (3.0 - 2.0 * u);
    return on_way(u, time_s);
  }

 private:
  Vec3 position(std::size_t s, double u, Vec3 CameraKey::*which) const {
    const auto& keys = request_.keys;
    const Vec3 a = keys[s].*which, b = keys[s + 1].*which;
    if (request_.curve == PathCurve::Straight) return a + u * (b - a);
    const Vec3 before = s > 0 ? keys[s - 1].*which : 2.0 * a - b;
    const Vec3 after = s + 2 < keys.size() ? keys[s + 2].*which : 2.0 * b - a;
    return catmull_rom({before, a, b, after}, u);
  }

  void measure(std::size_t s) {
    std::array<double, kPieces + 1> so_far{};
    Vec3 last = position(s, 0.0, &CameraKey::eye);
    for (std::size_t i = 1; i <= kPieces; ++i) {
      const Vec3 next = position(s, static_cast<double>(i) / kPieces, &CameraKey::eye);
      so_far[i] = so_far[i - 1] + length(next - last);
      last = next;
    }
    travelled_.push_back(travelled_.back() + so_far.back());
    pieces_.push_back(so_far);
  }

  /// Place on span `s` where the given share of its length is behind.
  double by_length(std::size_t s, double share) const {
    const auto& so_far = pieces_[s];
    if (!(so_far.back() > 0.0)) return share;  // the eye stands, the target may turn
    const double goal = std::clamp(share, 0.0, 1.0) * so_far.back();
    const auto above = std::upper_bound(so_far.begin() + 1, so_far.end() - 1, goal);
    const double low = *(above - 1), piece = *above - low;
    const double inside = piece > 0.0 ? (goal - low) / piece : 0.0;
    return (static_cast<double>(above - 1 - so_far.begin()) + inside) / kPieces;
  }

  CameraFrame on_way(double share, double time_s) const {
    const double whole = travelled_.back();
    const auto spans = static_cast<double>(pieces_.size());
    if (!(whole > 0.0)) {  // a camera that only turns: evenly over the keys
      const double at = share * spans;
      const auto s = static_cast<std::size_t>(std::min(at, spans - 1.0));
      return frame(s, at - static_cast<double>(s), time_s);
    }
    const double goal = share * whole;
    std::size_t s = 0;
    while (s + 1 < pieces_.size() && travelled_[s + 1] <= goal) ++s;
    const double here = travelled_[s + 1] - travelled_[s];
    return frame(s, by_length(s, here > 0.0 ? (goal - travelled_[s]) / here : 0.0), time_s);
  }

  CameraFrame frame(std::size_t s, double u, double time_s) const {
    const auto& keys = request_.keys;
    if (keys.size() == 1) return {time_s, keys[0].eye, keys[0].target, keys[0].horizontal_fov};
    const Angle a = keys[s].horizontal_fov, b = keys[s + 1].horizontal_fov;
    return {time_s, position(s, u, &CameraKey::eye), position(s, u, &CameraKey::target),
            a + u * (b - a)};
  }

  const CameraPathRequest& request_;
  std::vector<double> travelled_;                        ///< [key], to it
  std::vector<std::array<double, kPieces + 1>> pieces_;  ///< [span], lengths along it
};

void check(const CameraPathRequest& request) {
  if (request.keys.empty()) throw InputError("the path has no keys");
  for (std::size_t k = 1; k < request.keys.size(); ++k) {
    if (!(request.keys[k].time_s > request.keys[k - 1].time_s)) {
      throw InputError("key " + std::to_string(k + 1) + " of the path is not later than key " +
                       std::to_string(k));
    }
  }
  if (!(request.frames_per_s > 0.0 && request.frames_per_s <= 1000.0)) {
    throw InputError("frames a second must be within (0, 1000]");
  }
}

void put_on_ground(CameraFrame& frame, double height_m, const GroundHeight& ground) {
  const auto z = ground ? ground(frame.eye.x, frame.eye.y) : std::nullopt;
  if (!z) {
    throw InputError("the walk has no ground under its eye at time " +
                     std::to_string(frame.time_s) + " s");
  }
  const double rise = *z + height_m - frame.eye.z;
  frame.eye.z += rise;
  frame.target.z += rise;
}

}  // namespace

PerspectiveView CameraPath::view(std::size_t frame) const {
  const CameraFrame& f = frames[frame];
  return {f.eye, f.target, f.horizontal_fov, width, height};
}

double CameraPath::length_m() const {
  double sum = 0.0;
  for (std::size_t f = 1; f < frames.size(); ++f) {
    sum += length(frames[f].eye - frames[f - 1].eye);
  }
  return sum;
}

CameraPath make_camera_path(const CameraPathRequest& request, const GroundHeight& ground) {
  check(request);
  const double from = request.keys.front().time_s;
  const double span =
      request.keys.size() == 1 ? request.standing_s : request.keys.back().time_s - from;
  const double count = std::floor(span * request.frames_per_s + 1e-6);
  if (!(count >= 0.0 && count < kMostFrames)) {
    throw InputError("the path has more than a million frames, or a time that is no number");
  }
  CameraPath path{request.width, request.height, request.frames_per_s, {}};
  const PathSampler sampler(request);
  for (std::size_t f = 0; f <= static_cast<std::size_t>(count); ++f) {
    const double time = from + static_cast<double>(f) / request.frames_per_s;
    path.frames.push_back(sampler.at(time));
    if (request.walk_height_m) put_on_ground(path.frames.back(), *request.walk_height_m, ground);
    const PerspectiveCamera checked(path.view(f));  // refuses what is no view
  }
  if (path.size() > 1 && span > 0.0) path.frames.pop_back();  // n frames in n / rate seconds
  return path;
}

}  // namespace tenku
