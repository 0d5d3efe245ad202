// Runs to be split into sessions, parts and ranks, and the test whether figures are the same to the last bit.
#pragma once

#include <cstdint>
#include <vector>

#include "lichtmc/lichtmc.hpp"

namespace lichtmc::test {

// Compares everything that comes from tallies, bit by bit.
bool same_figures(const Result& a, const Result& b);

// The objects in the room: none (a cuboid), a board in the middle, or a board with two separate sides and a texture in
// a room without a ceiling.
enum class Furniture { none, board, textured_board };

// Two emitters, different walls, two receivers.
Room room_to_split(Furniture furniture);

struct SplitRun {
  Furniture kind = Furniture::none;
  Settings settings;
};

// Both tracers, all estimators, truncated or not, few tiles and many, direct light counted and integrated, backward
// walks from tiles, textures and openings.
std::vector<SplitRun> split_runs();

// The state as another process reads it.
State written_and_read(const State& state);

// Histories first … last − 1 as a part of a run.
Result part(const Room& room, Settings settings, std::uint64_t first, std::uint64_t last);

}  // namespace lichtmc::test
