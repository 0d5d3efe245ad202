// What is told about a run: its warnings, and the summary in a few lines.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc::app {

// The warnings of a run without those that begin a warning of the check before it (warning_lines()), which says more.
std::vector<std::string> without_repeated(std::vector<std::string> warnings, const std::vector<std::string>& of_check);

// To stderr: time, standard error, balance of powers, warnings, output files. `with_images`: tile maps as images were
// written.
void print_outcome(const Room& room, const Result& result, const std::filesystem::path& folder, bool with_report,
                   bool with_images);

}  // namespace lichtmc::app
