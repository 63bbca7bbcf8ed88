#include "study/reflected_sun.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/error.h"

namespace tenku {
namespace {

constexpr double kWorthTelling = 0.01;    // of the light: unfollowed, a finding
constexpr double kSmallestTold_m2 = 0.1;  // smaller overlaps are blurred away by the solar disc

std::vector<SunPatch> told_apart(std::vector<ThrownPolygon>&& polygons) {
  std::vector<SunPatch> patches;
  patches.reserve(polygons.size());
  for (ThrownPolygon& p : polygons) {
    patches.push_back(
        {p.triangle, {p.panel}, p.mirrors, p.lux, p.area_m2, p.blur_m, std::move(p.corners)});
  }
  return patches;
}

/// Sums over the instants as they come.
class Gatherer {
 public:
  Gatherer(const LitScene& lit, ReflectedSun& sun) : lit_(lit), sun_(sun) {
    sun_.sums.resize(sun_.panels.size());
  }

  void take(std::size_t moment, const ThrownSun& thrown) {
    sun_.started_lm += thrown.started_lm;
    sun_.landed_lm += thrown.landed_lm;
    sun_.sky_lm += thrown.sky_lm;
    sun_.unfollowed_lm += thrown.unfollowed_lm;
    take_polygons(moment, thrown);
    const double hours = sun_.moments[moment].step_s / 3600.0;
    for (std::size_t p = 0; p < thrown.panels.size(); ++p) {
      const PanelLight& light = thrown.panels[p];
      if (!(light.thrown_lm > 0.0)) continue;
      PanelSum& sum = sun_.sums[p];
      sum.thrown_lmh += light.thrown_lm * hours;
      sum.most_lm = std::max(sum.most_lm, light.thrown_lm);
      sum.most_reflectance = std::max(sum.most_reflectance, light.reflectance);
      sum.least_lit = std::min(sum.least_lit, light.lit_lm / light.arriving_lm);
    }
  }

  void close() {
    for (auto& [key, windows] : open_) {
      std::move(windows.begin(), windows.end(), std::back_inserter(sun_.windows));
    }
  }

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // panel, object

  void take_polygons(std::size_t moment, const ThrownSun& thrown) {
    std::map<Key, std::pair<double, double>> here;  // lux, area
    for (const ThrownPolygon& polygon : thrown.polygons) {
      auto& [lux, area] = here[{polygon.panel, lit_.soup().object[polygon.triangle]}];
      lux = std::max(lux, polygon.lux);
      area += polygon.area_m2;
    }
    std::uint32_t last_panel = 0xffffffffU;
    for (const auto& [key, light] : here) {
      extend(key, moment, light.first, light.second);
      PanelSum& sum = sun_.sums[key.first];
      sum.most_lux = std::max(sum.most_lux, light.first);
      if (key.first == last_panel) continue;
      last_panel = key.first;
      if (sum.instants++ == 0) sum.first = moment;
      sum.last = moment;
      sum.minutes += sun_.moments[moment].step_s / 60.0;
    }
  }

  void extend(const Key& key, std::size_t moment, double lux, double area) {
    std::vector<SunWindow>& windows = open_[key];
    const bool goes_on = !windows.empty() && windows.back().last + 1 == moment &&
                         sun_.moments[moment].day == sun_.moments[moment - 1].day;
    if (!goes_on) windows.push_back({key.first, key.second, moment, moment, 0.0, 0.0});
    SunWindow& window = windows.back();
    window.last = moment;
    window.most_lux = std::max(window.most_lux, lux);
    window.most_m2 = std::max(window.most_m2, area);
  }

  const LitScene& lit_;
  ReflectedSun& sun_;
  std::map<Key, std::vector<SunWindow>> open_;
};

}  // namespace

double ReflectedSun::balance_error() const {
  return started_lm > 0.0 ? std::abs(landed_lm + sky_lm - started_lm) / started_lm : 0.0;
}

std::size_t ReflectedSun::polygon_count() const {
  std::size_t count = 0;
  for (const auto& some : patches) count += some.size();
  return count;
}

std::string ReflectedSun::time_text(std::size_t moment) const {
  const auto& time = moments[moment].time;
  return time ? iso_local(*time) : "";
}

std::pair<std::string, std::string> ReflectedSun::window_text(std::size_t first,
                                                              std::size_t last) const {
  const auto moved = [&](std::size_t moment, double seconds) -> std::string {
    const auto& time = moments[moment].time;
    if (!time) return "";
    return iso_local(on_clock_of(*time, later_by(time->instant, seconds)));
  };
  return {moved(first, -0.5 * moments[first].step_s), moved(last, 0.5 * moments[last].step_s)};
}

std::vector<std::string> names_of(const std::vector<MirrorPanel>& panels, const Scene& scene) {
  std::map<std::uint32_t, int> count, seen;
  for (const MirrorPanel& panel : panels) ++count[panel.object];
  std::vector<std::string> names;
  for (const MirrorPanel& panel : panels) {
    const std::string& id = scene.objects[panel.object].id;
    names.push_back(count[panel.object] == 1 ? id : fmt::format("{}#{}", id, ++seen[panel.object]));
  }
  return names;
}

ReflectedSun reflected_sun(const LitScene& lit, std::vector<SunMoment> moments,
                           const ReflectionOptions& options, Progress& progress) {
  ReflectedSun sun;
  sun.moments = std::move(moments);
  sun.panels = mirror_panels(lit.soup(), lit.scene().materials, lit.rays().adjacency());
  if (sun.panels.empty()) {
    throw InputError(
        "nothing in the scene mirrors: give --materials a file with 'mirror' or 'index' for the "
        "panels, as in [window] index = 1.52");
  }
  sun.panel_names = names_of(sun.panels, lit.scene());
  const TriangleTree tree(lit.soup());
  Gatherer gatherer(lit, sun);
  progress.begin("reflected sun", sun.moments.size());
  for (std::size_t m = 0; m < sun.moments.size(); ++m) {
    const SolarDisc& disc = sun.moments[m].sun;
    ThrownSun thrown = throw_sunlight(
        tree, lit.scene().materials, sun.panels,
        {disc.direction, disc.angular_radius, disc.normal_illuminance}, options.how, progress);
    gatherer.take(m, thrown);
    sun.patches.push_back(options.adds_overlaps ? added_up(lit.soup(), thrown.polygons)
                                                : told_apart(std::move(thrown.polygons)));
    for (const SunPatch& patch : sun.patches.back()) {
      if (patch.area_m2 >= kSmallestTold_m2) sun.most_lux = std::max(sun.most_lux, patch.lux);
    }
    progress.advance(1);
  }
  gatherer.close();
  progress.end(fmt::format("{} polygons", sun.polygon_count()));
  return sun;
}

std::vector<Finding> findings_of(const ReflectedSun& sun, const ReflectionOptions& options) {
  std::vector<Finding> findings;
  if (sun.moments.empty()) {
    findings.push_back({"night", Severity::Warning, "", "",
                        "the sun does not shine at any of the instants", "give another time"});
  }
  const double thrown = sun.started_lm + sun.unfollowed_lm;
  if (sun.unfollowed_lm > kWorthTelling * thrown) {
    findings.push_back(
        {"mirrors_beyond_depth", Severity::Warning, "", "",
         fmt::format("{:.2g} % of the reflected light meets more than {} mirrors or is weaker than "
                     "{} lx and was not followed",
                     100.0 * sun.unfollowed_lm / thrown, options.how.depth, options.how.least_lux),
         "a greater --depth follows it further"});
  }
  return findings;
}

}  // namespace tenku
