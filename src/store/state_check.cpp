#include "store/state_check.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "base/message.hpp"
#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "run/settings_check.hpp"
#include "store/hdf5_file.hpp"
#include "store/photons_check.hpp"
#include "walk/tile_faces.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t most_histories = std::uint64_t{1} << 63;  // as check_settings() allows

[[noreturn]] void refuse(const std::string& what) {
  throw Hdf5Error(what);
}

// The same rules as for options. The part of their messages after the value is about options and is left out.
void check_settings_of(const StateData& data) {
  try {
    check_settings(data.settings);
  } catch (const InputError& error) {
    const std::string message = error.what();
    refuse("its settings are not valid. " + message.substr(0, message.find(" (")));
  }
  if (data.settings.measured == Measured::receivers && data.settings.tile_walk == WalkDirection::backward)
    refuse("its settings request backward walks from tiles, and no tiles");
  if (data.engine == Engine::automatic) refuse("the engine that was used is given as 'auto'");
}

// /photons exists if the settings request it, unless the run was stopped while it chose an estimator. Backward walks
// from tiles or receivers may be missing if it was stopped before their first round.
void check_groups(const StateData& data) {
  const Settings& settings = data.settings;
  const bool tiles = settings.measured != Measured::receivers;
  const bool photons = tiles && settings.tile_walk == WalkDirection::forward;
  if (data.photons && !photons) refuse("it has /photons, which its settings do not request");
  if (data.tile_walks && (!tiles || photons)) refuse("it has /tile_walks, which its settings do not request");
  if (data.receivers && settings.measured == Measured::tiles)
    refuse("it has /receivers, which its settings do not request");
  if (settings.estimator == Estimator::automatic) return;
  if (photons && !data.photons) refuse("it has no /photons, which its settings request");
  if (!data.photons && !data.tile_walks && !data.receivers) refuse("it contains no walks");
}

std::string in_words(const HistoryRange& range) {
  return std::to_string(range.first) + ":" + std::to_string(range.last);
}

// Ranges are in order, not adjacent, of whole batches except for the end of the last.
void check_ranges(const Walked& walked, const std::string& group, std::uint64_t batch) {
  if (walked.ranges.empty()) refuse("ranges of " + group + " are missing");
  for (std::size_t k = 0; k < walked.ranges.size(); ++k) {
    const HistoryRange& range = walked.ranges[k];
    if (range.last < range.first || range.last > most_histories)
      refuse("the range " + in_words(range) + " of " + group + " does not end between its beginning and 2^63");
    if (k > 0 && range.first <= walked.ranges[k - 1].last) {
      refuse("the ranges " + in_words(walked.ranges[k - 1]) + " and " + in_words(range) + " of " + group +
             " overlap or touch");
    }
    const bool is_last = k + 1 == walked.ranges.size();
    if (range.first % batch != 0 || (!is_last && range.last % batch != 0))
      refuse("the range " + in_words(range) + " of " + group + " is not one of whole batches of " +
             std::to_string(batch));
  }
}

// The common data of walks in both directions.
void check_walked(const Settings& settings, const Walked& walked, const TraceCount& traced, const std::string& group) {
  const std::string estimator(to_string(walked.estimator));
  if (walked.estimator == Estimator::automatic) refuse("the estimator that " + group + " used is given as 'auto'");
  // max_bounces is the same for all merged parts.
  if (settings.max_bounces && walked.estimator != Estimator::weight)
    refuse(group + " has the estimator '" + estimator + "', and its settings a number of bounces");
  const auto is_time = [](double seconds) { return std::isfinite(seconds) && seconds >= 0.0; };
  if (!is_time(walked.seconds)) refuse(group + " took " + to_text(walked.seconds) + " s");
  for (const ConvergencePoint& point : walked.convergence) {
    if (!is_time(point.seconds) || point.rms_relative_error < 0.0)
      refuse("in convergence of " + group + " is an error of " + to_text(point.rms_relative_error) + " after " +
             to_text(point.seconds) + " s");
  }
  if (traced.retraced > traced.rays || traced.shadow_rays > traced.rays - traced.retraced)
    refuse(group + " has " + std::to_string(traced.rays) + " rays, fewer than of some kinds");
  if (traced.undecided > traced.rays)
    refuse(group + " has " + std::to_string(traced.rays) + " rays, fewer than ended where no rule decides");
}

// The estimator is the requested one, unless that is `automatic`. (Receivers may have another: merged parts have the
// settings of the first part, which may have been stopped before its receivers.)
void check_estimator(const Settings& settings, const Walked& walked, const std::string& group) {
  if (settings.estimator == Estimator::automatic || settings.estimator == walked.estimator) return;
  refuse(group + " has the estimator '" + std::string(to_string(walked.estimator)) + "', its settings have '" +
         std::string(to_string(settings.estimator)) + "'");
}

void check_photons_of(const StateData& data) {
  const Counted& photons = *data.photons;
  const std::string group = "/photons";
  check_walked(data.settings, photons, photons.totals->traced, group);
  check_estimator(data.settings, photons, group);
  check_ranges(photons, group, batch_histories);
  if (photons.ranges.front().first != data.settings.first_history)
    refuse("the range " + in_words(photons.ranges.front()) + " of " + group + " does not begin at first_history, " +
           std::to_string(data.settings.first_history));
  if (photons.pilot > most_histories || (photons.pilot > 0 && data.settings.estimator != Estimator::automatic))
    refuse(group + " has a pilot of " + std::to_string(photons.pilot) +
           " histories, which its settings do not request");
  check_photons(photons, data.settings.max_bounces.has_value());
}

// Rounds of walks from tiles are the same in all runs; those for receivers have been chosen.
void check_tile_plan(const RoundPlan& plan) {
  if (plan != RoundPlan{0, TileFaces::group})
    refuse("/tile_walks has rounds of " + std::to_string(plan.forward) + " histories from the emitters and " +
           std::to_string(plan.backward) + " walks, not of 0 and " + std::to_string(TileFaces::group));
}

void check_receiver_plan(const RoundPlan& plan) {
  if (!is_receiver_plan(plan))
    refuse("/receivers has rounds of " + std::to_string(plan.forward) + " histories from the emitters and " +
           std::to_string(plan.backward) + " walks, which no run has");
}

void check_walks(const Settings& settings, const BackwardState& walks, const std::string& group) {
  check_walked(settings, walks, walks.count.traced, group);
  check_ranges(walks, group, 1);
  const std::uint64_t origins = walks.sums->size();
  const std::uint64_t rounds = walks.size();
  if (origins == 0 || rounds == 0) refuse(group + " has no origin, or no round");
  if (rounds > std::numeric_limits<std::uint64_t>::max() / walks.plan.histories(1) / origins)
    refuse(group + " has " + std::to_string(rounds) + " rounds from " + std::to_string(origins) +
           " origins, too many to count");
  if (walks.count.impacts > walks.count.traced.rays)
    refuse(group + " has " + std::to_string(walks.count.impacts) + " impacts of " +
           std::to_string(walks.count.traced.rays) + " rays");
}

}  // namespace

void check_state(const StateData& data) {
  check_settings_of(data);
  check_groups(data);
  if (data.photons) check_photons_of(data);
  if (data.tile_walks) {
    check_estimator(data.settings, *data.tile_walks, "/tile_walks");
    check_tile_plan(data.tile_walks->plan);
    check_walks(data.settings, *data.tile_walks, "/tile_walks");
  }
  if (data.receivers) {
    check_receiver_plan(data.receivers->plan);
    check_walks(data.settings, *data.receivers, "/receivers");
  }
}

}  // namespace lichtmc
