// Form factors: error against time of each method, as many shots as the tables of Doi and Itoh
// have, in rooms of their sizes; and the time of a shot in a building of 53,000 elements.
//
// Run it on an otherwise idle machine: ./form_factor_benchmark

#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
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

/// The median time of five runs.
Point measured(std::string_view name, const ElementMesh& mesh, const std::vector<Shot>& shots,
               const std::vector<FormFactorRow>& exact, int resolution) {
  const auto method = form_factor_method(name, mesh, {.resolution = resolution});
  std::vector<double> seconds;
  std::vector<FormFactorRow> rows;
  for (int run = 0; run < 5; ++run) {
    const auto start = std::chrono::steady_clock::now();
    rows = rows_of(*method, shots);
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(seconds.begin(), seconds.end());
  return {resolution, 1e3 * seconds[2] / static_cast<double>(shots.size()),
          exact.empty() ? 0.0 : error_of(rows, exact)};
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
  std::map<std::string_view, std::vector<Point>> curve;
  for (const std::string_view name : form_factor_method_names()) {
    if (name == "analytic") continue;
    for (int resolution = 12; resolution <= 800; resolution *= 2) {
      if (name == "hemicube" && resolution == 96) {
        curve[name].push_back(measured(name, mesh, shots, exact, 100));
      } else {
        curve[name].push_back(measured(name, mesh, shots, exact, resolution));
      }
      const Point& p = curve[name].back();
      std::printf("  %-20s %4d  %8.3f ms a shot  error %.3e\n", name.data(), p.resolution,
                  p.ms_a_shot, p.error);
    }
    std::printf("  %-20s error falls with the resolution to the power %.2f\n", name.data(),
                order_of(curve[name]));
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
  for (const std::string_view name : form_factor_method_names()) {
    if (name == "analytic") continue;
    std::printf("  %-20s %8.2f ms a shot\n", name.data(),
                measured(name, mesh, shots, {}, 128).ms_a_shot);
  }
}

}  // namespace
}  // namespace tenku

int main() {
  tenku::compare_in_room({1.05, 0.95}, 50);
  tenku::compare_in_room({0.63, 0.3}, 100);
  tenku::time_in_building();
}
