#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/message.hpp"
#include "base/parallel.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/output.hpp"
#include "output/channel_tables.hpp"
#include "output/channels_h5.hpp"
#include "output/channels_mat.hpp"
#include "output/emitter_parts_h5.hpp"
#include "output/folder.hpp"
#include "output/luminaire_schedule.hpp"
#include "output/summary.hpp"
#include "output/tables.hpp"
#include "output/tile_image.hpp"
#include "output/write_areas.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

namespace {

constexpr const char* kept_result_file = "result.lichtmc";

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

// Images are made on all threads of the run, as many at a time, and written in order.
void write_images(const Result& result, const std::vector<std::string>& names, StagedFiles& staged) {
  const unsigned threads = std::max(1U, result.threads);
  std::vector<std::string> images(threads);
  for (std::size_t first = 0; first < names.size(); first += images.size()) {
    const std::size_t count = std::min(images.size(), names.size() - first);
    for_each_on_threads(threads, count, [&](std::size_t k) { images[k] = tile_image(result, first + k); });
    for (std::size_t k = 0; k < count; ++k) staged.write(fs::path("tiles") / names[first + k], images[k]);
  }
}

void write_channels(const Result& result, StagedFiles& staged) {
  staged.write("impulse_response.csv", [&](const Sink& sink) { write_impulse_responses_csv(result, sink); });
  staged.write("channels.csv", [&](const Sink& sink) { write_channels_csv(result, sink); });
  staged.write("channels.h5", [&](const Sink& sink) { write_channels_h5(result, sink); });
  if (obstacle_to_channels_mat(result).empty())
    staged.write("channels.mat", [&](const Sink& sink) { write_channels_mat(result, sink); });
}

}  // namespace

std::vector<std::string> files_left_out(const Result& result) {
  if (!result.channels) return {};
  const std::string obstacle = obstacle_to_channels_mat(result);
  return obstacle.empty() ? std::vector<std::string>() : std::vector<std::string>{obstacle};
}

FolderLock prepare_output(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse_folder(folder, reason_of(error));
  FolderLock lock(folder);
  if (const std::error_code fault = try_to_write(folder)) refuse_folder(folder, reason_of(fault));
  StagedFiles::remove_leftovers(folder);
  for (const char* name : {"tiles", "areas", "pictures"}) {
    const fs::path inner = folder / name;
    if (!fs::exists(inner, error)) continue;
    if (!fs::is_directory(inner, error)) refuse_folder(folder, in_quotes(name) + " in it is not a folder");
    if (const std::error_code fault = try_to_write(inner)) refuse_folder(inner, reason_of(fault));
  }
  return lock;
}

void write_results(const Room& room, const Result& result, const fs::path& folder, const ResultFiles& files) {
  make_folder(folder);
  StagedFiles staged(folder);
  std::set<std::string> images;
  if (!result.tiles.empty() && files.tile_images) {
    const std::vector<std::string> names = tile_image_names(result.tiling);
    images.insert(names.begin(), names.end());
    write_images(result, names, staged);
  }
  if (!result.tiles.empty()) {
    staged.write("tiles.csv", [&](const Sink& sink) { write_tiles_csv(result, sink); });
    staged.write("surfaces.csv", surfaces_csv(result));
  }
  if (!result.receiver_results.empty())
    staged.write("receivers.csv", [&](const Sink& sink) { write_receivers_csv(result, sink); });
  if (result.channels) write_channels(result, staged);
  write_areas(room, result, staged);
  if (result.parts)
    staged.write(emitter_parts_file, [&](const Sink& sink) { write_emitter_parts(room, result, sink); });
  if (!files.kept.empty()) staged.write(kept_result_file, files.kept);
  staged.write("emitters.csv", emitters_csv(room));
  staged.write("summary.json", [&](const Sink& sink) { write_summary(room, result, files, sink); });
  staged.flush();

  // All new files are on the disk: the old files can be replaced. The old summary is removed first, because a folder
  // with a summary.json is complete.
  remove_old(folder / "summary.json");
  flush_folder(folder);
  remove_report(folder);
  // Removes results of an earlier run that this run does not replace. Other files stay.
  remove_old_files(folder / "tiles", [&](const fs::path& file) {
    return file.extension() == ".exr" && images.count(file.filename().string()) == 0;
  });
  if (images.empty()) {
    std::error_code not_empty;
    fs::remove(folder / "tiles", not_empty);
  }
  if (result.tiles.empty()) {
    remove_old(folder / "tiles.csv");
    remove_old(folder / "surfaces.csv");
  }
  if (result.receiver_results.empty()) remove_old(folder / "receivers.csv");
  remove_old_areas(result, folder);
  if (!result.parts) remove_old(folder / emitter_parts_file);
  if (files.kept.empty()) remove_old(folder / kept_result_file);
  if (!result.channels) {
    for (const char* name : {"impulse_response.csv", "channels.csv", "channels.h5"}) remove_old(folder / name);
  }
  if (!result.channels || !obstacle_to_channels_mat(result).empty()) remove_old(folder / "channels.mat");
  staged.publish("summary.json");
}

}  // namespace lichtmc
