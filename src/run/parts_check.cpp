#include "run/parts_check.hpp"

#include <string>

#include "base/memory.hpp"
#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "walk/emitter_groups.hpp"
#include "walk/part_sums.hpp"

namespace lichtmc {

namespace {

void check_there_are_receivers(const Room& room, const Settings& settings) {
  if (settings.measured == Measured::tiles) {
    throw InputError(
        "The parts of emitters are requested, but only tiles are measured (--per-emitter with --only tiles; allowed: one "
        "of them: parts are those of the light at receivers and calculation areas). Leave out one of them.");
  }
  if (room.receivers.empty()) {
    throw InputError("There is no receiver and no calculation area in " + room.source +
                     " (allowed: at least one for --per-emitter, which keeps the parts of emitters there). Give a "
                     "working plane, for example --plane 0.75, or leave out --per-emitter.");
  }
}

}  // namespace

void check_parts(const Room& room, const Settings& settings) {
  if (settings.per_emitter) {
    check_there_are_receivers(room, settings);
    if (settings.channel.wanted()) {
      throw InputError(
          "The parts of emitters are requested together with impulse responses (Settings::per_emitter; allowed: one of "
          "them). Set ChannelSettings::per_emitter, which keeps emitters apart in impulse responses.");
    }
  }
  if (!wants_parts(room, settings)) return;
  const std::uint32_t parts = groups_of_parts(room, settings).size();
  const auto receivers = static_cast<double>(room.receivers.size());
  const double of_receiver =
      static_cast<double>(parts) * jackknife_groups + static_cast<double>(parts > 1 ? PartSums::pairs(parts) : 0);
  // The sums of the run, those of a step and those of the state or of the results.
  const double needed = 3.0 * receivers * of_receiver * sizeof(uint128);
  const double limit = memory_limit();
  if (needed <= limit) return;
  const auto gigabytes = [](double bytes) { return short_number(bytes / 1e9) + " GB"; };
  throw InputError("The parts of " + to_text(parts, "group") + " of emitters at " +
                   to_text(room.receivers.size(), "receiver") + " need " + gigabytes(needed) +
                   " of memory (allowed: up to " + gigabytes(limit) +
                   ", that of this machine). Give emitters that are dimmed together the same name, give areas a greater "
                   "spacing, or leave out --per-emitter.");
}

}  // namespace lichtmc
