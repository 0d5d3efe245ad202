// What was found, as sections of the page: each a piece of HTML, empty where the run has nothing of the kind.
#pragma once

#include <string>

#include "lichtmc/result.hpp"
#include "output/report.hpp"

namespace lichtmc {

// A table of the surfaces, and those that were drawn laid flat.
std::string surfaces_section(const ReportContent& content);

// A table of the receivers, as many as a page can hold.
std::string receivers_section(const Result& result);

// What became of the emitters' power.
std::string balance_section(const Result& result);

// The error as it fell during the run.
std::string convergence_section(const Result& result);

}  // namespace lichtmc
