#include "walk/totals.hpp"

namespace lichtmc {

Totals::Totals(std::size_t tile_count, std::size_t map_count, Hits hits_are, Absorption absorption)
    : tiles(tile_count),
      hits(hits_are == Hits::apart ? tile_count : 0),
      tile_maps(map_count),
      behind(map_count),
      absorbed_by(absorption == Absorption::counted ? map_count : 0) {}

}  // namespace lichtmc
