// The folder of the results.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/atomic_file.hpp"

namespace lichtmc {

// A set of files that is written completely or not at all: first into a temporary folder inside the folder, then, when
// all are on the disk, renamed. Until then, the existing files stay unchanged, also if the disk is full.
class StagedFiles {
 public:
  // Throws RuntimeError if the folder is not writable.
  explicit StagedFiles(const std::filesystem::path& folder);
  // Removes the files that were not published.
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  // Writes the later file folder/name (or folder/inner/name). Throws RuntimeError.
  void write(const std::filesystem::path& name, const std::function<void(const Sink&)>& produce);
  void write(const std::filesystem::path& name, std::string_view bytes);

  // Flushes the files written so far to the disk. Throws RuntimeError if that fails.
  void flush();

  // Flushes all files and renames them to their final names; the file named `last`, if there is one, after all others.
  // Throws RuntimeError if a file cannot be flushed or renamed.
  void publish(const std::filesystem::path& last);

  // Removes the temporary files of killed processes from a folder.
  static void remove_leftovers(const std::filesystem::path& folder);

 private:
  std::filesystem::path folder_;
  std::filesystem::path stage_;
  int stage_descriptor_ = -1;
  std::vector<std::filesystem::path> names_;
  std::size_t flushed_ = 0;  // number of the names whose files are on the disk
};

// Throws InputError: the folder cannot be written into, for this reason.
[[noreturn]] void refuse_folder(const std::filesystem::path& folder, const std::string& reason);

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
