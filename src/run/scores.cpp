#include "run/scores.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "run/surface_results.hpp"

namespace lichtmc {

Scores::Scores(const Room& room, const Tiling& tiling, const ScoreLaw& law, std::vector<TileDirect> direct)
    : room_(&room), tiling_(&tiling), law_(law), direct_(std::move(direct)), power_(total_power(room)) {
  for (const Surface& surface : room.surfaces) {
    // An absorption represents 1/(1 − ρ) impacts: the mean number of impacts on such surfaces per absorption.
    factor_.push_back(law.per_absorption ? 1.0 / (1.0 - surface.reflectance) : 1.0);
  }
  direct_power_.resize(tiling.maps.size());
  for (std::size_t i = 0; i < direct_.size(); ++i) {
    const Tile& tile = tiling.tiles[i];
    DirectPower& sum = direct_power_[tile.map];
    sum.power += (direct_[i].front + direct_[i].behind) * tile.area_m2;
    sum.behind += direct_[i].behind * tile.area_m2;
    sum.standard_error = std::hypot(sum.standard_error, direct_[i].standard_error * tile.area_m2);
  }
}

// Mean and error of a tile's, or a surface's, incident power.
Estimate Scores::incident_power(const Moments& moments, std::size_t surface, std::uint64_t histories) const {
  // A photon that scores at most once: the error follows the binomial distribution and depends only on the count.
  Estimate result = law_.at_most_one_per_history ? estimate_binomial(static_cast<std::uint64_t>(moments.sum), histories)
                                                 : estimate(moments, histories);
  const double scale = power_ * law_.unit * factor_[surface];
  result.mean *= scale;
  result.standard_error *= scale;
  return result;
}

double Scores::power_of_no_hit(std::size_t surface, std::uint64_t histories) const {
  constexpr double hits = 1.1479;  // −ln(1 − 0.68269)
  const double score = law_.at_absorption ? 1.0 / (1.0 - room_->surfaces[surface].reflectance) : 1.0;
  return hits * power_ * score / static_cast<double>(histories);
}

std::vector<double> Scores::powers_of_no_hit(std::uint64_t histories) const {
  std::vector<double> powers;
  for (const TileMap& map : tiling_->maps) powers.push_back(power_of_no_hit(map.surface, histories));
  return powers;
}

std::vector<TileResult> Scores::tiles(const Totals& totals) const {
  std::vector<TileResult> results(tiling_->tiles.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Tile& tile = tiling_->tiles[i];
    TileResult& result = results[i];
    result.hits = totals.hits.empty() ? static_cast<std::uint64_t>(totals.tiles[i].sum) : totals.hits[i];
    const std::size_t surface = tiling_->maps[tile.map].surface;
    if (result.hits == 0) {
      result.standard_error = power_of_no_hit(surface, totals.histories) / tile.area_m2;
    } else {
      const Estimate power = incident_power(totals.tiles[i], surface, totals.histories);
      result.power = power.mean;
      result.irradiance = power.mean / tile.area_m2;
      result.standard_error = power.standard_error / tile.area_m2;
    }
    if (direct_.empty()) continue;
    result.direct = direct_[i].front + direct_[i].behind;
    result.irradiance += result.direct;
    result.power += result.direct * tile.area_m2;
    result.standard_error = std::hypot(result.standard_error, direct_[i].standard_error);
  }
  return results;
}

std::vector<SurfaceResult> Scores::surfaces(const Totals& totals, const std::vector<TileResult>& tiles) const {
  std::vector<SurfaceResult> results = surface_results(*room_, *tiling_, tiles);
  for (std::size_t m = 0; m < results.size(); ++m) {
    SurfaceResult& result = results[m];
    const std::size_t surface = tiling_->maps[m].surface;
    result.absorbed = 0.0;
    if (!(result.area_m2 > 0.0)) continue;
    double behind = 0.0;
    if (result.hits == 0) {
      result.standard_error = power_of_no_hit(surface, totals.histories) / result.area_m2;
    } else {
      const Estimate power = incident_power(totals.tile_maps[m], surface, totals.histories);
      result.power = power.mean;
      result.standard_error = power.standard_error / result.area_m2;
      behind = power.mean * static_cast<double>(totals.behind[m]) / static_cast<double>(totals.tile_maps[m].sum);
    }
    const DirectPower& direct = direct_power_[m];
    result.power += direct.power;
    behind += direct.behind;
    result.standard_error = std::hypot(result.standard_error, direct.standard_error / result.area_m2);
    result.mean_irradiance = result.power / result.area_m2;
    if (result.power > 0.0) result.behind_share = behind / result.power;
    // With a reflectance map the power that arrives says nothing about the share that is absorbed.
    result.absorbed = totals.absorbed_by.empty() ? result.power * (1.0 - room_->surfaces[surface].reflectance)
                                                 : power_per_unit(totals) * static_cast<double>(totals.absorbed_by[m]);
  }
  return results;
}

double Scores::power_per_unit(const Totals& totals) const {
  return power_ * law_.unit / static_cast<double>(totals.histories);
}

Balance Scores::balance(const Totals& totals) const {
  const double per_unit = power_per_unit(totals);
  Balance balance;
  balance.emitted = power_;
  balance.absorbed = per_unit * static_cast<double>(totals.ends.absorbed);
  balance.escaped = per_unit * static_cast<double>(totals.ends.escaped);
  balance.residual = per_unit * static_cast<double>(totals.ends.residual);
  balance.lost = per_unit * static_cast<double>(totals.ends.lost);
  return balance;
}

Estimate Scores::incident(const Totals& totals) const {
  Estimate sum = counted(totals);
  for (const DirectPower& direct : direct_power_) {
    sum.mean += direct.power;
    sum.standard_error = std::hypot(sum.standard_error, direct.standard_error);
  }
  return sum;
}

// The scores of the photons on all tiles.
Estimate Scores::counted(const Totals& totals) const {
  if (!law_.at_most_one_per_history) {
    const Estimate all = estimate(totals.incident, totals.histories);
    return {power_ * law_.unit * all.mean, power_ * law_.unit * all.standard_error};
  }
  // Each history scores at most once, the factor of the surface that absorbed it: mean and mean square follow from the
  // counts.
  const auto n = static_cast<double>(totals.histories);
  double mean = 0.0;
  double mean_square = 0.0;
  for (std::size_t m = 0; m < totals.tile_maps.size(); ++m) {
    if (totals.tile_maps[m].sum == 0) continue;
    const double factor = factor_[tiling_->maps[m].surface];
    const double share = static_cast<double>(totals.tile_maps[m].sum) / n;
    mean += share * factor;
    mean_square += share * factor * factor;
  }
  const double error = n < 2.0 ? std::numeric_limits<double>::quiet_NaN()
                               : power_ * std::sqrt(std::max(mean_square - mean * mean, 0.0) / (n - 1.0));
  return {power_ * mean, error};
}

}  // namespace lichtmc
