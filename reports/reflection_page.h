/// Where, when and how strongly mirrors throw sunlight, as a page.
#pragma once

#include <string>
#include <vector>

#include "core/finding.h"
#include "reports/report.h"

namespace tenku {

/// A table of the page. Cells are plain text.
struct ReflectionTable {
  std::string title, introduction;
  std::vector<std::string> header;
  std::size_t left_aligned = 1;  ///< columns; the others are numbers
  std::vector<std::vector<std::string>> rows;
  std::string remark;  ///< below the table; empty for none
};

/// What the page says; an empty part is left out.
struct ReflectionPage {
  std::string title, where, lead;
  std::vector<ReportFigure> figures;
  std::vector<ReportPicture> plans;
  std::vector<ReflectionTable> tables;
  std::vector<Finding> findings;
  std::vector<std::string> method;  ///< paragraphs
};

/// One page of HTML 5, nothing loaded from elsewhere.
std::string reflection_page(const ReflectionPage& page);

}  // namespace tenku
