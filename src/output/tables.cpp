#include "output/tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "base/message.hpp"
#include "output/table_rows.hpp"

namespace lichtmc {

namespace {

// Writes the rows collected so far.
void flush(std::string& table, const Sink& sink) {
  sink(table);
  table.clear();
}

constexpr const char* parts = ",direct,indirect";

// The unit; and the direct and indirect parts of an irradiance, if computed separately.
std::string unit_and_parts(const std::string& unit, double irradiance, double direct) {
  return std::isnan(direct) ? unit : unit + ',' + to_text(direct) + ',' + to_text(irradiance - direct);
}

}  // namespace

void write_tiles_csv(const Result& result, const Sink& sink) {
  std::string table = "tile,surface,column,row,x,y,z,area,power,irradiance,standard_error,hits,unit";
  if (direct_is_apart(result)) table += parts;
  table += '\n';
  const std::string unit(irradiance_unit(result.quantity));
  std::vector<std::string> names;
  for (const TileMap& map : result.tiling.maps) names.push_back(csv_field(map.name));
  const auto row = [&](std::size_t i, std::string& rows) {
    const Tile& tile = result.tiling.tiles[i];
    const TileResult& figures = result.tiles[i];
    append_row(rows, std::to_string(i), names[tile.map], std::to_string(tile.column), std::to_string(tile.row),
               to_text(tile.point.x), to_text(tile.point.y), to_text(tile.point.z), to_text(tile.area_m2),
               to_text(figures.power), to_text(figures.irradiance), to_text(figures.standard_error),
               std::to_string(figures.hits), unit_and_parts(unit, figures.irradiance, figures.direct));
  };
  flush(table, sink);
  write_rows(std::max(1U, result.threads), result.tiles.size(), row, sink);
}

void write_receivers_csv(const Result& result, const Sink& sink) {
  std::string table = "receiver,name,x,y,z,nx,ny,nz,irradiance,direct,indirect,standard_error,gain,gain_db,unit\n";
  const std::string unit(irradiance_unit(result.quantity));
  for (std::size_t k = 0; k < result.receiver_results.size(); ++k) {
    const Receiver& r = result.receivers[k];
    const ReceiverResult& one = result.receiver_results[k];
    append_row(table, std::to_string(k), csv_field(r.name), to_text(r.position.x), to_text(r.position.y),
               to_text(r.position.z), to_text(r.normal.x), to_text(r.normal.y), to_text(r.normal.z),
               to_text(one.irradiance), to_text(one.direct), to_text(one.indirect), to_text(one.standard_error),
               to_text(one.gain), one.gain > 0.0 ? to_text(10.0 * std::log10(one.gain)) : std::string(), unit);
    flush(table, sink);
  }
  sink(table);
}

std::string surfaces_csv(const Result& result) {
  std::string table =
      "name,material,reflectance,area,tiles,mean_irradiance,min_irradiance,max_irradiance,standard_error,power,behind_"
      "share,hits,unit";
  if (direct_is_apart(result)) table += parts;
  table += ",absorbed,unreached_area\n";
  const std::string unit(irradiance_unit(result.quantity));
  for (const SurfaceResult& s : result.surfaces) {
    append_row(table, csv_field(s.name), csv_field(s.material), to_text(s.reflectance), to_text(s.area_m2),
               std::to_string(s.tiles), to_text(s.mean_irradiance), to_text(s.min_irradiance),
               to_text(s.max_irradiance), to_text(s.standard_error), to_text(s.power), to_text(s.behind_share),
               std::to_string(s.hits), unit_and_parts(unit, s.mean_irradiance, s.mean_direct), to_text(s.absorbed),
               to_text(s.unreached_area_m2));
  }
  return table;
}

std::string paths_csv(const Room& room, const std::vector<PhotonPath>& paths) {
  std::string text = "photon,flight,x,y,z,surface,weight,event\n";
  for (const PhotonPath& path : paths) {
    for (std::size_t k = 0; k < path.points.size(); ++k) {
      const PathPoint& point = path.points[k];
      const std::string_view event = k + 1 == path.points.size() ? to_string(path.end)
                                     : k == 0                    ? "emitted"
                                                                 : "reflected";
      text += std::to_string(path.history) + ',' + std::to_string(k) + ',' + to_text(point.place.x) + ',' +
              to_text(point.place.y) + ',' + to_text(point.place.z) + ',' +
              (point.surface == no_surface ? "" : csv_field(room.surfaces[point.surface].name)) + ',' +
              to_text(point.weight) + ',' + std::string(event) + '\n';
    }
  }
  return text;
}

}  // namespace lichtmc
