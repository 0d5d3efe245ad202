// The summary of a run in a few lines.
#pragma once

#include <filesystem>

#include "lichtmc/result.hpp"

namespace lichtmc::app {

// To stderr: time, standard error, balance of powers, warnings, output files.
void print_outcome(const Result& result, const std::filesystem::path& folder, bool with_report);

}  // namespace lichtmc::app
