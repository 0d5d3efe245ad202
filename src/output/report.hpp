// The report as an HTML page.
#pragma once

#include <string>

#include "output/report_content.hpp"

namespace lichtmc {

// One self-contained file: style sheets, scripts, pictures, and the room for the 3-D view.
std::string report_html(const ReportContent& content);

}  // namespace lichtmc
