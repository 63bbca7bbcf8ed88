#include "study/reflection_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "output/image_writer.h"
#include "reports/reflection_page.h"
#include "study/sun_plan.h"
#include "view/value_scale.h"

namespace tenku {
namespace {

constexpr std::size_t kMostRows = 60;
constexpr double kAround_m = 20.0, kAround = 0.15;  // of the lit ground, on the plan

std::string clock_of(const std::string& iso) { return iso.size() < 16 ? iso : iso.substr(11, 5); }
std::string day_of(const std::string& iso) {
  return iso.substr(0, std::min<std::size_t>(10, iso.size()));
}

std::string place_in_words(const LitScene& lit) {
  const auto site = lit.site();
  if (!site) return "place not given";
  const double lat = site->latitude.in_degrees(), lon = site->longitude.in_degrees();
  return fmt::format("{:.4f}° {}, {:.4f}° {}", std::abs(lat), lat < 0 ? "S" : "N", std::abs(lon),
                     lon < 0 ? "W" : "E");
}

bool is_instant(const ReflectedSun& sun) {
  return sun.moments.size() <= 1 && (sun.moments.empty() || sun.moments[0].step_s == 0.0);
}

std::size_t throwing_panels(const ReflectedSun& sun) {
  return static_cast<std::size_t>(std::count_if(
      sun.sums.begin(), sun.sums.end(), [](const PanelSum& sum) { return sum.instants > 0; }));
}

/// The lit squares and what is around them.
PlanExtent extent_of_lit(const PlanGrid& grid) {
  PlanExtent e{1e300, 1e300, -1e300, -1e300};
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    if (!(grid.values[k] > 0.0)) continue;
    const auto columns = static_cast<std::size_t>(grid.columns);
    const double x = grid.west + static_cast<double>(k % columns) * grid.cell_m,
                 y = grid.north - static_cast<double>(k / columns) * grid.cell_m;
    e.west = std::min(e.west, x), e.east = std::max(e.east, x + grid.cell_m);
    e.south = std::min(e.south, y - grid.cell_m), e.north = std::max(e.north, y);
  }
  const double more = std::max(kAround_m, kAround * std::max(e.east - e.west, e.north - e.south));
  return {e.west - more, e.south - more, e.east + more, e.north + more};
}

ReportPicture map_of(const SunPlan& plan, const PlanGrid& grid, const char* title,
                     const char* quantity, const char* unit, const std::string& caption) {
  PlanMap map;
  map.title = title;
  map.quantity = quantity;
  map.unit = unit;
  map.grid = grid;
  map.extent = extent_of_lit(grid);
  // What gets none is left blank, so that the colours are the light's.
  for (double& value : map.grid->values) {
    if (value == 0.0) value = std::numeric_limits<double>::quiet_NaN();
  }
  map.buildings = plan.buildings;
  map.map = ColourMap::Inferno;
  return {png_bytes(plan_map(map)), std::string(title) + ", a plan with north up", caption};
}

void add_plans(ReflectionPage& page, const ReflectedSun& sun, const SunPlan& plan) {
  if (!(plan.lit_m2 > 0.0)) return;
  page.plans.push_back(map_of(
      plan, plan.most_lux, "Reflected sunlight on the ground", "Greatest reflected illuminance",
      "lx",
      fmt::format("The greatest illuminance by reflected sunlight, of all panels together, in "
                  "squares of {:.2g} m. Blank ground gets none. Grey: buildings.",
                  plan.most_lux.cell_m)));
  if (is_instant(sun)) return;
  page.plans.push_back(
      map_of(plan, plan.minutes, "How long the ground gets reflected sunlight",
             "Time with reflected sun", "min",
             fmt::format("Minutes, counted in steps of {:.3g}: stripes and speckles are the steps.",
                         sun.moments.front().step_s / 60.0)));
}

void add_figures(ReflectionPage& page, const ReflectedSun& sun, const SunPlan& plan) {
  double lmh = 0.0, lm = 0.0;
  for (const PanelSum& sum : sun.sums) lmh += sum.thrown_lmh, lm += sum.most_lm;
  page.figures.push_back(
      {"Panels that throw sunlight", number_text(static_cast<double>(throwing_panels(sun))),
       fmt::format("of {}", sun.panels.size()), "", "on the ground, on facades or on roofs"});
  page.figures.push_back({"Greatest reflected illuminance", rounded_text(sun.most_lux), "lx", "",
                          "on 0.1 m² or more of any surface, overlaps added, beside the sun's and "
                          "the sky's own light"});
  page.figures.push_back(
      {"Ground that gets any", rounded_text(plan.lit_m2), "m²", "",
       fmt::format("at some time, in squares of {:.2g} m", plan.minutes.cell_m)});
  if (is_instant(sun)) {
    page.figures.push_back(
        {"Light thrown", rounded_text(lm / 1000.0), "klm", "", "mirrored by all panels"});
  } else {
    page.figures.push_back({"Light thrown", rounded_text(lmh / 1000.0), "klm h", "",
                            "mirrored by all panels over all the time"});
  }
}

std::string remark_of(std::size_t shown, std::size_t all, const char* file) {
  if (shown == all) return "";
  return fmt::format("{} of {} are shown; {} writes all of them.", shown, all, file);
}

ReflectionTable table_of_panels(const ReflectedSun& sun) {
  ReflectionTable table{
      "By panel",
      "The panels that throw most light. From and to bound the time; minutes "
      "count the steps at which something got light.",
      {"Panel", "From", "To", "Minutes", "Greatest lx", "Light, klm", "Reflectance", "Least lit"},
      1,
      {},
      ""};
  std::vector<std::size_t> order(sun.panels.size());
  std::iota(order.begin(), order.end(), 0U);
  std::erase_if(order, [&](std::size_t p) { return sun.sums[p].instants == 0; });
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(sun.sums[a].thrown_lmh, sun.sums[a].most_lm) >
           std::pair(sun.sums[b].thrown_lmh, sun.sums[b].most_lm);
  });
  const std::size_t shown = std::min(kMostRows, order.size());
  for (std::size_t k = 0; k < shown; ++k) {
    const PanelSum& sum = sun.sums[order[k]];
    const std::string from = sun.window_text(sum.first, sum.first).first,
                      to = sun.window_text(sum.last, sum.last).second;
    table.rows.push_back({sun.panel_names[order[k]], day_of(from) + " " + clock_of(from),
                          day_of(to) + " " + clock_of(to), number_text(sum.minutes, 1),
                          rounded_text(sum.most_lux), rounded_text(sum.most_lm / 1000.0),
                          fmt::format("{:.3f}", sum.most_reflectance),
                          fmt::format("{:.0f} %", 100.0 * sum.least_lit)});
  }
  table.remark = remark_of(shown, order.size(), "--panels");
  return table;
}

/// Windows of each object, of all panels together.
struct ObjectSum {
  std::uint32_t object;
  std::size_t first, last;
  double most_lux = 0.0;
  std::size_t windows = 0;
};

ReflectionTable table_of_objects(const ReflectedSun& sun, const LitScene& lit) {
  ReflectionTable table{"What gets it",
                        "Objects that get reflected sunlight, the brightest first; the greatest "
                        "illuminance is that of one panel.",
                        {"Object", "First", "Last", "Greatest lx", "Windows of time"},
                        1,
                        {},
                        ""};
  std::map<std::uint32_t, ObjectSum> objects;
  for (const SunWindow& window : sun.windows) {
    const auto [found, is_new] =
        objects.try_emplace(window.object, ObjectSum{window.object, window.first, window.last});
    ObjectSum& sum = found->second;
    sum.first = std::min(sum.first, window.first);
    sum.last = std::max(sum.last, window.last);
    sum.most_lux = std::max(sum.most_lux, window.most_lux);
    ++sum.windows;
  }
  std::vector<ObjectSum> order;
  for (const auto& [object, sum] : objects) order.push_back(sum);
  std::stable_sort(order.begin(), order.end(),
                   [](const ObjectSum& a, const ObjectSum& b) { return a.most_lux > b.most_lux; });
  const std::size_t shown = std::min(kMostRows, order.size());
  for (std::size_t k = 0; k < shown; ++k) {
    const ObjectSum& sum = order[k];
    const std::string from = sun.window_text(sum.first, sum.first).first,
                      to = sun.window_text(sum.last, sum.last).second;
    table.rows.push_back({lit.scene().objects[sum.object].id, day_of(from) + " " + clock_of(from),
                          day_of(to) + " " + clock_of(to), rounded_text(sum.most_lux),
                          std::to_string(sum.windows)});
  }
  table.remark = remark_of(shown, order.size(), "--windows");
  return table;
}

ReflectionTable table_of_views(const ReflectionReport& request, const ReflectedSun& sun) {
  ReflectionTable table{
      "When the reflected sun is in view",
      "For each observer and panel the time during which part of the solar disc is seen in it, "
      "within half a minute; its direction when most of the disc is seen; the angle from the way "
      "ahead or the window's normal; the luminance of the disc in the panel.",
      {"Observer", "Panel", "From", "To", "Azimuth", "Altitude", "Angle", "Luminance, cd/m²",
       "Disc seen"},
      2,
      {},
      ""};
  const std::size_t shown = std::min(4 * kMostRows, request.views->size());
  for (std::size_t k = 0; k < shown; ++k) {
    const SunView& view = (*request.views)[k];
    const std::string from = iso_local(view.from), to = iso_local(view.to);
    table.rows.push_back({(*request.observers)[view.observer].name, sun.panel_names[view.panel],
                          day_of(from) + " " + from.substr(11, 8), to.substr(11, 8),
                          fmt::format("{:.1f}°", view.azimuth.in_degrees()),
                          fmt::format("{:.1f}°", view.altitude.in_degrees()),
                          view.angle ? fmt::format("{:.1f}°", view.angle->in_degrees()) : "",
                          fmt::format("{:.2e}", view.most.value()),
                          fmt::format("{:.0f} %", 100.0 * view.most_share)});
  }
  table.remark = request.views->empty() ? "No observer has it in view."
                                        : remark_of(shown, request.views->size(), "--views");
  return table;
}

double widest_blur(const ReflectedSun& sun) {
  double widest = 0.0;
  for (const auto& some : sun.patches) {
    for (const SunPatch& patch : some) widest = std::max(widest, patch.blur_m);
  }
  return widest;
}

std::vector<std::string> method_of(const ReflectedSun& sun) {
  return {
      fmt::format(
          "Each panel is divided by what stands between it and the sun; the light of what is left "
          "is divided by what it meets first, then mirrored again or let through by panes. All "
          "outlines are cut exactly, nothing is sampled: the light that arrives and the light that "
          "left agree within {:.1g} of it.",
          std::max(sun.balance_error(), 1e-15)),
      fmt::format("The outlines are those of a sun that is a point. The solar disc, 0.53 degrees "
                  "wide, softens them: the column blur_m of the polygons is the width over which "
                  "light rises from none to all, at most {:.2g} m here. Where a patch is narrower "
                  "than that its illuminance is an upper bound; its light is right.",
                  widest_blur(sun)),
      "Reflectance is that of the materials: a mirror's own, or Fresnel's formulas for glass. "
      "Panels "
      "are taken to be flat and clean; the bow of real panes spreads or gathers their light.",
      "An instant stands for the step about it. Maps are asked at the middles of their squares."};
}

}  // namespace

std::string reflection_report(const ReflectionReport& request, const ReflectedSun& sun,
                              const LitScene& lit) {
  ReflectionPage page;
  page.title = request.title;
  const std::string& sky = lit.sky().description;  // of --time: over a day only its name holds
  page.where = place_in_words(lit) + " · " + request.when + " · " +
               (is_instant(sun) ? sky : sky.substr(0, sky.find(',')));
  const SunPlan plan = sun_plan(lit, sun, request.plan_cell_m);
  page.lead = fmt::format(
      "{} of {} panels throw sunlight on what is around them; at its strongest {} lx on a surface.",
      throwing_panels(sun), sun.panels.size(), rounded_text(sun.most_lux));
  add_figures(page, sun, plan);
  add_plans(page, sun, plan);
  if (request.views != nullptr) page.tables.push_back(table_of_views(request, sun));
  if (throwing_panels(sun) > 0) {
    page.tables.push_back(table_of_panels(sun));
    page.tables.push_back(table_of_objects(sun, lit));
  }
  page.findings = request.findings;
  page.method = method_of(sun);
  return reflection_page(page);
}

}  // namespace tenku
