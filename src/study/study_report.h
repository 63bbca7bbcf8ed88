/// What a study found, gathered for its report and its manifest.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "illuminance/illuminate.h"
#include "output/manifest.h"
#include "reports/report.h"
#include "study/ground_plan.h"
#include "study/lit_scene.h"
#include "study/study.h"
#include "study/study_sky.h"
#include "view/view_render.h"

namespace tenku {

/// Takes the results as they come and puts them into words. Borrows the study and the lit scene.
class ReportBuilder {
 public:
  ReportBuilder(const Study& study, const LitScene& lit, const StudyMoment& moment);

  const std::string& title() const { return title_; }
  /// ISO 8601, or empty where the sun was given directly.
  std::string time_text() const;

  void add_view(const RenderedView& view, const StudyView& request);
  void add_field(const SensorGrid& grid, const SensorIlluminance& values);
  void add_light(const IlluminanceResult& result);
  void note(const std::string& what);

  /// The plan as a map that can be drawn.
  PlanMap plan_of(const GroundPlan& ground, const SensorIlluminance& values,
                  const StudyPlan& request);
  void add_plan(const Image8& map);

  /// The sun-path diagram as SVG; empty where the place is not known.
  std::string sun_path() const;

  ReportContent content() const;
  Manifest manifest(const std::vector<std::filesystem::path>& files,
                    const std::vector<ManifestStage>& stages) const;
  std::vector<Finding> findings() const;

 private:
  struct Ground {
    double mean = 0.0, lowest = 0.0, highest = 0.0, error = 0.0, sunlit_share = 0.0;
  };
  std::string place_in_words() const;
  std::string time_in_words() const;
  std::string sky_in_words() const;
  std::vector<ReportFigure> figures() const;
  std::string engines_in_words() const;
  std::vector<ReportFact> regions_in_words() const;
  std::string error_statement() const;
  /// Those of one kind from several calculations are one entry, with the place of the first.
  void add_note(const Finding& finding);

  const Study& study_;
  const LitScene& lit_;
  const StudyMoment& moment_;
  std::string title_;
  ReportContent content_;
  std::optional<Ground> ground_;
  std::vector<double> plan_values_;
  std::uint64_t rays_ = 0;
  std::size_t sensors_ = 0, out_of_tolerance_ = 0;
  std::vector<Finding> notes_;
  std::vector<PlannedRegion> regions_;
};

}  // namespace tenku
