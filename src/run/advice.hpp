// The cheapest settings for some accuracies, from what a study has measured.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/study.hpp"

namespace lichtmc {

// For 10 %, 1 % and 0.1 %, of the rows with this tile edge. Time and histories are forecast: variance falls with the
// histories, the time to integrate direct light does not, and a bias stays; a row whose bias alone is too
// large is out. None where no row can do it.
std::vector<Advice> advice_from(const std::vector<StudyRow>& rows, double tile_edge_m, const std::string& room);

}  // namespace lichtmc
