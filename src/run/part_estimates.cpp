#include "run/part_estimates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/message.hpp"
#include "lichtmc/dimmed_scene.hpp"
#include "lichtmc/error.hpp"
#include "run/area_figures.hpp"
#include "run/collectives.hpp"
#include "run/jackknife.hpp"
#include "walk/part_sums.hpp"

namespace lichtmc {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<EmitterParts::Part> describe_parts(const Room& room, const EmitterGroups& groups) {
  std::vector<EmitterParts::Part> parts(groups.size());
  for (std::size_t p = 0; p < parts.size(); ++p) parts[p].name = groups.names[p];
  std::vector<bool> named(parts.size(), false);
  for (std::size_t n = 0; n < room.emitters.size(); ++n) {
    const std::uint32_t p = groups.of_emitter[n];
    const double factor = room.emitters[n].maintenance_factor;
    // With impulse responses all emitters are one part: then initial values may not be known.
    const bool same = !named[p] || parts[p].maintenance_factor == factor;
    parts[p].maintenance_factor = same ? factor : unknown;
    parts[p].power += room.emitters[n].power;
    named[p] = true;
  }
  return parts;
}

// Of the means over rounds of two parts, in squares of the unit of scores. products: sum over rounds of their product.
double covariance_of_means(uint128 products, uint128 sum_a, uint128 sum_b, std::uint64_t rounds) {
  if (rounds < 2) return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<long double>(rounds);
  const long double between =
      static_cast<long double>(products) - static_cast<long double>(sum_a) / n * static_cast<long double>(sum_b);
  return static_cast<double>(between / (n - 1) / n);
}

// Sums of one receiver.
class ReceiverSums {
 public:
  ReceiverSums(const OriginEstimates& found, std::size_t receiver, std::size_t parts)
      : found_(&found), receiver_(receiver), parts_(parts) {}

  uint128 of_group(std::size_t part, std::size_t group) const {
    return found_->parts->of_groups[(receiver_ * parts_ + part) * jackknife_groups + group];
  }
  uint128 sum(std::size_t part) const {
    uint128 all = 0;
    for (std::size_t j = 0; j < jackknife_groups; ++j) all += of_group(part, j);
    return all;
  }
  uint128 product(std::size_t i, std::size_t j) const {
    if (parts_ == 1) return (*found_->sums)[receiver_].squares;
    return found_->parts->products[receiver_ * PartSums::pairs(parts_) + PartSums::pair(i, j)];
  }

 private:
  const OriginEstimates* found_;
  std::size_t receiver_;
  std::size_t parts_;
};

}  // namespace

LightOfParts::LightOfParts(const Room& room, const Settings& settings) {
  if (!wants_parts(room, settings)) return;
  groups_ = groups_of_parts(room, settings);
  direct_.resize(room.receivers.size() * groups_->size());
}

DirectIrradiance LightOfParts::keep(std::size_t receiver, const std::vector<DirectIrradiance>& of_emitters) {
  DirectIrradiance* parts = direct_.data() + receiver * size();
  for (std::size_t n = 0; n < of_emitters.size(); ++n) parts[groups_->of_emitter[n]].add(of_emitters[n]);
  DirectIrradiance all;
  for (std::uint32_t p = 0; p < size(); ++p) all.add(parts[p]);
  return all;
}

const std::vector<DirectIrradiance>& LightOfParts::all_direct(Communicator* communicator) {
  if (!complete_) combine(communicator, direct_);
  complete_ = true;
  return direct_;
}

EmitterParts estimate_parts(const Room& room, const EmitterGroups& groups, const OriginEstimates& found,
                            const std::vector<DirectIrradiance>& direct) {
  EmitterParts estimates;
  estimates.parts = describe_parts(room, groups);
  estimates.receivers = found.sums->size();
  estimates.rounds = found.rounds;
  estimates.group_rounds = rounds_by_turns(found.ranges, jackknife_groups);
  const std::size_t parts = estimates.parts.size();
  for (const DirectIrradiance& one : direct) {
    estimates.direct.push_back(one.value);
    estimates.direct_error.push_back(one.standard_error);
  }
  const auto mean = [&](uint128 sum, std::uint64_t rounds) {
    return rounds > 0 ? static_cast<double>(sum) / static_cast<double>(rounds) * found.unit : 0.0;
  };
  for (std::size_t k = 0; k < estimates.receivers; ++k) {
    const ReceiverSums sums(found, k, parts);
    for (std::size_t i = 0; i < parts; ++i) {
      estimates.reflected.push_back(mean(sums.sum(i), found.rounds));
      for (std::size_t j = 0; j < jackknife_groups; ++j)
        estimates.of_groups.push_back(mean(sums.of_group(i, j), estimates.group_rounds[j]));
      for (std::size_t j = 0; j <= i; ++j) {
        const double covariance = covariance_of_means(sums.product(i, j), sums.sum(i), sums.sum(j), found.rounds);
        estimates.covariance.push_back(covariance * found.unit * found.unit);
      }
    }
  }
  return estimates;
}

std::vector<ReceiverResult> receivers_by_parts(const EmitterParts& parts, const std::vector<Receiver>& receivers,
                                               const std::vector<double>& factors) {
  double power = 0.0;
  for (std::size_t p = 0; p < factors.size(); ++p) power += factors[p] * parts.parts[p].power;
  const double student = student_factor(static_cast<double>(parts.rounds) - 1.0);
  std::vector<ReceiverResult> results(receivers.size());
  for (std::size_t k = 0; k < results.size(); ++k) {
    ReceiverResult& one = results[k];
    double direct_variance = 0.0;
    double variance = 0.0;
    const double* covariance = parts.covariance.data() + k * parts.pairs();
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const std::size_t at = parts.at(k, i);
      one.direct += factors[i] * parts.direct[at];
      one.indirect += factors[i] * parts.reflected[at];
      direct_variance += std::pow(factors[i] * parts.direct_error[at], 2);
      for (std::size_t j = 0; j <= i; ++j)
        variance += (i == j ? 1.0 : 2.0) * factors[i] * factors[j] * covariance[PartSums::pair(i, j)];
    }
    one.irradiance = one.direct + one.indirect;
    // Rounding may leave a variance of 0 slightly negative.
    one.standard_error = std::hypot(student * std::sqrt(std::max(variance, 0.0)), std::sqrt(direct_variance));
    if (std::isnan(variance)) one.standard_error = variance;
    if (power > 0.0) one.gain = one.irradiance * receivers[k].area_m2 * receivers[k].optical_gain() / power;
  }
  return results;
}

std::vector<double> covariances(const EmitterParts& parts) {
  const std::size_t count = parts.parts.size();
  const double student = student_factor(static_cast<double>(parts.rounds) - 1.0);
  std::vector<double> all;
  all.reserve(parts.receivers * count * count);
  for (std::size_t k = 0; k < parts.receivers; ++k) {
    const double* reflected = parts.covariance.data() + k * parts.pairs();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        const double direct = i == j ? std::pow(parts.direct_error[parts.at(k, i)], 2) : 0.0;
        all.push_back(student * student * reflected[PartSums::pair(std::max(i, j), std::min(i, j))] + direct);
      }
    }
  }
  return all;
}

DimmedScene dim(const EmitterParts& parts, const std::vector<Receiver>& receivers, const std::vector<Area>& areas,
                const std::vector<double>& factors) {
  if (factors.size() != parts.parts.size())
    throw InputError("There are " + to_text(factors.size(), "factor") + " for " + to_text(parts.parts.size(), "part") +
                     " of emitters (allowed: one for each). Give each part a factor, 1 if it is not dimmed.");
  for (std::size_t p = 0; p < factors.size(); ++p) {
    if (!(factors[p] >= 0.0) || !std::isfinite(factors[p]))
      throw InputError("The factor of emitter " + in_quotes(parts.parts[p].name) + " is " + to_text(factors[p]) +
                       " (allowed: a finite number, 0 or more; 1 is the power of the run).");
  }
  DimmedScene scene;
  scene.factors = factors;
  for (std::size_t p = 0; p < factors.size(); ++p) scene.power += factors[p] * parts.parts[p].power;
  scene.receivers = receivers_by_parts(parts, receivers, factors);
  scene.areas = area_results(areas, parts, factors);
  return scene;
}

}  // namespace lichtmc
