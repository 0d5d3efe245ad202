// What a run has found, in a few lines for people.
#pragma once

#include <filesystem>

#include "lichtmc/result.hpp"

namespace lichtmc::app {

// To stderr: how long, how sure, where the power went, what to be careful about, where the files are.
void print_outcome(const Result& result, const std::filesystem::path& folder, bool with_report);

}  // namespace lichtmc::app
