// The calculation areas as sections of the page. Each function returns HTML; empty without areas.
#pragma once

#include <string>

#include "output/report_content.hpp"

namespace lichtmc {

// Whether the areas reach their targets, and a table of their figures.
std::string area_verdicts(const ReportContent& content);

// The plan of each area.
std::string area_plans(const ReportContent& content);

// How each area was measured: grid, points, points left out, extreme values.
std::string area_details(const ReportContent& content);

// Which maintenance factors the figures contain; a sentence.
std::string maintenance_text(const Room& room);

}  // namespace lichtmc
