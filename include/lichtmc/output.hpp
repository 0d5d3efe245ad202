// Writes results to files: summary, tables, and one OpenEXR image per tile map.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/folder_lock.hpp"
#include "lichtmc/inspect.hpp"
#include "lichtmc/paths.hpp"
#include "lichtmc/photometry.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/prepared_room.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/study.hpp"

namespace lichtmc {

// Creates the folder and its parents if necessary, locks it, checks that it is writable, and removes temporary files of
// processes that were killed while writing. Throws InputError if that fails, or if another writer holds the folder.
// Call it before a long run, and keep the lock until all is written: what cannot be written, or would be mixed with the
// results of another run, is then reported before the simulation.
[[nodiscard]] FolderLock prepare_output(const std::filesystem::path& folder);

// Which files write_results() writes.
struct ResultFiles {
  bool tile_images = true;  // tiles/NAME.exr
  // The content of result.lichtmc, in which a program keeps what it needs to have the result again; empty: none.
  std::string kept = {};
};

// Writes summary.json and emitters.csv into a folder; with results of tiles also tiles.csv, surfaces.csv and
// tiles/NAME.exr; with results of receivers also receivers.csv; with impulse responses also impulse_response.csv,
// channels.csv, channels.h5 and channels.mat, except those that files_left_out() names; with calculation areas also
// areas.csv, and of each area areas/NAME.csv (its grid), areas/NAME.svg and areas/NAME.dxf (its plan).
//
// All files are first written and flushed to disk under temporary names, then renamed; summary.json is renamed last: a
// folder with a summary.json is complete. Tile maps and the report of an earlier run are removed. Throws RuntimeError
// if a file cannot be written; the files of an earlier run are then unchanged.
//
// It does not lock the folder: two calls for one folder at the same time mix their files. Hold the lock that
// prepare_output() returns.
void write_results(const Room& room, const Result& result, const std::filesystem::path& folder,
                   const ResultFiles& files = {});

// Which files write_results() cannot write because their format cannot hold the result; sentences with the reason and
// what to do. summary.json and the report have them too.
std::vector<std::string> files_left_out(const Result& result);

// For whom the report is.
enum class ReportStyle {
  automatic,  // lighting if the result has calculation areas, else technical
  // Pages for a client: title, calculation areas with their targets and plans, luminaires, pictures, surfaces, how sure
  // the figures are. The technical report follows as an appendix.
  lighting,
  technical,  // how the run went: figures, pictures, tables, balance of powers, convergence, settings
};

struct ReportOptions {
  ReportStyle style = ReportStyle::automatic;
  // For the title of lighting pages, any text; what is empty is left out. The date is text too: a date that the program
  // added by itself would differ from run to run.
  std::string project, author, date;
  ScaleOptions scale;         // colour scale of all pictures
  bool exr_pictures = false;  // also write the pictures as OpenEXR
  bool tile_images = true;    // as in ResultFiles: the page says if there are none
  std::uint64_t paths = 0;    // number of photon paths in report.html and room_lit.glb, 0 … 10 000
  std::string command;        // command that reproduces the run, for report.html; may be empty
  unsigned threads = 0;       // for drawing; 0: one per processor
  std::function<void(std::string_view)> progress;  // called with a description before each step
  // What inspect() has found with the tiles of the result; null: the room is inspected again.
  std::shared_ptr<const Inspection> inspection;
  std::shared_ptr<PreparedRoom> prepared;  // see prepare()
};

// Writes a report: the room in false colour (room_lit.glb); pictures/room.svg, above.svg and one per large surface
// (with .png files of the pixels only); and report.html, one page with the pictures, plans of the calculation areas,
// tables, power balance, convergence, the findings of inspect(), and the command that reproduces the run. report.html
// needs no other file and no network. Without results of tiles there is no room_lit.glb and no picture of a surface,
// and the pictures of the room are grey, with the receivers and the cells of the areas in false colour.
//
// Call it after write_results(). Files are replaced atomically; files of an earlier report are removed. Throws
// InputError if an option is out of range, RuntimeError if a picture cannot be drawn or a file cannot be written.
void write_report(const Room& room, const Result& result, const std::filesystem::path& folder,
                  const ReportOptions& options = {});

// Removes the report of an earlier run from a folder: report.html, room_lit.glb and its pictures.
void remove_report(const std::filesystem::path& folder);

// Writes paths.csv, paths.svg (edges of the room, and the paths) and paths.glb (the paths only) into a folder, each
// atomically. Throws RuntimeError if a file cannot be written.
void write_paths(const Room& room, const std::vector<PhotonPath>& paths, const std::filesystem::path& folder);

// Writes study.csv, error_over_time.svg, bias_over_bounces.svg, figures_of_merit.svg and advice.txt into a folder, each
// atomically. Throws RuntimeError if a file cannot be written.
void write_study(const Study& study, const std::filesystem::path& folder);

// The content of advice.txt: references, the settings with the lowest cost, and what was left out.
std::string advice_text(const Study& study);

// The figures of a luminaire as JSON, for programs.
std::string luminaire_json(const Photometry& photometry);

// The picture of a luminaire: its polar diagram and, if its intensity is not the same in all C planes, that of all
// directions in false colour. A complete SVG.
std::string luminaire_svg(const Photometry& photometry);

// Writes it to a file, atomically. Throws RuntimeError if that fails.
void write_luminaire_svg(const Photometry& photometry, const std::filesystem::path& file);

// A figure with its standard error, to one digit of the error and at most so many of the value: "349 ± 2", "0.55 ±
// 0.01". The error is rounded up. An error of 0 or an unknown one is left out. "–" without a value.
std::string figure_text(const Figure& figure, int most_digits = 4);

// The figures of a calculation area, for readers: "desk (task): Em 349 ± 2 lx, U0 0.55 ± 0.01, target 500 lx, 0.60:
// fail".
std::string area_line(const AreaResult& result, Quantity quantity);

// The pixels of a picture: red, green, blue (sRGB, not multiplied by opacity) and opacity, 0 … 255 each, row by row
// from the top left.
std::vector<std::uint8_t> rgba_of(const Picture& picture);

// The same as a PNG file. Throws RuntimeError if the memory does not suffice.
std::string png_of(const Picture& picture);

// A picture of the room with its title, the colour scale, marks for the emitters and dots in false colour for the
// receivers, as an SVG file. `png`: png_of(picture).
std::string room_svg(const Room& room, const Result& result, const Picture& picture, const std::string& png,
                     const ColourScale& scale, View view);

// The content of summary.json.
std::string summary_json(const Room& room, const Result& result, const ResultFiles& files = {});

}  // namespace lichtmc
