#include "form_factors/exchange_area.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace tenku {
namespace {

struct Node {
  double at, weight;
};

/// Nodes of the Gauss-Legendre rule on [0, 1]: roots of the polynomial, by Newton's iteration from
/// Tricomi's approximation.
std::vector<Node> gauss_legendre(int count) {
  std::vector<Node> nodes;
  for (int k = 0; k < count; ++k) {
    double x = std::cos(kPi * (k + 0.75) / (count + 0.5)), slope = 1.0;
    for (int step = 0; step < 8; ++step) {
      double last = 1.0, value = x;
      for (int n = 2; n <= count; ++n) {
        last = std::exchange(value, ((2 * n - 1) * x * value - (n - 1) * last) / n);
      }
      slope = count * (x * value - last) / (x * x - 1.0);
      x -= value / slope;
    }
    nodes.push_back({0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope)});
  }
  return nodes;
}

/// Nodes of the double exponential rule on [0, 1] for functions that are singular at the ends.
std::vector<Node> double_exponential() {
  constexpr double kStep = 1.0 / 12.0, kReach = 3.4;
  std::vector<Node> nodes;
  for (int k = 0; k * kStep <= kReach; ++k) {
    const double u = 0.5 * kPi * std::sinh(k * kStep);
    const double from_end = 1.0 / (1.0 + std::exp(2.0 * u));  // exact where 1 - tanh(u) is not
    const double weight =
        kStep * 0.5 * kPi * std::cosh(k * kStep) * 2.0 * from_end * (1.0 - from_end);
    nodes.push_back({from_end, weight});
    if (k > 0) nodes.push_back({1.0 - from_end, weight});
  }
  return nodes;
}

struct Edge {
  Vec3 from, along;
};

std::vector<Edge> edges_of(const ConvexPolygon& polygon) {
  std::vector<Edge> edges;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 next = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    if (next != polygon[k]) edges.push_back({polygon[k], next - polygon[k]});
  }
  return edges;
}

/// Mean of ln(r / scale) between a point and an edge.
double mean_log(Vec3 point, const Edge& edge, double scale) {
  const double size = length(edge.along);
  const Vec3 unit = (1.0 / size) * edge.along, to = edge.from - point;
  const double begin = dot(to, unit), end = begin + size, height = length(cross(to, unit));
  const auto primitive = [&](double u) {
    const double square = (u * u + height * height) / (scale * scale);
    return square > 0.0 ? 0.5 * u * std::log(square) : 0.0;
  };
  const double angle = std::atan2(height * size, height * height + begin * end);
  return (primitive(end) - primitive(begin) + height * angle) / size - 1.0;
}

/// Where along `edge`, in parts of it, the other one is nearest: its ends, and the line itself.
std::vector<double> nearest_places(const Edge& edge, const Edge& other) {
  const double square = dot(edge.along, edge.along), product = dot(edge.along, other.along);
  const Vec3 to = other.from - edge.from;
  const double begin = dot(to, edge.along) / square, end = begin + product / square;
  std::vector<double> places{0.0, begin, end, 1.0};
  const double sine2 = square * dot(other.along, other.along) - product * product;
  if (sine2 > 1e-12 * square * dot(other.along, other.along)) {
    places.push_back(
        (dot(to, edge.along) * dot(other.along, other.along) - dot(to, other.along) * product) /
        sine2);
  }
  for (double& place : places) place = std::clamp(place, 0.0, 1.0);
  std::sort(places.begin(), places.end());
  return places;
}

/// Mean of ln(r / scale) between two edges.
double mean_log(const Edge& a, const Edge& b, double scale) {
  static const std::vector<Node> kApart = gauss_legendre(10), kNear = double_exponential();
  const double apart = length(b.from + 0.5 * b.along - a.from - 0.5 * a.along) -
                       0.5 * length(a.along) - 0.5 * length(b.along);
  double sum = 0.0;
  if (apart > length(a.along)) {
    for (const auto& [at, weight] : kApart)
      sum += weight * mean_log(a.from + at * a.along, b, scale);
    return sum;
  }
  const std::vector<double> places = nearest_places(a, b);
  for (std::size_t k = 1; k < places.size(); ++k) {
    const double size = places[k] - places[k - 1];
    if (!(size > 0.0)) continue;
    for (const auto& [at, weight] : kNear) {
      sum += size * weight * mean_log(a.from + (places[k - 1] + size * at) * a.along, b, scale);
    }
  }
  return sum;
}

/// Any scale will do, for outlines are closed; one near the distances keeps the terms small.
double by_contours(const ConvexPolygon& a, const ConvexPolygon& b, double scale) {
  double sum = 0.0;
  for (const Edge& one : edges_of(a)) {
    for (const Edge& other : edges_of(b)) {
      const double product = dot(one.along, other.along);
      if (product == 0.0) continue;
      const bool shorter = dot(one.along, one.along) < dot(other.along, other.along);
      sum += product * (shorter ? mean_log(one, other, scale) : mean_log(other, one, scale));
    }
  }
  return std::abs(sum) / (2.0 * kPi);
}

/// Points of a polygon, each with the area that it stands for.
struct AreaPoint {
  Vec3 at;
  double area;
};

std::vector<AreaPoint> area_points(const ConvexPolygon& polygon) {
  static const std::vector<Node> kNodes = gauss_legendre(6);
  std::vector<AreaPoint> points;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Vec3 ab = polygon[k - 1] - polygon[0], bc = polygon[k] - polygon[k - 1];
    const double doubled = length(cross(ab, bc));
    for (const Node& u : kNodes) {
      for (const Node& v : kNodes) {
        points.push_back(
            {polygon[0] + u.at * (ab + v.at * bc), doubled * u.at * u.weight * v.weight});
      }
    }
  }
  return points;
}

Vec3 normal_of(const ConvexPolygon& polygon) {
  Vec3 sum{};
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    sum = sum + cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  }
  return normalized(sum);
}

double by_areas(const ConvexPolygon& a, const ConvexPolygon& b) {
  const Vec3 normal_a = normal_of(a), normal_b = normal_of(b);
  const std::vector<AreaPoint> points = area_points(b);
  double sum = 0.0;
  for (const AreaPoint& p : area_points(a)) {
    for (const AreaPoint& q : points) {
      const Vec3 r = q.at - p.at;
      const double square = dot(r, r);
      sum += p.area * q.area * std::abs(dot(normal_a, r) * dot(normal_b, r)) / (square * square);
    }
  }
  return sum / kPi;
}

Vec3 middle_of(const ConvexPolygon& polygon) {
  const Vec3 sum = std::accumulate(polygon.begin(), polygon.end(), Vec3{});
  return (1.0 / static_cast<double>(polygon.size())) * sum;
}

double radius_about(Vec3 middle, const ConvexPolygon& polygon) {
  double radius = 0.0;
  for (const Vec3& p : polygon) radius = std::max(radius, length(p - middle));
  return radius;
}

}  // namespace

double exchange_area(const ConvexPolygon& a, const ConvexPolygon& b) {
  if (a.empty() || b.empty()) return 0.0;
  const Vec3 middle_a = middle_of(a), middle_b = middle_of(b);
  const double distance = length(middle_b - middle_a);
  const double size = radius_about(middle_a, a) + radius_about(middle_b, b);
  constexpr double kFar = 4.0;  // there six nodes give ten digits
  return distance > kFar * size ? by_areas(a, b) : by_contours(a, b, std::max(distance, size));
}

}  // namespace tenku
