// Sentences and options about a result.
#include <cmath>
#include <string>

#include "base/message.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/units.hpp"
#include "run/direct_error.hpp"

namespace lichtmc {

namespace {

const WalkReport& walk_for(const Result& result, Measured what) {
  return what == Measured::receivers ? result.receiver_walk : result.walk;
}

std::string two_digits(double value) {
  return rounded(value, 2);
}

}  // namespace

std::string error_text(const Result& result, Measured what) {
  const WalkReport& walk = walk_for(result, what);
  if (!std::isfinite(walk.rms_relative_error)) return "The error is not known: too few histories scored.";
  const std::string word(irradiance_word(result.quantity));
  const std::string unit(written_irradiance_unit(result.quantity));
  const std::string within = two_digits(100.0 * walk.rms_relative_error) + " %";
  if (what == Measured::receivers && !result.areas.empty())
    return "With a probability of two thirds or more, the true mean and minimum of " +
           std::string(result.areas.size() == 1 ? "the area" : "an area") + " each differ from the given one by at most " +
           within + ".";
  if (what == Measured::receivers && result.receiver_results.size() == 1)
    return "The true " + word + " differs from the given one by at most " + within +
           " with a probability of two thirds.";
  std::string text = std::string(what == Measured::receivers ? "At" : "In") + " about two of three " +
                     (what == Measured::receivers ? "receivers" : "places") + " the true " + word +
                     " differs from the given one by at most " + within;
  if (walk.error_floor > 0.0)
    text += ", or by at most " + two_digits(walk.rms_relative_error * walk.error_floor) + " " + unit +
            " where it is below " + two_digits(walk.error_floor) + " " + unit;
  return text + ".";
}

std::string options_to_repeat(const Result& result, Measured what) {
  const WalkReport& walk = walk_for(result, what);
  const bool ended_early = walk.stopped_by == StopReason::max_time || walk.stopped_by == StopReason::interrupt;
  if (!ended_early || walk.histories == 0) return {};
  const bool receivers = what == Measured::receivers;
  const Settings& settings = result.settings;
  std::string options;
  if (!result.tiles.empty() && !result.receiver_results.empty())
    options += receivers ? "--only receivers " : "--only tiles ";
  options += "--histories " + std::to_string(settings.first_history) + ":" +
             std::to_string(settings.first_history + walk.histories) + " --estimator " +
             // For receivers a new pilot makes the same choice, of the walk too.
             std::string(to_string(receivers ? settings.estimator : walk.estimator));
  const bool integrated = receivers || direct_is_apart(result);
  if (integrated && settings.target_error && !settings.direct_error)
    options +=
        " --direct-error " + to_text(receivers ? direct_error_of_receivers(settings) : direct_error_of_tiles(settings));
  return options;
}

}  // namespace lichtmc
