#include "run/error_measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lichtmc {

namespace {

// The tiles of a tile map that were never hit.
struct NeverHit {
  double area = 0.0;      // m²
  double power = 0.0;     // W or lm, by the reference
  double variance = 0.0;  // of their power, by what was integrated
};

}  // namespace

double rms_relative_error(const Tiling& tiling, const std::vector<TileResult>& tiles, const ErrorReference& reference) {
  double squares = 0.0;
  double area = 0.0;
  const auto add = [&](double area_m2, double standard_error, double irradiance) {
    const double against = std::max(irradiance, reference.floor);
    // By backward walks a tile may have no score and no known error.
    if (!(against > 0.0) || (irradiance == 0.0 && standard_error == 0.0)) return;
    const double relative = standard_error / against;
    squares += area_m2 * relative * relative;
    area += area_m2;
  };
  std::vector<NeverHit> never_hit(reference.floor > 0.0 ? reference.powers_of_no_hit.size() : 0);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (!reference.counted[i]) continue;
    const Tile& tile = tiling.tiles[i];
    if (tiles[i].hits > 0 || never_hit.empty()) {
      add(tile.area_m2, tiles[i].standard_error, reference.irradiance[i]);
      continue;
    }
    NeverHit& group = never_hit[tile.map];
    const double no_hit = reference.powers_of_no_hit[tile.map];
    group.area += tile.area_m2;
    group.power += reference.irradiance[i] * tile.area_m2;
    group.variance += std::max(0.0, std::pow(tiles[i].standard_error * tile.area_m2, 2) - no_hit * no_hit);
  }
  for (std::size_t m = 0; m < never_hit.size(); ++m) {
    const NeverHit& group = never_hit[m];
    if (!(group.area > 0.0)) continue;
    const double error = std::sqrt(std::pow(reference.powers_of_no_hit[m], 2) + group.variance);
    add(group.area, error / group.area, group.power / group.area);
  }
  return area > 0.0 ? std::sqrt(squares / area) : std::numeric_limits<double>::quiet_NaN();
}

TileErrorMeasure::TileErrorMeasure(const Room& room, const Tiling& tiling, const UnreachedSides& unreached,
                                   const Settings& settings)
    : tiling_(&tiling), settings_(settings) {
  measured_.reserve(tiling.tiles.size());
  counted_.reserve(tiling.tiles.size());
  for (const Tile& tile : tiling.tiles) {
    const TileMap& map = tiling.maps[tile.map];
    measured_.push_back(room.surfaces[map.surface].measured);
    counted_.push_back(measured_.back() && !unreached.holds(map.surface, tile.triangle, map.side));
  }
}

RunError TileErrorMeasure::of(const std::vector<TileResult>& tiles, const std::vector<double>& powers_of_no_hit) const {
  std::vector<double> irradiances(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) irradiances[i] = tiles[i].irradiance;
  RunError error;
  error.floor = floor(irradiances);
  error.without_floor = rms_relative_error(*tiling_, tiles, {measured_, irradiances, 0.0, powers_of_no_hit});
  error.relative = error.floor > 0.0
                       ? rms_relative_error(*tiling_, tiles, {counted_, irradiances, error.floor, powers_of_no_hit})
                       : error.without_floor;
  return error;
}

double TileErrorMeasure::floor(const std::vector<double>& irradiances) const {
  double power = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < irradiances.size(); ++i) {
    if (!counted_[i]) continue;
    power += irradiances[i] * tiling_->tiles[i].area_m2;
    area += tiling_->tiles[i].area_m2;
  }
  return error_floor(settings_, area > 0.0 ? power / area : 0.0);
}

}  // namespace lichtmc
