// What changes the meaning of the figures of a report.
#pragma once

#include <string>
#include <vector>

#include "output/report_content.hpp"

namespace lichtmc {

// Warnings of the run and of inspect(), files that are missing, parts that are not modelled; sentences.
std::vector<std::string> remarks_of(const ReportContent& content);

// The same as a section of the page; empty without remarks.
std::string remarks_section(const ReportContent& content);

}  // namespace lichtmc
