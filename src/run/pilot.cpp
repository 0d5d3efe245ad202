#include "run/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/message.hpp"
#include "chance/moments.hpp"
#include "run/settings_check.hpp"

namespace lichtmc {

std::vector<Estimator> candidates_for(const Room& room, const Settings& settings) {
  if (settings.estimator != Estimator::automatic) return {settings.estimator};
  // Collision comes first: it is used if the candidates cannot be distinguished.
  std::vector<Estimator> candidates{Estimator::collision, Estimator::weight};
  if (surface_that_absorbs_nothing(room) == nullptr) candidates.push_back(Estimator::absorption);
  return candidates;
}

std::uint64_t pilot_histories(std::uint64_t photons, Estimator estimator) {
  constexpr std::uint64_t fewest = 16;  // batches: sufficient for a variance summed over many tiles
  constexpr std::uint64_t most = 256;
  const std::uint64_t batches = std::clamp(photons / 20 / batch_histories, fewest, most);
  // If tiles are small against the room, absorption has 1/(1 − ρ) times the variance of collision for the same walk: a
  // short pilot is sufficient.
  return (estimator == Estimator::absorption ? std::max(fewest, batches / 4) : batches) * batch_histories;
}

namespace {

std::vector<double> hits_of_all(const std::vector<Pilot>& pilots) {
  std::vector<double> hits(pilots.front().hits.size(), 0.0);
  for (const Pilot& pilot : pilots) {
    for (std::size_t t = 0; t < hits.size(); ++t) hits[t] += pilot.hits[t];
  }
  return hits;
}

}  // namespace

std::vector<double> pooled_values(const std::vector<Pilot>& pilots) {
  std::vector<double> means(pilots.front().values.size(), 0.0);
  for (const Pilot& pilot : pilots) {
    for (std::size_t t = 0; t < means.size(); ++t) means[t] += pilot.values[t] / static_cast<double>(pilots.size());
  }
  return means;
}

std::vector<double> likely_values(const std::vector<Pilot>& pilots, const CountedTiles& tiles) {
  struct OfMap {
    double power = 0.0;
    double area = 0.0;
    double hits = 0.0;
  };
  std::vector<OfMap> maps(tiles.maps);
  std::vector<double> values = pooled_values(pilots);
  std::vector<double> hits = hits_of_all(pilots);
  for (std::size_t t = 0; t < values.size(); ++t) {
    OfMap& map = maps[tiles.map[t]];
    map.power += values[t] * tiles.areas[t];
    map.area += tiles.areas[t];
    map.hits += hits[t];
  }
  for (std::size_t t = 0; t < values.size(); ++t) {
    const OfMap& map = maps[tiles.map[t]];
    const double expected = map.hits * tiles.areas[t] / map.area;
    values[t] = map.power / map.area * (hits[t] + 1.0) / (expected + 1.0);
  }
  return values;
}

void make_errors_likely(std::vector<Pilot>& pilots, const std::vector<double>& likely, const CountedTiles& tiles) {
  constexpr double enough_hits =
      4000.0;  // of all pilots together: because of rare large weights a few hundred are not enough
  const std::vector<double> hits = hits_of_all(pilots);
  std::vector<std::size_t> by_irradiance(likely.size());
  std::iota(by_irradiance.begin(), by_irradiance.end(), std::size_t{0});
  std::stable_sort(by_irradiance.begin(), by_irradiance.end(),
                   [&](std::size_t a, std::size_t b) { return likely[a] < likely[b]; });
  // Groups in ascending order of irradiance; the remaining tiles are added to the last group.
  std::vector<std::size_t> ends;
  double sum = 0.0;
  double left = std::accumulate(hits.begin(), hits.end(), 0.0);
  for (std::size_t k = 0; k < by_irradiance.size(); ++k) {
    sum += hits[by_irradiance[k]];
    if (sum < enough_hits || left - sum < enough_hits) continue;
    ends.push_back(k + 1);
    left -= sum;
    sum = 0.0;
  }
  ends.push_back(by_irradiance.size());
  for (Pilot& pilot : pilots) {
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
      double variance = 0.0;
      double power = 0.0;
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t t = by_irradiance[k];
        if (!(hits[t] > 0.0)) continue;
        variance += std::pow(pilot.errors[t] * tiles.areas[t], 2);
        power += likely[t] * tiles.areas[t];
      }
      for (std::size_t k = begin; k < end && power > 0.0; ++k) {
        const std::size_t t = by_irradiance[k];
        pilot.errors[t] = hits[t] > 0.0 ? std::sqrt(variance / power * likely[t] / tiles.areas[t]) : 0.0;
      }
      begin = end;
    }
  }
}

Choice choose_best(const std::vector<Pilot>& pilots, const std::vector<double>& means, double floor,
                   const std::vector<double>& weights, const std::string& of_what) {
  std::vector<double> costs;
  for (const Pilot& pilot : pilots) {
    double squares = 0.0;
    for (std::size_t t = 0; t < means.size(); ++t) {
      if (means[t] > 0.0) squares += weights[t] * std::pow(pilot.errors[t] / std::max(means[t], floor), 2);
    }
    costs.push_back(squares * pilot.flights);
  }
  Choice choice;
  const bool known =
      std::all_of(costs.begin(), costs.end(), [](double cost) { return cost > 0.0 && std::isfinite(cost); });
  if (!known) {
    choice.reason = "The estimator '" + std::string(to_string(pilots.front().estimator)) + "' was used for " + of_what +
                    ": too few photons scored in a short pilot to compare the estimators.";
    return choice;
  }
  choice.best = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  choice.reason = "The estimator '" + std::string(to_string(pilots[choice.best].estimator)) + "' was chosen for " +
                  of_what + ": for the same error, ";
  for (std::size_t k = 0, listed = 0; k < pilots.size(); ++k) {
    if (k == choice.best) continue;
    choice.reason += std::string(listed++ > 0 ? " and '" : "'") + std::string(to_string(pilots[k].estimator)) +
                     "' needs " + short_number(costs[k] / costs[choice.best]) + " times as many flights";
  }
  choice.reason += " (by a short pilot).";
  return choice;
}

}  // namespace lichtmc
