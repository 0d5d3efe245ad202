// The folder of the results.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <system_error>

namespace lichtmc {

// A set of files that is written completely or not at all: first into a temporary folder inside the folder, then
// renamed. Until then, the existing files stay unchanged, also if the disk is full.
class StagedFiles {
 public:
  // Throws RuntimeError if the folder is not writable.
  explicit StagedFiles(const std::filesystem::path& folder);
  // Removes the files that were not published.
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  // The path to write the later file folder/name (or folder/inner/name) to.
  std::filesystem::path operator/(const std::filesystem::path& name) const;

  // Renames all files to their final names; the file named `last`, if there is one, after all others. Throws
  // RuntimeError if a file cannot be renamed.
  void publish(const std::filesystem::path& last);

  // Removes the temporary files of killed processes from a folder.
  static void remove_leftovers(const std::filesystem::path& folder);

 private:
  std::filesystem::path folder_;
  std::filesystem::path stage_;
};

// The message of the operating system in lower case, for use in a sentence: "permission denied".
std::string reason_of(const std::error_code& error);

// Creates a folder and its parents. Throws RuntimeError if that fails.
void make_folder(const std::filesystem::path& folder);

// Removes a file of an earlier run, if it exists. Throws RuntimeError if that fails.
void remove_old(const std::filesystem::path& file);

// Removes the files of a folder for which `is_old` returns true; the folder may be missing. Throws RuntimeError if that
// fails.
void remove_old_files(const std::filesystem::path& folder,
                      const std::function<bool(const std::filesystem::path&)>& is_old);

}  // namespace lichtmc
