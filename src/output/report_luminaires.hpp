// The luminaire schedule as a section of the page.
#pragma once

#include <string>

#include "output/report_content.hpp"

namespace lichtmc {

// HTML; empty without luminaires of photometric files.
std::string luminaires_section(const ReportContent& content);

}  // namespace lichtmc
