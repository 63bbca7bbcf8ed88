#include "reports/report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/version.h"
#include "reports/html.h"
#include "reports/report_style.h"
#include "view/false_colour.h"

namespace tenku {
namespace {

std::string element(const std::string& name, const std::string& text,
                    const std::string& style = {}) {
  const std::string open = style.empty() ? name : name + " class=\"" + style + "\"";
  return "<" + open + ">" + escaped(text) + "</" + name + ">\n";
}

std::string heading(const std::string& text) { return element("h2", text); }

std::string css_colour(Rgb8 c) {
  return "rgb(" + std::to_string(c.r) + "," + std::to_string(c.g) + "," + std::to_string(c.b) + ")";
}

std::string head(const ReportContent& content) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  html += "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n";
  html += element("title", content.title);
  html += "<style>";
  html += report_style();
  return html + "</style>\n</head>\n<body>\n<main>\n";
}

std::string opening(const ReportContent& content) {
  std::string html = "<header>\n" + element("h1", content.title);
  for (const std::string& line : {content.place, content.time_in_words, content.sky_in_words}) {
    if (!line.empty()) html += element("p", line, "where");
  }
  html += element("p", sun_sentence(content.sun_azimuth, content.sun_altitude), "where");
  html += "</header>\n";
  if (!content.summary.empty()) html += element("p", content.summary, "lead");
  return html;
}

std::string figure_card(const ReportFigure& figure) {
  std::string html = "<div class=\"figure\">\n" + element("dt", figure.label);
  html += "<dd class=\"value\">" + escaped(figure.value) + " <span class=\"unit\">" +
          escaped(figure.unit) + "</span></dd>\n";
  if (!figure.interval.empty()) html += element("dd", figure.interval, "interval");
  if (!figure.meaning.empty()) html += element("dd", figure.meaning, "meaning");
  return html + "</div>\n";
}

std::string figures(const ReportContent& content) {
  if (content.figures.empty()) return {};
  std::string html = heading("Key figures") + "<dl class=\"figures\">\n";
  for (const ReportFigure& figure : content.figures) html += figure_card(figure);
  return html + "</dl>\n";
}

std::string picture(const std::string& title, const std::optional<ReportPicture>& picture) {
  if (!picture) return {};
  std::string html = heading(title) + "<figure>\n<img alt=\"" + escaped(picture->alt) +
                     "\" src=\"data:image/png;base64," + base64(picture->png) + "\">\n";
  if (!picture->caption.empty()) html += element("figcaption", picture->caption);
  return html + "</figure>\n";
}

std::string drawing(const std::string& title, const std::string& svg, const std::string& caption,
                    const char* style) {
  if (svg.empty()) return {};
  return heading(title) + "<figure class=\"" + style + "\">\n" + svg +
         element("figcaption", caption) + "</figure>\n";
}

std::string cell(const std::string& text, const char* style = "n") {
  return "<td class=\"" + std::string(style) + "\">" + escaped(text) + "</td>";
}

std::string head_row(const std::vector<std::string>& names, std::size_t left_aligned) {
  std::string html = "<thead><tr>";
  for (std::size_t i = 0; i < names.size(); ++i) {
    html += std::string("<th scope=\"col\"") + (i < left_aligned ? ">" : " class=\"n\">") +
            escaped(names[i]) + "</th>";
  }
  return html + "</tr></thead>\n";
}

std::string band_name(const std::vector<double>& limits, std::size_t band) {
  if (limits.empty()) return "all";
  if (band == 0) return "under " + number_text(limits.front()) + " lx";
  if (band == limits.size()) return number_text(limits.back()) + " lx and more";
  return number_text(limits[band - 1]) + " to " + number_text(limits[band]) + " lx";
}

Rgb8 band_colour(std::size_t band, std::size_t bands) {
  const double last = bands > 1 ? static_cast<double>(bands - 1) : 1.0;
  return colour_at(ColourMap::Viridis, static_cast<double>(band) / last);
}

std::string share_text(double share) { return number_text(100.0 * share, 1) + " %"; }

std::string surface_table(const ReportContent& content) {
  std::string html = "<div class=\"scroll\"><table>\n" +
                     head_row({"Surface", "Area (m²)", "Average (lx)", "Lowest (lx)",
                               "Highest (lx)", "Average ± (lx)"},
                              1) +
                     "<tbody>\n";
  for (const ReportSurface& s : content.surfaces) {
    html += "<tr><th scope=\"row\">" + escaped(s.type) + "</th>";
    for (const double v : {s.area_m2, s.mean_lux, s.min_lux, s.max_lux, s.mean_interval_lux}) {
      html += cell(rounded_text(v));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string band_bar(const ReportSurface& surface) {
  std::string html = "<div class=\"bands\" aria-hidden=\"true\">";
  for (std::size_t b = 0; b < surface.band_shares.size(); ++b) {
    html += "<span style=\"width:" + coordinate(100.0 * surface.band_shares[b]) +
            "%;background:" + css_colour(band_colour(b, surface.band_shares.size())) + "\"></span>";
  }
  return html + "</div>";
}

std::string band_table(const ReportContent& content) {
  const std::size_t bands = content.band_limits.size() + 1;
  std::vector<std::string> names{"Surface", "Share of its area"};
  std::string key = "<ul class=\"key\">";
  for (std::size_t b = 0; b < bands; ++b) {
    names.push_back(band_name(content.band_limits, b));
    key += "<li><i style=\"background:" + css_colour(band_colour(b, bands)) + "\"></i>" +
           escaped(names.back()) + "</li>";
  }
  std::string html =
      key + "</ul>\n<div class=\"scroll\"><table>\n" + head_row(names, 2) + "<tbody>\n";
  for (const ReportSurface& s : content.surfaces) {
    expects(s.band_shares.size() == bands, "a surface has a share for each band");
    html += "<tr><th scope=\"row\">" + escaped(s.type) + "</th><td style=\"min-width:12rem\">" +
            band_bar(s) + "</td>";
    for (const double share : s.band_shares) html += cell(share_text(share));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string surfaces(const ReportContent& content) {
  if (content.surfaces.empty()) return {};
  std::string html = heading("Ground, walls and roofs") + surface_table(content);
  html += element("p",
                  "Averages are weighted by area. The last column is the average half-width "
                  "of the 95 % interval of the single values.");
  if (content.hidden_area_m2 > 0.0) {
    html += element("p", "Left out: " + rounded_text(content.hidden_area_m2) +
                             " m² that nothing reaches, such as ground under buildings and walls "
                             "between them.");
  }
  return content.band_limits.empty() ? html : html + band_table(content);
}

std::string finding_row(const Finding& finding) {
  const std::string severity(name_of(finding.severity));
  std::string html = "<tr><td class=\"severity " + severity + "\">" + severity + "</td>";
  html += cell(finding.object, "id") + cell(finding.what, "") + cell(finding.where, "id");
  return html + cell(finding.repair, "") + cell(std::to_string(finding.count)) + "</tr>\n";
}

// A client reads the first findings; the manifest holds all of them.
std::string findings(const ReportContent& content) {
  constexpr std::size_t kMost = 60;
  std::string html = heading("What was found in the model");
  if (content.findings.empty()) return html + element("p", "Nothing wrong was found.");
  std::size_t cases = 0;
  for (const Finding& finding : content.findings) cases += finding.count;
  html += element("p", number_text(static_cast<double>(cases)) + " in all, in " +
                           number_text(static_cast<double>(content.findings.size())) + " entries.");
  html += "<div class=\"scroll\"><table>\n" +
          head_row({"Weight", "Object", "What", "Where", "What was done", "Times"}, 5) +
          "<tbody>\n";
  const std::size_t shown = std::min(kMost, content.findings.size());
  for (std::size_t i = 0; i < shown; ++i) html += finding_row(content.findings[i]);
  html += "</tbody></table></div>\n";
  if (shown == content.findings.size()) return html;
  const auto more = static_cast<double>(content.findings.size() - shown);
  return html + element("p", "And " + number_text(more) + " more, all of them in manifest.json.");
}

std::string facts(const std::string& title, const std::vector<ReportFact>& facts) {
  if (facts.empty()) return {};
  std::string html = heading(title) + "<div class=\"scroll\"><table><tbody>\n";
  for (const ReportFact& fact : facts) {
    html += "<tr><th scope=\"row\">" + escaped(fact.name) + "</th>" + cell(fact.value, "id") +
            "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string method(const ReportContent& content) {
  if (content.method.empty() && content.error_statement.empty()) return {};
  std::string html = heading("How this was calculated, and how sure it is");
  for (const std::string& paragraph : content.method) html += element("p", paragraph);
  return content.error_statement.empty() ? html : html + element("p", content.error_statement);
}

}  // namespace

std::string compass_word(Angle azimuth) {
  static constexpr std::array<const char*, 16> kWords{
      "north",     "north-northeast", "northeast", "east-northeast",  "east",      "east-southeast",
      "southeast", "south-southeast", "south",     "south-southwest", "southwest", "west-southwest",
      "west",      "west-northwest",  "northwest", "north-northwest"};
  const double turns = azimuth.in_degrees() / 360.0;
  const long sector = std::lround((turns - std::floor(turns)) * 16.0) % 16;
  return kWords[static_cast<std::size_t>(sector)];
}

std::string sun_sentence(Angle azimuth, Angle altitude) {
  const double degrees = altitude.in_degrees();
  if (!(degrees > 0.0)) {
    return "The sun is below the horizon (" + number_text(-degrees, 1) + "° under it).";
  }
  return "The sun stands in the " + compass_word(azimuth) + " (azimuth " +
         number_text(azimuth.in_degrees(), 1) + "° from north), " + number_text(degrees, 1) +
         "° above the horizon.";
}

std::string report_html(const ReportContent& content) {
  std::string html = head(content) + opening(content) + figures(content);
  html += picture("The view", content.view) + picture("Light on the ground", content.plan);
  html += drawing("How the light is shared out", content.histogram_svg,
                  "Each bar is the share of the ground that receives this much light.", "chart");
  html += surfaces(content);
  html += drawing("The sun through the year", content.sun_path_svg,
                  "A plan of the sky: the rim is the horizon, the middle is straight overhead, "
                  "north is up. Solid lines are days, dashed lines are hours.",
                  "small");
  html += findings(content) + method(content);
  html += facts("Settings", content.settings) + facts("Versions", content.versions);
  html += "<footer>Made with " + escaped(software_name()) + ".</footer>\n";
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace tenku
