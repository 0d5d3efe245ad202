// The settings with the lowest cost for some accuracies, from the rows of a study.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/study.hpp"

namespace lichtmc {

// For 10 %, 1 % and 0.1 %, of the rows with this tile edge. Time and histories are extrapolated: variance is inversely
// proportional to the histories, the time to integrate direct light and the bias are constant. A row whose bias is too
// large for an accuracy is not used for it; an accuracy that no row can reach is left out.
std::vector<Advice> advice_from(const std::vector<StudyRow>& rows, double tile_edge_m, const std::string& room);

}  // namespace lichtmc
