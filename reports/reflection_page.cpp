#include "reports/reflection_page.h"

#include "core/version.h"
#include "reports/html.h"
#include "reports/report_style.h"

namespace tenku {
namespace {

std::string element(const char* name, const std::string& text, const char* style = "") {
  const std::string open = *style == '\0' ? name : std::string(name) + " class=\"" + style + "\"";
  return "<" + open + ">" + escaped(text) + "</" + name + ">";
}

std::string figures_of(const ReflectionPage& page) {
  if (page.figures.empty()) return "";
  std::string html = "<dl class=\"figures\">\n";
  for (const ReportFigure& figure : page.figures) {
    html += "<div class=\"figure\">" + element("dt", figure.label) + "<dd class=\"value\">" +
            escaped(figure.value) + " " + element("span", figure.unit, "unit") + "</dd>";
    if (!figure.interval.empty()) html += element("dd", figure.interval, "interval");
    html += element("dd", figure.meaning, "meaning") + "</div>\n";
  }
  return html + "</dl>\n";
}

std::string picture_of(const ReportPicture& picture) {
  return "<figure><img alt=\"" + escaped(picture.alt) + "\" src=\"data:image/png;base64," +
         base64(picture.png) + "\">" + element("figcaption", picture.caption) + "</figure>\n";
}

std::string table_of(const ReflectionTable& table) {
  std::string html = element("h2", table.title) + element("p", table.introduction) +
                     "\n<div class=\"scroll\"><table><thead><tr>";
  const auto style = [&](std::size_t k) { return k < table.left_aligned ? "id" : "n"; };
  for (std::size_t k = 0; k < table.header.size(); ++k) {
    html += element("th", table.header[k], style(k));
  }
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t k = 0; k < row.size(); ++k) html += element("td", row[k], style(k));
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  return table.remark.empty() ? html : html + element("p", table.remark) + "\n";
}

std::string findings_of(const ReflectionPage& page) {
  if (page.findings.empty()) return "";
  std::string html = element("h2", "What was found") + "<ul>\n";
  for (const Finding& finding : page.findings) {
    const std::string severity(name_of(finding.severity));
    html += "<li>" + element("span", severity, ("severity " + severity).c_str()) + " " +
            escaped(finding.what + (finding.repair.empty() ? "" : "; " + finding.repair)) +
            "</li>\n";
  }
  return html + "</ul>\n";
}

}  // namespace

std::string reflection_page(const ReflectionPage& page) {
  std::string html = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                     escaped(page.title) + "</title>\n<style>" + std::string(report_style()) +
                     "</style></head>\n<body><main>" + element("h1", page.title) +
                     element("p", page.where, "where") + element("p", page.lead, "lead") + "\n" +
                     figures_of(page);
  for (const ReportPicture& plan : page.plans) html += picture_of(plan);
  for (const ReflectionTable& table : page.tables) html += table_of(table);
  html += findings_of(page);
  if (!page.method.empty()) {
    html += element("h2", "How this was calculated, and how sure it is") + "\n";
    for (const std::string& paragraph : page.method) html += element("p", paragraph) + "\n";
  }
  return html + "<footer>Made with " + escaped(software_name()) +
         ".</footer>\n</main></body></html>\n";
}

}  // namespace tenku
