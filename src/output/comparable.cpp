#include "output/comparable.hpp"

#include <algorithm>

#include "chance/moments.hpp"

namespace lichtmc {

double freedom_of_tiles(WalkDirection direction, std::uint64_t histories, std::size_t tiles) {
  if (direction == WalkDirection::forward) return static_cast<double>(batches_of(histories)) - 1.0;
  constexpr double walks_in_a_round = 4.0;
  const double faces = std::max(1.0, 2.0 * static_cast<double>(tiles));  // at most
  return static_cast<double>(histories) / faces / walks_in_a_round - 1.0;
}

double freedom_of_receivers(std::uint64_t rounds) {
  constexpr std::uint64_t few = 6;
  return rounds < few ? static_cast<double>(rounds) - 1.0 : 1e9;
}

ComparableResult comparable(const Result& result, const std::string& name) {
  ComparableResult figures;
  figures.name = name;
  figures.unit = power_unit(result.quantity);
  figures.tile_freedom = freedom_of_tiles(result.settings.tile_walk, result.walk.histories, result.tiles.size());
  for (std::size_t k = 0; k < result.tiles.size(); ++k) {
    const Tile& tile = result.tiling.tiles[k];
    figures.tiles.push_back({result.tiling.maps[tile.map].name, tile.column, tile.row, tile.point,
                             result.tiles[k].irradiance, result.tiles[k].standard_error});
  }
  if (result.receiver_results.empty()) return figures;
  figures.receiver_freedom = freedom_of_receivers(result.receiver_walk.rounds);
  for (std::size_t k = 0; k < result.receiver_results.size(); ++k) {
    const Receiver& receiver = result.receivers[k];
    figures.receivers.push_back({receiver.name, receiver.position, receiver.normal,
                                 result.receiver_results[k].irradiance, result.receiver_results[k].standard_error});
  }
  return figures;
}

}  // namespace lichtmc
