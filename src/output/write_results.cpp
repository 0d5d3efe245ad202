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
#include "output/folder.hpp"
#include "output/summary.hpp"
#include "output/tables.hpp"
#include "output/tile_image.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& reason) {
  throw InputError("Cannot write into the output folder " + lichtmc::in_quotes(folder.string()) + " (" + reason +
                   "). Choose another folder with --output.");
}

// Creates, writes and removes a file; returns the error if that fails. A check of permissions is not sufficient: the
// disk may be full or mounted read-only.
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
  StagedFiles::remove_leftovers(folder);
  for (const char* name : {"tiles", "pictures"}) {
    const fs::path inner = folder / name;
    if (!fs::exists(inner, error)) continue;
    if (!fs::is_directory(inner, error)) refuse_folder(folder, in_quotes(name) + " in it is not a folder");
    if (const std::error_code fault = try_to_write(inner)) refuse_folder(inner, reason_of(fault));
  }
}

void write_results(const Room& room, const Result& result, const fs::path& folder) {
  make_folder(folder / "tiles");
  StagedFiles staged(folder);
  std::vector<std::string> maps;
  if (!result.tiles.empty()) {
    maps = tile_image_names(result.tiling);
    for (std::size_t m = 0; m < maps.size(); ++m)
      write_file_atomically(staged / (fs::path("tiles") / maps[m]), tile_image(result, m));
    write_file_atomically(staged / "tiles.csv", [&](const Sink& sink) { write_tiles_csv(result, sink); });
    write_file_atomically(staged / "surfaces.csv", surfaces_csv(result));
  }
  if (!result.receiver_results.empty())
    write_file_atomically(staged / "receivers.csv", [&](const Sink& sink) { write_receivers_csv(result, sink); });
  write_file_atomically(staged / "summary.json", [&](const Sink& sink) { write_summary(room, result, sink); });

  // All new files are on the disk: the old files can be replaced. The old summary is removed first, because a folder
  // with a summary.json is complete.
  remove_old(folder / "summary.json");
  flush_folder(folder);
  remove_report(folder);
  // Removes results of an earlier run that this run does not replace. Other files stay.
  const std::set<std::string> new_maps(maps.begin(), maps.end());
  remove_old_files(folder / "tiles", [&](const fs::path& file) {
    return file.extension() == ".exr" && new_maps.count(file.filename().string()) == 0;
  });
  if (result.tiles.empty()) {
    remove_old(folder / "tiles.csv");
    remove_old(folder / "surfaces.csv");
  }
  if (result.receiver_results.empty()) remove_old(folder / "receivers.csv");
  staged.publish("summary.json");
}

}  // namespace lichtmc
