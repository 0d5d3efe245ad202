// Results of calculation areas as tables of comma-separated values.
#pragma once

#include <cstddef>
#include <string>

#include "lichtmc/area_drawing.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc {

// area,role,quantity,points,left_out,em,em_se,emin,emin_se,emax,emax_se,u0,u0_se,ud,target_lx,target_uniformity,
// verdict,ud_se,em_verdict,u0_verdict,em_initial,emin_initial,emax_initial,lowest,highest,unit
// One row per area. points: of its grid; left_out: cells without one. em … emax: mean, minimum and maximum with their
// standard errors; u0 = emin/em, ud = emin/emax. target_lx, target_uniformity and the verdicts are empty without a
// target. *_initial: with the power of new emitters. lowest, highest: of the values at the points, as they are.
std::string areas_csv(const Result& result);

// The grid of Result::areas[area] as on its plan (`drawing`), for spreadsheets. Rows "word,value,…" about the area;
// then the values at its points, a row of the table for each row of the grid, with the places of columns and rows in
// the heading and in the first column (m from the upper left corner of the grid, to the right and down); then their
// standard errors in the same form. Cells without a point are empty.
std::string area_grid_csv(const Result& result, std::size_t area, const AreaDrawing& drawing);

}  // namespace lichtmc
