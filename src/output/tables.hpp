// Results as tables of comma-separated values (RFC 4180): a header row with the names of the columns, then a row per
// tile, surface or receiver. Long ones are written piece by piece.
#pragma once

#include <string>
#include <string_view>

#include "base/atomic_file.hpp"
#include "lichtmc/paths.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc {

// tile,surface,column,row,x,y,z,area,power,irradiance,standard_error,hits,unit[,direct,indirect]
// x, y, z (m): a point of the surface in the tile; area m²; power W or lm; irradiance and its standard error in `unit`.
// The standard error is "nan" where fewer than two batches were simulated. direct, indirect: the parts of the
// irradiance, where they were found apart. Numbers read back as the same doubles.
void write_tiles_csv(const Result& result, const Sink& sink);

// name,material,reflectance,area,tiles,mean_irradiance,min_irradiance,max_irradiance,standard_error,power,behind_share,hits,unit[,direct,indirect]
// One row per tile map: a surface, or the back of a two-sided one. standard_error is that of the mean, as direct and
// indirect are means.
std::string surfaces_csv(const Result& result);

// A text as a field: in quotes, its own quotes doubled, where it holds a comma, a quote or a line break.
std::string csv_field(std::string_view text);

// photon,flight,x,y,z,surface,weight,event
// A row for the start of each path and for the end of each flight: flight 0 is the start; x, y, z in m; surface: its
// name, empty in the open; weight: that the photon came with; event: "emitted", "reflected", or what became of the
// photon in the end.
std::string paths_csv(const Room& room, const std::vector<PhotonPath>& paths);

// receiver,name,x,y,z,nx,ny,nz,irradiance,direct,indirect,standard_error,gain,gain_db,unit
// One row per receiver: position (m) and the direction that it looks to; irradiance = direct + indirect with its
// standard error in `unit`; gain H = irradiance · area / emitted power, plain and as 10 log₁₀ H (empty where H is 0).
void write_receivers_csv(const Result& result, const Sink& sink);

}  // namespace lichtmc
