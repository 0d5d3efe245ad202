// Pictures and the 3-D view as sections of the page. Each function returns HTML; empty without content.
#pragma once

#include <string>

#include "output/report_content.hpp"

namespace lichtmc {

// The room, and the paths of photons.
std::string pictures_section(const ReportContent& content);

// The room as a 3-D view, on screens only.
std::string view_section(const ReportContent& content);

// The scripts of the page, for the end of its body.
std::string scripts_of_page(const ReportContent& content);

}  // namespace lichtmc
