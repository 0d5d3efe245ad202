// Impulse responses and the figures derived from them, from the sums of a run.
#pragma once

#include <vector>

#include "lichtmc/channel.hpp"
#include "lichtmc/result.hpp"
#include "run/context.hpp"
#include "walk/channel_axes.hpp"
#include "walk/channel_scores.hpp"
#include "walk/channel_sums.hpp"
#include "walk/direct_light.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

struct ChannelInput {
  const RunContext& context;
  const ChannelAxes& axes;
  const ChannelScale& scale;
  const DirectLight& light;
  const std::vector<ReferencePoint>& receivers;
  const ChannelSums& sums;
  const std::vector<HistoryRange>& rounds;        // that the sums contain
  const std::vector<ReceiverResult>& irradiance;  // of each receiver: the sum of its channels
  const std::vector<DirectIrradiance>& direct;    // of each receiver
};

ImpulseResponses channel_results(const ChannelInput& input);

}  // namespace lichtmc
