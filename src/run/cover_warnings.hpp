// Warnings about surfaces that lie in the plane of others.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lichtmc/cover.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

struct CoverWarning {
  std::string what;
  std::string advice;
};

// Area lights of which others in their plane cover more than a thousandth, a sentence each.
std::vector<CoverWarning> covered_emitters(const Room& room, const std::vector<Cover>& covers);

// Surfaces between which no rule decides, if light arrives there: `undecided` of `impacts` flights. One or none.
std::vector<CoverWarning> undecided_covers(const Room& room, const std::vector<Cover>& covers, std::uint64_t undecided,
                                           std::uint64_t impacts);

// "'rug' covers 3.75 m² of 'floor'", the largest areas first, at most `most` of them, and how many more. `undecided`:
// only the areas on which no rule decides.
std::string text_of_covers(const Room& room, const std::vector<Cover>& covers, std::size_t most, bool undecided);

}  // namespace lichtmc
