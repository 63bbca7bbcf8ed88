/// The report that a client reads: one page, nothing loaded from elsewhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/finding.h"
#include "core/units.h"

namespace tenku {

/// A number that matters, in plain words.
struct ReportFigure {
  std::string label;     ///< `Average on the ground`
  std::string value;     ///< `23,400`
  std::string unit;      ///< `lx`
  std::string interval;  ///< `± 180 lx (95 %)`; empty where there is none
  std::string meaning;   ///< a sentence: what it tells
};

struct ReportPicture {
  std::string png;  ///< bytes of a PNG file
  std::string alt;  ///< what it shows, for those who cannot see it
  std::string caption;
};

/// Statistics of one surface type, weighted by area.
///
/// Shape    band_shares has one entry more than `ReportContent::band_limits`; their sum is 1.
struct ReportSurface {
  std::string type;
  double area_m2 = 0.0;
  double mean_lux = 0.0, min_lux = 0.0, max_lux = 0.0;
  double mean_interval_lux = 0.0;  ///< mean half-width of the 95 % interval
  std::vector<double> band_shares;
};

struct ReportFact {
  std::string name, value;
};

/// What the report says. All text is plain text in UTF-8; an empty part is left out.
struct ReportContent {
  std::string title;
  std::string place;          ///< `Sapporo, 43.0687° N, 141.3508° E`
  std::string time_in_words;  ///< `Sunday 21 June 2026, 09:00 Japan time`
  std::string sky_in_words;   ///< `clear sky (CIE type 12)`
  Angle sun_azimuth, sun_altitude;
  std::string summary;
  std::vector<ReportFigure> figures;
  std::optional<ReportPicture> view, plan;
  std::string histogram_svg, sun_path_svg;  ///< of `histogram.h`, `sun_path_diagram.h`; not escaped
  std::vector<double> band_limits;          ///< lux, ascending
  std::vector<ReportSurface> surfaces;
  double hidden_area_m2 = 0.0;  ///< of surfaces that nothing reaches, not in `surfaces`
  std::vector<Finding> findings;
  std::vector<std::string> method;  ///< paragraphs
  std::string error_statement;
  std::vector<ReportFact> settings, versions;
};

/// The page as HTML 5.
std::string report_html(const ReportContent& content);

/// Direction as a word of a 16-point compass: `east-southeast`.
std::string compass_word(Angle azimuth);

/// Where the sun is, as a sentence; says so when it is below the horizon.
std::string sun_sentence(Angle azimuth, Angle altitude);

}  // namespace tenku
