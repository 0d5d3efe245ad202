// The figures of calculation areas in words, for readers: terminal, plans, report.
#pragma once

#include <string>

#include "lichtmc/area.hpp"
#include "lichtmc/output.hpp"  // figure_text()
#include "lichtmc/result.hpp"
#include "lichtmc/units.hpp"

namespace lichtmc {

// "0.60"
std::string uniformity_target_text(double target);

// "desk (task)"
std::string area_title(const Area& area);

// "Em 349 ± 2 lx, U0 0.55 ± 0.01"; of radiant quantities "mean 3.49 ± 0.02 W/m², uniformity 0.55 ± 0.01".
std::string area_figures_text(const AreaResult& result, Quantity quantity);

// "target 500 lx, 0.60: fail (U0)", with the words of verdict_text(). Empty without a target.
std::string area_target_text(const AreaResult& result, Quantity quantity);

// "fail"; of two targets with different verdicts it tells which one: "fail (U0)", "undecided (Em)", "fail (Em; U0
// undecided)".
std::string verdict_text(Verdict verdict, Verdict of_mean, Verdict of_uniformity, Quantity quantity);

// "cylindrical illuminance, 0.75 m above the floor"
std::string area_quantity_text(const Area& area, Quantity quantity);

// "12 of 48 cells have no point: 8 outside its outline, 4 within 0.5 m of a wall"; empty if no cell is left out.
std::string area_left_out_text(const Area& area);

// Whether its figures are maintained values that differ from the initial ones.
bool has_maintenance(const AreaResult& result);

}  // namespace lichtmc
