// Form factors: error against time of each method, as many shots as the tables of Doi and Itoh
// have, in rooms of their sizes; and the time of a shot in a building of 53,000 elements.
//
// Processor time of one thread, medians of five rounds in which all methods and resolutions take
// turns: ./form_factor_benchmark

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "form_factors/form_factor.h"
#include "support/generated_rooms.h"

namespace tenku {
namespace {

using testing_support::MeshLengths;

struct Shot {
  Vec3 position, normal;
};

/// Points in the middle of fronts of elements, evenly over the mesh.
std::vector<Shot> shots_of(const ElementMesh& mesh, std::size_t count) {
  std::vector<Shot> shots;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t element = (2 * k + 1) * mesh.size() / (2 * count);
    const Vec3 normal = mesh.normal(2 * element);
    shots.push_back({mesh.centre(element) + 1e-5 * normal, normal});
  }
  return shots;
}

std::vector<FormFactorRow> rows_of(const FormFactorMethod& method, const std::vector<Shot>& shots) {
  std::vector<FormFactorRow> rows;
  for (const Shot& shot : shots) rows.push_back(method.from_point(shot.position, shot.normal));
  return rows;
}

/// Root of the mean over the shots of the sum of squares of what the form factors are wrong by.
double error_of(const std::vector<FormFactorRow>& rows, const std::vector<FormFactorRow>& exact) {
  double sum = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::map<std::uint32_t, double> difference;
    for (const auto& [side, value] : exact[k]) difference[side] -= value;
    for (const auto& [side, value] : rows[k]) difference[side] += value;
    for (const auto& [side, value] : difference) sum += value * value;
  }
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

struct Point {
  int resolution;
  double ms_a_shot, error;
};

constexpr int kRounds = 5;

/// A method at a resolution, timed round by round.
class Timed {
 public:
  Timed(std::string_view name, const ElementMesh& mesh, int resolution)
      : name_(name),
        resolution_(resolution),
        method_(form_factor_method(name, mesh, {.resolution = resolution})) {}

  std::string_view name() const { return name_; }

  void run(const std::vector<Shot>& shots) {
    const std::clock_t start = std::clock();
    rows_ = rows_of(*method_, shots);
    const auto ticks = static_cast<double>(std::clock() - start);
    ms_a_shot_.push_back(1e3 * ticks / CLOCKS_PER_SEC / static_cast<double>(shots.size()));
  }

  Point point(const std::vector<FormFactorRow>& exact) {
    std::sort(ms_a_shot_.begin(), ms_a_shot_.end());
    return {resolution_, ms_a_shot_[kRounds / 2], exact.empty() ? 0.0 : error_of(rows_, exact)};
  }

 private:
  std::string_view name_;
  int resolution_;
  std::unique_ptr<FormFactorMethod> method_;
  std::vector<double> ms_a_shot_;
  std::vector<FormFactorRow> rows_;
};

void take_turns(std::vector<Timed>& timed, const std::vector<Shot>& shots) {
  for (int round = 0; round < kRounds; ++round) {
    for (Timed& t : timed) t.run(shots);
  }
}

/// Time at an error, between points on straight lines in logarithms.
std::optional<double> time_at(double error, const std::vector<Point>& curve) {
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const Point &a = curve[k - 1], &b = curve[k];
    if (a.error < error || b.error > error) continue;
    const double at = std::log(error / a.error) / std::log(b.error / a.error);
    return a.ms_a_shot * std::pow(b.ms_a_shot / a.ms_a_shot, at);
  }
  return std::nullopt;
}

/// Slope of the straight line through the logarithms.
double order_of(const std::vector<Point>& curve) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& p : curve) {
    const double u = std::log(p.resolution), v = std::log(p.error);
    x += u, y += v, xx += u * u, xy += u * v;
  }
  const auto n = static_cast<double>(curve.size());
  return -(n * xy - x * y) / (n * xx - x * x);
}

void compare_in_room(MeshLengths lengths, std::size_t count) {
  const ElementMesh mesh = testing_support::furnished_room(lengths);
  std::printf("room of 18 faces, %zu patches, %zu elements; %zu shots\n", mesh.patches(),
              mesh.size(), count);
  const std::vector<Shot> shots = shots_of(mesh, count);
  const std::vector<FormFactorRow> exact =
      rows_of(*form_factor_method("analytic", mesh, {}), shots);
  std::vector<Timed> timed;
  for (const std::string_view name : form_factor_method_names()) {
    if (name == "analytic") continue;
    for (int resolution = 12; resolution <= 800; resolution *= 2) {
      timed.emplace_back(name, mesh, name == "hemicube" && resolution == 96 ? 100 : resolution);
    }
  }
  take_turns(timed, shots);
  std::map<std::string_view, std::vector<Point>> curve;
  for (Timed& t : timed) {
    const Point p = t.point(exact);
    curve[t.name()].push_back(p);
    std::printf("  %-20s %4d  %8.3f ms a shot  error %.3e\n", t.name().data(), p.resolution,
                p.ms_a_shot, p.error);
  }
  for (const auto& [name, points] : curve) {
    std::printf("  %-20s error falls with the resolution to the power %.2f\n", name.data(),
                order_of(points));
  }
  for (const Point& cube : curve["hemicube"]) {
    std::printf("  at the error of a hemicube of %3d (%.2e, %.3f ms):", cube.resolution, cube.error,
                cube.ms_a_shot);
    for (const auto& [name, points] : curve) {
      const auto time = time_at(cube.error, points);
      if (name != "hemicube" && time) {
        std::printf("  %s %.3f ms, %.1fx", name.data() + 11, *time, cube.ms_a_shot / *time);
      }
    }
    std::printf("\n");
  }
}

void time_in_building() {
  const ElementMesh mesh = testing_support::furnished_building(2, 10, 14, {2.2, 1.38});
  std::printf("building of 10,640 polygons, %zu elements; 128 lines or pixels; one thread\n",
              mesh.size());
  const std::vector<Shot> shots = shots_of(mesh, 20);
  std::vector<Timed> timed;
  for (const std::string_view name : form_factor_method_names()) {
    if (name != "analytic") timed.emplace_back(name, mesh, 128);
  }
  take_turns(timed, shots);
  for (Timed& t : timed) {
    std::printf("  %-20s %8.2f ms a shot\n", t.name().data(), t.point({}).ms_a_shot);
  }
}

}  // namespace
}  // namespace tenku

int main() {
  tenku::compare_in_room({1.05, 0.95}, 50);
  tenku::compare_in_room({0.63, 0.3}, 100);
  tenku::time_in_building();
}
