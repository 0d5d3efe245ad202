// Reads the files of write_results().
#pragma once

#include <filesystem>

#include "output/comparable.hpp"

namespace lichtmc {

// Throws InputError if the folder contains no result, or if a file is damaged.
ComparableResult read_results(const std::filesystem::path& folder);

}  // namespace lichtmc
