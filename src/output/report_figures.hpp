// The results as sections of the page. Each function returns HTML; empty if the result has no such data.
#pragma once

#include <string>

#include "lichtmc/result.hpp"
#include "output/report_content.hpp"

namespace lichtmc {

// A table of the surfaces, and the plans.
std::string surfaces_section(const ReportContent& content);

// The power balance: absorbed, escaped, residual and lost power.
std::string balance_section(const Room& room, const Result& result);

// The relative standard error as a function of the number of histories.
std::string convergence_section(const Result& result);

}  // namespace lichtmc
