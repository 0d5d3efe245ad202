#include <filesystem>
#include <set>
#include <string>
#include <system_error>

#include "base/atomic_file.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/output.hpp"
#include "output/tables.hpp"
#include "output/tile_image.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& reason) {
  throw InputError("Cannot write into the output folder " + folder.string() + " (" + reason +
                   "). Choose another folder with --output.");
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw RuntimeError("Cannot make the folder " + folder.string() + " (" + error.message() +
                       "). Choose another folder.");
}

// Maps of an earlier run that this one has not written again. Other files are left alone.
void remove_foreign_maps(const fs::path& folder, const std::set<std::string>& ours) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".exr" || ours.count(entry.path().filename().string()) != 0) continue;
    fs::remove(entry.path(), error);
    if (error)
      throw RuntimeError("Cannot remove the old tile map " + entry.path().string() + " (" + error.message() +
                         "). Remove it yourself.");
  }
}

}  // namespace

void prepare_output(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse_folder(folder, error.message());
  if (!fs::is_directory(folder)) refuse_folder(folder, "it is a file");
  const fs::path probe = folder / ".lichtmc_probe";
  try {
    write_file_atomically(probe, "");
  } catch (const RuntimeError&) {
    refuse_folder(folder, "no file can be written there");
  }
  fs::remove(probe, error);
}

void write_results(const Room& room, const Result& result, const fs::path& folder) {
  make_folder(folder / "tiles");
  // A summary speaks for all files beside it: none while they change.
  std::error_code error;
  fs::remove(folder / "summary.json", error);
  if (error)
    throw RuntimeError("Cannot replace " + (folder / "summary.json").string() + " (" + error.message() +
                       "). Choose another folder.");

  const std::vector<std::string> names = tile_image_names(result.tiling);
  for (std::size_t m = 0; m < names.size(); ++m)
    write_file_atomically(folder / "tiles" / names[m], tile_image(result, m));
  remove_foreign_maps(folder / "tiles", {names.begin(), names.end()});
  write_file_atomically(folder / "tiles.csv", tiles_csv(result));
  write_file_atomically(folder / "surfaces.csv", surfaces_csv(result));
  write_file_atomically(folder / "summary.json", summary_json(room, result));
}

}  // namespace lichtmc
