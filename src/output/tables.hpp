// Results as tables of comma-separated values (RFC 4180): a header row with the names of the columns, then one row per
// tile, surface or receiver. Long tables are written row by row. Names are written as they are: CsvReader
// (base/csv.hpp) reads back the same text.
#pragma once

#include <string>

#include "base/atomic_file.hpp"
#include "lichtmc/paths.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc {

// tile,surface,column,row,x,y,z,area,power,irradiance,standard_error,hits,unit[,direct,indirect]
// x, y, z (m): a point of the surface in the tile; area m²; power W or lm; irradiance and its standard error in `unit`.
// The standard error is "nan" with fewer than two batches. direct, indirect: the parts of the irradiance, if computed
// separately. Numbers have enough digits to give the same doubles when read.
void write_tiles_csv(const Result& result, const Sink& sink);

// name,material,reflectance,area,tiles,mean_irradiance,min_irradiance,max_irradiance,standard_error,power,behind_share,hits,unit[,direct,indirect],absorbed,unreached_area
// One row per tile map: a surface, or the back of a two-sided surface. standard_error is that of the mean irradiance;
// direct and indirect are means too. absorbed: W or lm. unreached_area: m² that light cannot reach; means and the lowest
// irradiance are of the rest.
std::string surfaces_csv(const Result& result);

// photon,flight,x,y,z,surface,weight,event
// One row for the start of each path and for the end of each flight: flight 0 is the start; x, y, z in m; surface: its
// name, empty if the point is on no surface; weight: of the photon on arrival; event: "emitted", "reflected", or the
// end of the history.
std::string paths_csv(const Room& room, const std::vector<PhotonPath>& paths);

// receiver,name,x,y,z,nx,ny,nz,irradiance,direct,indirect,standard_error,gain,gain_db,unit
// One row per receiver: position (m) and normal; irradiance = direct + indirect, and its standard error, in `unit`;
// gain H = irradiance · area / emitted power, as a number and as 10 log₁₀ H in dB (empty if H is 0).
void write_receivers_csv(const Result& result, const Sink& sink);

}  // namespace lichtmc
