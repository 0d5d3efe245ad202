#include "output/folder.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <set>
#include <vector>

#include <fcntl.h>
#include <unistd.h>
#include <csignal>

#include "base/message.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

std::string reason_of(const std::error_code& error) {
  std::string text = error.message();
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

void refuse_folder(const fs::path& folder, const std::string& reason) {
  throw InputError("Cannot write into the output folder " + in_quotes(folder.string()) + " (" + reason +
                   "). Choose another folder with --output.");
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw RuntimeError("Cannot create the folder " + in_quotes(folder.string()) + " (" + reason_of(error) +
                       "). Choose another folder with --output.");
}

void remove_old(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error)
    throw RuntimeError("Cannot replace " + in_quotes(file.string()) + " (" + reason_of(error) +
                       "). Choose another folder with --output.");
}

void remove_old_files(const fs::path& folder, const std::function<bool(const fs::path&)>& is_old) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  std::vector<fs::path> old;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code unknown;
    if (entry->is_regular_file(unknown) && is_old(entry->path())) old.push_back(entry->path());
  }
  if (error)
    throw RuntimeError("Cannot list the folder " + in_quotes(folder.string()) + " (" + reason_of(error) +
                       "). Choose another folder with --output.");
  for (const fs::path& file : old) remove_old(file);
}

namespace {

constexpr std::string_view stage_prefix = ".lichtmc-";
constexpr std::string_view temporary_state = "state.h5.tmp";  // the prefix used by write_file_atomically()

// Whether a name is this prefix and the number of a process that does not exist. What is atomically written to such a
// name has ".tmp" and the number once more.
bool is_of_ended_process(std::string_view name, std::string_view prefix) {
  std::string_view digits = name.substr(prefix.size());
  constexpr std::string_view again = ".tmp";
  const std::size_t half = digits.find(again);
  if (half != std::string_view::npos && digits.substr(half + again.size()) == digits.substr(0, half))
    digits = digits.substr(0, half);
  pid_t process = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), process);
  if (error != std::errc() || end != digits.data() + digits.size() || process <= 0) return false;
  return ::kill(process, 0) != 0 && errno == ESRCH;
}

}  // namespace

// Process numbers are reused: removes the files of an earlier process with the same number.
StagedFiles::StagedFiles(const fs::path& folder)
    : folder_(folder), stage_(folder / (std::string(stage_prefix) + std::to_string(::getpid()))) {
  std::error_code error;
  fs::remove_all(stage_, error);
  if (error)
    throw RuntimeError("Cannot remove the folder " + in_quotes(stage_.string()) + " (" + reason_of(error) +
                       "), which an earlier run did not remove. Choose another folder with --output.");
  make_folder(stage_);
  stage_descriptor_ = ::open(stage_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (stage_descriptor_ < 0)
    throw RuntimeError("Cannot open the folder " + in_quotes(stage_.string()) + " (" +
                       reason_of({errno, std::generic_category()}) + "). Choose another folder with --output.");
}

StagedFiles::~StagedFiles() {
  if (stage_descriptor_ >= 0) ::close(stage_descriptor_);
  std::error_code ignored;
  fs::remove_all(stage_, ignored);
}

void StagedFiles::write(const fs::path& name, const std::function<void(const Sink&)>& produce) {
  const bool new_folder =
      name.has_parent_path() && (names_.empty() || names_.back().parent_path() != name.parent_path());
  if (new_folder) make_folder(stage_ / name.parent_path());
  write_file(stage_ / name, folder_ / name, produce);
  names_.push_back(name);
}

void StagedFiles::write(const fs::path& name, std::string_view bytes) {
  write(name, [bytes](const Sink& sink) { sink(bytes); });
}

void StagedFiles::flush() {
  std::vector<fs::path> files;
  for (std::size_t k = flushed_; k < names_.size(); ++k) files.push_back(stage_ / names_[k]);
  flush_files(stage_descriptor_, files);
  flushed_ = names_.size();
}

void StagedFiles::publish(const fs::path& last) {
  flush();
  std::vector<fs::path> names = names_;
  std::stable_partition(names.begin(), names.end(), [&last](const fs::path& name) { return name != last; });
  std::set<fs::path> folders{folder_};
  // Flushes the new names to disk before the last file is renamed: if it exists, even after a power failure, the others
  // exist too.
  const auto flush_all = [&folders] { std::for_each(folders.begin(), folders.end(), flush_folder); };
  for (const fs::path& name : names) {
    if (name == last) flush_all();
    if (name.has_parent_path() && folders.insert(folder_ / name.parent_path()).second)
      make_folder(folder_ / name.parent_path());
    std::error_code error;
    fs::rename(stage_ / name, folder_ / name, error);
    if (error)
      throw RuntimeError("Cannot write " + (folder_ / name).string() + " (" + reason_of(error) +
                         "). Choose another folder with --output.");
  }
  flush_all();
}

// Removes files by their names only: other files in the folder belong to the user.
void StagedFiles::remove_leftovers(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> old;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool stage = name.starts_with(stage_prefix) && is_of_ended_process(name, stage_prefix);
    const bool state = name.starts_with(temporary_state) && is_of_ended_process(name, temporary_state);
    if (stage || state) old.push_back(entry->path());
  }
  for (const fs::path& path : old) fs::remove_all(path, error);
}

}  // namespace lichtmc
