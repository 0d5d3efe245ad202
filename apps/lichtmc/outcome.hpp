// The summary of a run in a few lines.
#pragma once

#include <filesystem>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc::app {

// To stderr: time, standard error, balance of powers, warnings, output files. `with_images`: tile maps as images were
// written.
void print_outcome(const Room& room, const Result& result, const std::filesystem::path& folder, bool with_report,
                   bool with_images);

}  // namespace lichtmc::app
