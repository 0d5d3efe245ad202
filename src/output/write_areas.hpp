// The files of calculation areas.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "output/folder.hpp"

namespace lichtmc {

// Grid, plan, and plan for CAD programs.
inline constexpr std::array<const char*, 3> area_file_endings{".csv", ".svg", ".dxf"};

// The names of the areas' files, without their endings: file_stems() of the names of the areas.
std::vector<std::string> area_file_stems(const Result& result);

// Writes areas.csv and the files areas/NAME.csv, .svg and .dxf of each area. Throws RuntimeError if that fails.
void write_areas(const Room& room, const Result& result, StagedFiles& staged);

// Removes the files of areas of an earlier run that this result does not have. Throws RuntimeError if that fails.
void remove_old_areas(const Result& result, const std::filesystem::path& folder);

}  // namespace lichtmc
