// The receivers as a section of the page.
#pragma once

#include <string>

#include "output/report_content.hpp"

namespace lichtmc {

// Empty without receivers. In lighting reports without the points of calculation areas, whose plans show them. Gains
// only where someone may ask for them: of radiant powers, and with impulse responses.
std::string receivers_section(const ReportContent& content);

}  // namespace lichtmc
