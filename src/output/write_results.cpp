#include <cctype>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/output.hpp"
#include "output/summary.hpp"
#include "output/tables.hpp"
#include "output/tile_image.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

namespace {

// The system's words inside a sentence: "permission denied".
std::string reason_of(const std::error_code& error) {
  std::string text = error.message();
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& reason) {
  throw InputError("Cannot write into the output folder " + lichtmc::in_quotes(folder.string()) + " (" + reason +
                   "). Choose another folder with --output.");
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw RuntimeError("Cannot make the folder " + lichtmc::in_quotes(folder.string()) + " (" + reason_of(error) +
                       "). Choose another folder with --output.");
}

// Maps of an earlier run that this one has not written again. Other files are left alone.
void remove_foreign_maps(const fs::path& folder, const std::set<std::string>& ours) {
  std::error_code error;
  std::vector<fs::path> foreign;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code unknown;
    const bool map = entry->path().extension() == ".exr" && entry->is_regular_file(unknown);
    if (map && ours.count(entry->path().filename().string()) == 0) foreign.push_back(entry->path());
  }
  if (error)
    throw RuntimeError("Cannot list the folder " + lichtmc::in_quotes(folder.string()) + " (" + reason_of(error) +
                       "). Choose another folder with --output.");
  for (const fs::path& file : foreign) {
    fs::remove(file, error);
    if (error)
      throw RuntimeError("Cannot remove the old tile map " + lichtmc::in_quotes(file.string()) + " (" +
                         reason_of(error) + "). Remove it yourself.");
  }
}

void remove_old(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error)
    throw RuntimeError("Cannot replace " + lichtmc::in_quotes(file.string()) + " (" + reason_of(error) +
                       "). Choose another folder with --output.");
}

// Whether a file can be made, filled and removed there, or why not. Permissions alone do not tell: disks are full, or
// mounted for reading only.
std::error_code try_to_write(const fs::path& folder) {
  const fs::path probe = folder / ".lichtmc_probe";
  errno = 0;
  std::FILE* file = std::fopen(probe.c_str(), "w");
  if (file == nullptr) return {errno, std::generic_category()};
  const bool written = std::fputs("x", file) >= 0 && std::fflush(file) == 0;
  const std::error_code fault = written ? std::error_code() : std::error_code(errno, std::generic_category());
  std::fclose(file);
  std::error_code removal;
  fs::remove(probe, removal);
  return fault ? fault : removal;
}

}  // namespace

void prepare_output(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse_folder(folder, reason_of(error));
  if (const std::error_code fault = try_to_write(folder)) refuse_folder(folder, reason_of(fault));
  const fs::path maps = folder / "tiles";
  if (!fs::exists(maps, error)) return;
  if (!fs::is_directory(maps, error)) refuse_folder(folder, "'tiles' in it is no folder");
  if (const std::error_code fault = try_to_write(maps)) refuse_folder(maps, reason_of(fault));
}

void write_results(const Room& room, const Result& result, const fs::path& folder) {
  make_folder(folder / "tiles");
  // A summary speaks for all files beside it: none while they change.
  remove_old(folder / "summary.json");

  // What this run has not computed is not left over from another.
  std::vector<std::string> names;
  if (!result.tiles.empty()) names = tile_image_names(result.tiling);
  for (std::size_t m = 0; m < names.size(); ++m)
    write_file_atomically(folder / "tiles" / names[m], tile_image(result, m));
  remove_foreign_maps(folder / "tiles", {names.begin(), names.end()});
  if (!result.tiles.empty()) {
    write_file_atomically(folder / "tiles.csv", [&](const Sink& sink) { write_tiles_csv(result, sink); });
    write_file_atomically(folder / "surfaces.csv", surfaces_csv(result));
  } else {
    remove_old(folder / "tiles.csv");
    remove_old(folder / "surfaces.csv");
  }
  if (!result.receiver_results.empty()) {
    write_file_atomically(folder / "receivers.csv", [&](const Sink& sink) { write_receivers_csv(result, sink); });
  } else {
    remove_old(folder / "receivers.csv");
  }
  write_file_atomically(folder / "summary.json", [&](const Sink& sink) { write_summary(room, result, sink); });
}

}  // namespace lichtmc
