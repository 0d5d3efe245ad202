// The folder that results are written into.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <system_error>

namespace lichtmc {

// Files that belong together: written into a folder within the folder, then moved to their places all at once. Until
// then nothing of what was there is touched, so that a full disk costs nothing.
class StagedFiles {
 public:
  // Throws RuntimeError where the folder cannot be written to.
  explicit StagedFiles(const std::filesystem::path& folder);
  // Removes what was not published.
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  // Where to write the file that is to become folder/name, or folder/inner/name.
  std::filesystem::path operator/(const std::filesystem::path& name) const;

  // Moves every file to its place; `last`, if there is one of that name, as the last. Throws RuntimeError where one
  // cannot be moved.
  void publish(const std::filesystem::path& last);

  // Removes what programs that were killed have left in a folder.
  static void remove_leftovers(const std::filesystem::path& folder);

 private:
  std::filesystem::path folder_;
  std::filesystem::path stage_;
};

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
