#include "run/channel_warnings.hpp"

#include <optional>

#include "base/message.hpp"

namespace lichtmc {

namespace {

// The channel of which the largest share arrives after the time span.
std::optional<std::string> light_beyond(const ImpulseResponses& channels) {
  constexpr double noticeable = 0.005;
  double most = noticeable;
  const Channel* worst = nullptr;
  for (const Channel& channel : channels.channels) {
    const double share = channel.beyond.value / channel.gain.value;
    if (!(share > most)) continue;
    most = share;
    worst = &channel;
  }
  if (worst == nullptr) return std::nullopt;
  return percent(most) + " of the light from " + in_quotes(channels.emitters[worst->emitter]) + " to " +
         in_quotes(channels.receivers[worst->receiver]) +
         " arrives later than the time span of the impulse responses. Gains and delays include it, h" +
         (channels.from_bins ? ", the frequency response and its bandwidths do" : " does") +
         " not: give --time-span a longer time" + (channels.from_bins ? ", or measure with --frequencies" : "") + ".";
}

}  // namespace

std::vector<std::string> channel_warnings(const Result& result) {
  std::vector<std::string> warnings;
  if (!result.channels) return warnings;
  if (auto beyond = light_beyond(*result.channels)) warnings.push_back(std::move(*beyond));
  if (result.receiver_walk.estimator != Estimator::weight) {
    warnings.push_back("Impulse responses by the estimator '" + std::string(to_string(result.receiver_walk.estimator)) +
                       "' have few scores in late bins: their errors are large and become reliable late. Use "
                       "--estimator weight.");
  }
  return warnings;
}

}  // namespace lichtmc
