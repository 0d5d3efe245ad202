#include "run/pilot.hpp"

#include <algorithm>
#include <cmath>

#include "base/message.hpp"
#include "chance/moments.hpp"
#include "run/settings_check.hpp"

namespace lichtmc {

std::vector<Estimator> candidates_for(const Room& room, const Settings& settings) {
  if (settings.estimator != Estimator::automatic) return {settings.estimator};
  // Collision comes first: it is taken where nothing speaks for another.
  std::vector<Estimator> candidates{Estimator::collision, Estimator::weight};
  if (surface_that_absorbs_nothing(room) == nullptr) candidates.push_back(Estimator::absorption);
  return candidates;
}

std::uint64_t pilot_histories(std::uint64_t photons) {
  constexpr std::uint64_t fewest = 4;  // batches: a variance summed over many tiles is known from few
  constexpr std::uint64_t most = 256;
  return std::clamp(photons / 64 / batch_histories, fewest, most) * batch_histories;
}

std::vector<double> pooled_values(const std::vector<Pilot>& pilots) {
  std::vector<double> means(pilots.front().values.size(), 0.0);
  for (const Pilot& pilot : pilots) {
    for (std::size_t t = 0; t < means.size(); ++t) means[t] += pilot.values[t] / static_cast<double>(pilots.size());
  }
  return means;
}

Choice choose_best(const std::vector<Pilot>& pilots, const std::vector<double>& means,
                   const std::vector<double>& weights, const std::string& of_what) {
  std::vector<double> costs;
  for (const Pilot& pilot : pilots) {
    double squares = 0.0;
    for (std::size_t t = 0; t < means.size(); ++t) {
      if (means[t] > 0.0) squares += weights[t] * std::pow(pilot.errors[t] / means[t], 2);
    }
    costs.push_back(squares * pilot.flights);
  }
  Choice choice;
  const bool known = std::all_of(costs.begin(), costs.end(), [](double cost) { return cost > 0.0 && std::isfinite(cost); });
  if (!known) {
    choice.reason = "The estimator '" + std::string(to_string(pilots.front().estimator)) + "' was taken for " + of_what +
                    ": too little light was found in a short pilot to tell the estimators apart.";
    return choice;
  }
  choice.best = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  choice.reason = "The estimator '" + std::string(to_string(pilots[choice.best].estimator)) + "' was chosen for " +
                  of_what + ": for the same error, ";
  for (std::size_t k = 0, told = 0; k < pilots.size(); ++k) {
    if (k == choice.best) continue;
    choice.reason += std::string(told++ > 0 ? " and '" : "'") + std::string(to_string(pilots[k].estimator)) +
                     "' needs " + short_number(costs[k] / costs[choice.best]) + " times as many flights";
  }
  choice.reason += " (by a short pilot).";
  return choice;
}

}  // namespace lichtmc
