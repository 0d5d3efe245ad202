// The folder that results are written into.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <system_error>

namespace lichtmc {

// The system's words inside a sentence: "permission denied".
std::string reason_of(const std::error_code& error);

// Makes a folder and its parents. Throws RuntimeError where that fails.
void make_folder(const std::filesystem::path& folder);

// Removes a file of an earlier run, if it is there. Throws RuntimeError where that fails.
void remove_old(const std::filesystem::path& file);

// Removes the files of a folder that `is_old` picks by their names; none where there is no folder. Throws RuntimeError
// where that fails.
void remove_old_files(const std::filesystem::path& folder,
                      const std::function<bool(const std::filesystem::path&)>& is_old);

}  // namespace lichtmc
