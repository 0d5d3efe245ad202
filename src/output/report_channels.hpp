// The channels as a section of the page.
#pragma once

#include <string>

#include "output/report_content.hpp"

namespace lichtmc {

// A table of the first channels, the pictures of some, and what the figures mean; HTML, empty without channels.
std::string channels_section(const ReportContent& content);

}  // namespace lichtmc
