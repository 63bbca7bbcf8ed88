#include "study/chart_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/atomic_file.h"
#include "core/version.h"
#include "output/image_writer.h"
#include "output/manifest.h"
#include "output/table_writer.h"
#include "reports/speed_chart.h"
#include "view/value_scale.h"

namespace tenku {
namespace {

std::string seconds_text(double seconds) { return rounded_text(seconds) + " s"; }
std::string percent_text(double value) { return rounded_text(value) + " %"; }

void write_table(const std::filesystem::path& path, const ChartResult& result, const LitScene& lit,
                 const Sensors& sensors) {
  CsvTable table(kChartHeader);
  const auto yes = [](bool is) { return is ? "yes" : "no"; };
  for (const ChartPoint& p : result.points) {
    const bool is_picture = result.references[p.reference].is_picture;
    table.add(p.stage).add(p.method).add(p.setting);
    table.add(p.time_s).add(p.time_spread_s).add(p.memory_mb);
    table.add(p.error.rms).add(p.error.p95).add(p.error.worst);
    if (std::isfinite(p.predicted_error)) {
      table.add(p.predicted_error);
    } else {
      table.add("");
    }
    table.add(yes(p.is_on_front)).add(yes(p.is_knee));
    table.add(yes(p.is_under_floor)).add(yes(p.is_order_unsure));
    table.add(static_cast<double>(p.repeats));
    if (is_picture) {
      for (int k = 0; k < 6; ++k) table.add("");
    } else {
      const Vec3 worst = lit.scene().frame.to_file(sensors.position[p.error.worst_sensor]);
      table.add(p.error.rms_lux).add(p.error.p95_lux).add(p.error.worst_lux);
      table.add(worst.x).add(worst.y).add(worst.z);
    }
    table.add(result.references[p.reference].floor);
    if (is_picture) {
      table.add(p.error.mean_255).add(p.error.similarity);
    } else {
      table.add("").add("");
    }
    table.end_row();
  }
  table.write(path);
}

std::string label_of(const ChartPoint& p, bool is_picture) {
  std::string label = fmt::format(
      "{}, {}: {} (spread {}, {} runs), error {} RMS, {} for 95 %, {} worst", p.method, p.setting,
      seconds_text(p.time_s), seconds_text(p.time_spread_s), p.repeats, percent_text(p.error.rms),
      percent_text(p.error.p95), percent_text(p.error.worst));
  if (is_picture) {
    label += fmt::format("; of white: mean difference {} of 255, similarity {:.3f}",
                         rounded_text(p.error.mean_255), p.error.similarity);
  }
  if (p.is_under_floor) label += "; as good as the reference, not ranked";
  if (p.is_order_unsure) label += "; times overlap with a neighbour's on the front";
  return label;
}

SpeedMark mark_of(const ChartPoint& p, const std::string& line, bool is_picture) {
  return {line,        label_of(p, is_picture), p.time_s,  p.time_spread_s,
          p.error.rms, p.is_on_front,           p.is_knee, p.is_under_floor};
}

/// One of each stage, and one of all that share a reference.
std::vector<SpeedChart> charts_of(const ChartResult& result) {
  std::vector<SpeedChart> charts;
  for (std::size_t r = 0; r < result.references.size(); ++r) {
    SpeedChart whole;
    whole.title = "All stages: " + result.references[r].name;
    whole.floor_pct = result.references[r].floor;
    std::vector<SpeedChart> stages;
    for (const ChartPoint& p : result.points) {
      if (p.reference != r) continue;
      if (stages.empty() || stages.back().title != "Stage: " + p.stage) {
        stages.push_back({.title = "Stage: " + p.stage, .marks = {}, .floor_pct = whole.floor_pct});
      }
      stages.back().marks.push_back(mark_of(p, p.method, result.references[r].is_picture));
      SpeedMark here = mark_of(p, p.stage + ": " + p.method, result.references[r].is_picture);
      here.is_on_front = here.is_knee = false;
      whole.marks.push_back(std::move(here));
    }
    if (stages.size() > 1) charts.push_back(std::move(whole));
    std::move(stages.begin(), stages.end(), std::back_inserter(charts));
  }
  return charts;
}

/// Why no setting is within an error.
std::string unreachable(const ChartResult& result, std::size_t reference, double error) {
  const ReferenceResult& r = result.references[reference];
  if (r.difference.p95 > error) {
    return fmt::format("unreachable here: the reference itself is known to {} only",
                       percent_text(r.difference.p95));
  }
  return result.left_out.empty()
             ? "unreachable here: no setting that was tried is as good"
             : "unreachable here: what might be as good did not fit into the time";
}

SpeedTable recommendations(const ChartResult& result, std::size_t reference) {
  SpeedTable table;
  table.title = "What to set: " + result.references[reference].name;
  table.introduction =
      result.references[reference].is_picture
          ? "The quickest setting with which 95 % of the pixels are within an error, of white."
          : "The quickest setting with which 95 % of the sensors are within an error of their "
            "values.";
  table.header = {"error asked for", "setting", "time", "95 % within", "worst"};
  table.left_aligned = 2;
  for (const double error : kChartErrors) {
    const ChartPoint* best = cheapest_within(result, reference, error);
    if (best == nullptr) {
      table.rows.push_back(
          {percent_text(error), unreachable(result, reference, error), "", "", ""});
      continue;
    }
    table.rows.push_back({percent_text(error),
                          best->stage + ": " + best->method + ", " + best->setting,
                          seconds_text(best->time_s), percent_text(best->error.p95),
                          percent_text(best->error.worst)});
  }
  return table;
}

SpeedTable all_points(const ChartResult& result) {
  SpeedTable table;
  table.title = "All points";
  table.introduction =
      "Errors are relative to each sensor's value (at least 0.1 % of open light), of pictures "
      "to white. Foretold: root mean square of the intervals that the calculation gives itself.";
  table.header = {"stage",       "method",     "setting", "time, s",  "spread, s",
                  "memory, MiB", "RMS, %",     "95 %, %", "worst, %", "foretold, %",
                  "of 255",      "similarity", "remark"};
  table.left_aligned = 3;
  for (const ChartPoint& p : result.points) {
    const bool is_picture = result.references[p.reference].is_picture;
    std::string remark = p.is_knee ? "knee" : p.is_on_front ? "front" : "";
    if (p.is_under_floor) remark = "as good as the reference";
    if (p.is_order_unsure) remark += ", order unsure";
    table.rows.push_back({p.stage, p.method, p.setting, rounded_text(p.time_s),
                          rounded_text(p.time_spread_s), rounded_text(p.memory_mb),
                          rounded_text(p.error.rms), rounded_text(p.error.p95),
                          rounded_text(p.error.worst),
                          std::isfinite(p.predicted_error) ? rounded_text(p.predicted_error) : "",
                          is_picture ? rounded_text(p.error.mean_255) : "",
                          is_picture ? fmt::format("{:.3f}", p.error.similarity) : "", remark});
  }
  return table;
}

/// The finest error that a setting reached for which a study has words.
const ChartPoint* to_recommend(const ChartResult& result) {
  const ChartPoint* best = nullptr;
  for (const double error : kChartErrors) {
    const ChartPoint* here = nullptr;
    for (const ChartPoint& p : result.points) {
      const bool is_of_sensors = !result.references[p.reference].is_picture;
      if (p.study.empty() || !is_of_sensors || p.error.p95 > error) continue;
      if (here == nullptr || p.time_s < here->time_s) here = &p;
    }
    if (here != nullptr) best = here;
  }
  return best;
}

std::string fragment_of(const ChartResult& result) {
  std::string text;
  for (std::size_t r = 0; r < result.references.size(); ++r) {
    for (const double error : kChartErrors) {
      const ChartPoint* best = cheapest_within(result, r, error);
      text += fmt::format("# {:g} %: {}\n", error,
                          best == nullptr ? unreachable(result, r, error)
                                          : best->stage + ", " + best->method + ", " +
                                                best->setting + ", " + seconds_text(best->time_s));
    }
  }
  const ChartPoint* best = to_recommend(result);
  return best == nullptr ? text : text + "[calculation]\n" + best->study;
}

/// Where the knee of each stage is wrong.
std::vector<ErrorPlan> plans_of(const ChartResult& result, const Sensors& sensors) {
  std::vector<ErrorPlan> plans;
  for (const ChartPoint& p : result.points) {
    if (!p.is_knee || result.references[p.reference].is_picture) continue;
    ErrorPlan plan;
    plan.caption = fmt::format(
        "{}, {}, {}: orange too bright, blue too dark, full colour at {}; the ring is the worst of "
        "{} sensors.",
        p.stage, p.method, p.setting, percent_text(p.error.worst), sensors.size());
    plan.place = sensors.position;
    plan.error_pct = p.sensor_error_pct;
    plan.worst = p.error.worst_sensor;
    plans.push_back(std::move(plan));
  }
  return plans;
}

SpeedPage page_of(const ChartResult& result, const Sensors& sensors, const ChartStory& story,
                  const std::vector<SpeedChart>& charts) {
  SpeedPage page;
  page.title = "Speed against accuracy";
  page.where = story.scene + "; " + story.sensors;
  page.lead = fmt::format("{} settings in {}, each held against a reference.", result.points.size(),
                          seconds_text(result.seconds));
  page.charts = charts;
  for (std::size_t r = 0; r < result.references.size(); ++r) {
    page.tables.push_back(recommendations(result, r));
  }
  page.tables.push_back(all_points(result));
  page.plans = plans_of(result, sensors);
  page.fragment = fragment_of(result);
  for (const ReferenceResult& r : result.references) {
    page.remarks.push_back(fmt::format(
        "Reference, {}: two runs with random numbers of their own at a tolerance of {}, {} "
        "together. "
        "They differ by {} RMS, {} at the worst sensor; their mean is taken, good to half of that "
        "({}), which is the floor of the charts. Points below it are not ranked.",
        r.name, percent_text(r.tolerance_pct), seconds_text(r.seconds),
        percent_text(r.difference.rms), percent_text(r.difference.worst), percent_text(r.floor)));
  }
  const Machine machine = this_machine();
  page.remarks.push_back(fmt::format(
      "Times are those of the light alone, the scene being read: medians, with the span of all "
      "runs. "
      "Memory is the most that the process held, the scene included. {} of {} s were allowed. {}, "
      "{} "
      "threads, {} logical processors ({}), seed {}.",
      seconds_text(result.seconds), rounded_text(story.budget_s), software_name(), story.threads,
      machine.cores, machine.processor.empty() ? machine.system : machine.processor, story.seed));
  if (!result.left_out.empty()) {
    std::string names;
    for (const std::string& name : result.left_out) names += (names.empty() ? "" : "; ") + name;
    page.remarks.push_back("Left out, as the time did not allow them: " + names + ".");
  }
  return page;
}

}  // namespace

void write_chart(const std::filesystem::path& folder, const ChartResult& result,
                 const LitScene& lit, const Sensors& sensors, const ChartStory& story) {
  std::filesystem::create_directories(folder);
  write_table(folder / "chart.csv", result, lit, sensors);
  const std::vector<SpeedChart> charts = charts_of(result);
  write_whole_file(folder / "chart.html", speed_page(page_of(result, sensors, story, charts)));
  write_png(folder / "chart.png", speed_chart_picture(charts), {"speed against accuracy", "", ""});
  write_whole_file(folder / "recommended.toml", fragment_of(result));
}

}  // namespace tenku
