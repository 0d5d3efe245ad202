#include "output/folder.hpp"

#include <cctype>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

std::string reason_of(const std::error_code& error) {
  std::string text = error.message();
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw RuntimeError("Cannot make the folder " + in_quotes(folder.string()) + " (" + reason_of(error) +
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

}  // namespace lichtmc
