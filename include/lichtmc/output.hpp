// Results as files: a summary, tables, and a picture of numbers for every surface.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "lichtmc/paths.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/study.hpp"

namespace lichtmc {

// Makes the folder (and its parents) where it is missing, tries to write into it, and removes what a program that was
// killed while writing there has left.
// Throws InputError where that fails. Call it before a long run, so that the run is not lost.
void prepare_output(const std::filesystem::path& folder);

// Writes summary.json into a folder; tiles.csv, surfaces.csv and tiles/NAME.exr where tiles were measured;
// receivers.csv where receivers were.
//
// All files are written and flushed to the disk under other names first, and renamed then; summary.json comes last, so
// that a folder with a summary.json is complete. tiles/ holds the maps of this run only; the report of an earlier one
// is removed. Throws RuntimeError where something cannot be written: the files of an earlier run are whole then.
void write_results(const Room& room, const Result& result, const std::filesystem::path& folder);

struct ReportOptions {
  ScaleOptions scale;         // colours of all pictures
  bool exr_pictures = false;  // pictures as OpenEXR beside the others
  std::uint64_t paths = 0;    // so many photons' paths, 0 … 10 000, in report.html and room_lit.glb
  std::string command;        // what reproduces the run, for report.html; may be empty
  unsigned threads = 0;       // for drawing; 0: one per processor
  std::function<void(std::string_view)> progress;  // told what is being done, before each step
};

// What a report is: the room in false colour (room_lit.glb), pictures/room.svg, above.svg and one of each large surface
// (with .png files of the pixels alone), and report.html, a page with all of them, the tables, the balance,
// convergence, what inspect() finds, and how to reproduce it. report.html needs no other file and no network. Where
// only receivers were measured it has no pictures.
//
// Call it after write_results(); files appear whole or not at all, and those of an earlier report are removed. Throws
// InputError where an option is not allowed, RuntimeError where something cannot be drawn or written.
void write_report(const Room& room, const Result& result, const std::filesystem::path& folder,
                  const ReportOptions& options = {});

// Removes the report of an earlier run from a folder: report.html, room_lit.glb and the pictures that it wrote.
void remove_report(const std::filesystem::path& folder);

// Writes paths.csv, paths.svg (the room's edges with the paths) and paths.glb (lines, and nothing else) into a folder,
// each whole or not at all. Throws RuntimeError where one cannot be written.
void write_paths(const Room& room, const std::vector<PhotonPath>& paths, const std::filesystem::path& folder);

// Writes study.csv, error_over_time.svg, bias_over_bounces.svg, figures_of_merit.svg and advice.txt into a folder, each
// whole or not at all. Throws RuntimeError where one cannot be written.
void write_study(const Study& study, const std::filesystem::path& folder);

// What advice.txt holds: references, the cheapest settings, and what was left out.
std::string advice_text(const Study& study);

// What summary.json holds.
std::string summary_json(const Room& room, const Result& result);

}  // namespace lichtmc
