#include "cli/plan_output.h"

#include <fmt/format.h>

#include <cmath>

namespace tenku {
namespace {

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

std::string in_words(double value, const char* unit) {
  return std::isfinite(value) ? fmt::format("{:.3g} {}", value, unit) : "-";
}

std::string maps_of(const PlannedRegion& r) {
  if (r.texels == 0 || r.engine == Engine::Rays) return "-";
  return fmt::format("{} x {:.2g} m", r.texels, r.texel_m);
}

}  // namespace

nlohmann::ordered_json json_of(const std::vector<PlannedRegion>& regions) {
  nlohmann::ordered_json plan = nlohmann::ordered_json::array();
  for (const PlannedRegion& r : regions) {
    plan.push_back({{"engine", name_of(r.engine)},
                    {"why", r.why},
                    {"sensors", r.sensors},
                    {"elements", r.elements},
                    {"sun_directions", r.sun_directions},
                    {"texels", r.texels},
                    {"texel_m", r.texel_m},
                    {"reach_m", number(r.reach_m)},
                    {"left_out_lux", r.left_out_lux},
                    {"is_shared", r.is_shared},
                    {"interpolated", r.interpolated},
                    {"rays_s", number(r.rays_s)},
                    {"shared_s", number(r.shared_s)},
                    {"maps_s", number(r.maps_s)},
                    {"predicted_s", number(r.predicted_s())},
                    {"measured_s", number(r.measured_s)},
                    {"predicted_error_lux", number(r.predicted_error_lux)},
                    {"measured_error_lux", number(r.measured_error_lux)}});
  }
  return plan;
}

std::string table_of(const std::vector<PlannedRegion>& regions) {
  constexpr const char* kLine =
      "{:>6}  {:<11}  {:>9}  {:>8}  {:>14}  {:>8}  {:>8}  {:>8}  {:>8}  {:>10}  {:>10}";
  std::string text = fmt::format(kLine, "region", "engine", "sensors", "elements", "maps", "rays",
                                 "shared", "maps", "took", "error +-", "found +-");
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const PlannedRegion& r = regions[k];
    text.push_back('\n');
    text +=
        fmt::format(kLine, k + 1, name_of(r.engine), r.sensors,
                    r.elements == 0 ? "-" : std::to_string(r.elements + r.sun_directions),
                    maps_of(r), in_words(r.rays_s, "s"), in_words(r.shared_s, "s"),
                    in_words(r.maps_s, "s"), in_words(r.measured_s, "s"),
                    in_words(r.predicted_error_lux, "lx"), in_words(r.measured_error_lux, "lx"));
    text += "  " + r.why;
    if (r.interpolated > 0) {
      text += fmt::format("\n        left out: the sky of {} sensors, taken from those around",
                          r.interpolated);
    }
    if (!std::isfinite(r.reach_m)) continue;
    text += fmt::format(
        "\n        left out: casters farther than {:.0f} m, at most {:.3g} lx for 19 of 20 sensors",
        r.reach_m, r.left_out_lux);
  }
  return text;
}

}  // namespace tenku
