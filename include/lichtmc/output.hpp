// Results as files: a summary, tables, and a picture of numbers for every surface.
#pragma once

#include <filesystem>
#include <string>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/study.hpp"

namespace lichtmc {

// Makes the folder (and its parents) where it is missing and tries to write into it.
// Throws InputError where that fails. Call it before a long run, so that the run is not lost.
void prepare_output(const std::filesystem::path& folder);

// Writes summary.json into a folder; tiles.csv, surfaces.csv and tiles/NAME.exr where tiles were measured;
// receivers.csv where receivers were.
//
// Every file is written under a temporary name and renamed when it is whole; summary.json comes last, so that a folder
// with a summary.json of this run is complete. tiles/ holds the maps of this run only. Throws RuntimeError where
// something cannot be written.
void write_results(const Room& room, const Result& result, const std::filesystem::path& folder);

// Writes study.csv, error_over_time.svg, bias_over_bounces.svg, figures_of_merit.svg and advice.txt into a folder, each
// whole or not at all. Throws RuntimeError where one cannot be written.
void write_study(const Study& study, const std::filesystem::path& folder);

// What advice.txt holds: references, the cheapest settings, and what was left out.
std::string advice_text(const Study& study);

// What summary.json holds.
std::string summary_json(const Room& room, const Result& result);

}  // namespace lichtmc
