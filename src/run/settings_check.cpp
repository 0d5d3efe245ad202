#include "run/settings_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/memory.hpp"
#include "base/message.hpp"
#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/simulate.hpp"
#include "room/reflectance.hpp"
#include "run/parts_check.hpp"
#include "walk/channel_axes.hpp"
#include "walk/channel_memory.hpp"
#include "walk/choose_policy.hpp"

namespace lichtmc {

namespace {

bool positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

// Surfaces without an area receive no light.
bool has_area(const Surface& surface) {
  return surface_area(surface) > 0.0;
}

}  // namespace

const Surface* surface_that_absorbs_nothing(const Room& room) {
  const HighestReflectance highest(room);
  const auto found = std::find_if(room.surfaces.begin(), room.surfaces.end(), [&](const Surface& surface) {
    return highest.of(surface) == 1.0 && has_area(surface);
  });
  return found == room.surfaces.end() ? nullptr : &*found;
}

namespace {

void check_histories(const Settings& settings) {
  if (settings.photons == 0) {
    throw InputError("The number of photons is 0 (allowed: 1 or more). Give --photons a number, for example 1e6.");
  }
  constexpr std::uint64_t most_histories = std::uint64_t{1} << 63;
  if (settings.photons > most_histories || settings.first_history > most_histories - settings.photons) {
    throw InputError("The histories end at " + std::to_string(settings.first_history) + " + " +
                     std::to_string(settings.photons) + " (allowed: up to 2^63). Give smaller numbers.");
  }
}

// A part of a run: whole batches of histories, and an estimator that is the same for all parts.
void check_part(const Settings& settings) {
  if (settings.first_history % batch_histories != 0) {
    const std::uint64_t below = settings.first_history / batch_histories * batch_histories;
    throw InputError("The first history is " + std::to_string(settings.first_history) +
                     " (allowed: multiples of 1024, the number of histories in a batch). Begin at " +
                     std::to_string(below) + " or " + std::to_string(below + batch_histories) + ".");
  }
  if (settings.first_history > 0 && !settings.part) {
    throw InputError("The first history is " + std::to_string(settings.first_history) +
                     " and the run is no part (allowed: 0 for a whole run). Set Settings::part.");
  }
  // For receivers every pilot makes the same choice; for tiles it depends on the number of photons.
  if (settings.part && settings.estimator == Estimator::automatic && settings.measured != Measured::receivers) {
    throw InputError(
        "The estimator is 'auto' for a part of a run (allowed: weight, collision, absorption): all parts require the "
        "same estimator. Give --estimator the one that a short run with 'auto' has chosen.");
  }
}

void check_stop_rules(const Settings& settings) {
  if (settings.target_error && !positive(*settings.target_error)) {
    throw InputError("The target error is " + to_text(*settings.target_error) +
                     " (allowed: a finite number above 0). Give --target-error a number, for example 1% or 0.01.");
  }
  if (settings.max_seconds && !positive(*settings.max_seconds)) {
    throw InputError("The time limit is " + to_text(*settings.max_seconds) +
                     " s (allowed: a finite number above 0). Give --max-time a time, for example 60s.");
  }
}

void check_direct_error(const Settings& settings) {
  if (!settings.direct_error || positive(*settings.direct_error)) return;
  throw InputError("The error of direct light is " + to_text(*settings.direct_error) +
                   " (allowed: a finite number above 0). Give --direct-error a number, for example 0.5% or 0.005.");
}

void check_error_floor(const Settings& settings) {
  const double floor = settings.error_floor.value_or(settings.error_floor_share);
  if (std::isfinite(floor) && floor >= 0.0) return;
  throw InputError(
      "The error floor is " + to_text(floor) +
      " (allowed: a finite number, 0 or above). Give --error-floor a share of the mean, for example 1%, or "
      "an irradiance, for example 1lx.");
}

void check_max_bounces(const Settings& settings) {
  if (settings.max_bounces && *settings.max_bounces == 0) {
    throw InputError("The number of bounces is 0 (allowed: 1 or more). Give --max-bounces a number, for example 20.");
  }
  if (settings.max_bounces && settings.estimator != Estimator::weight) {
    throw InputError("A number of bounces is given for the estimator '" + std::string(to_string(settings.estimator)) +
                     "' (only 'weight' is cut off). Leave out --max-bounces or use --estimator weight.");
  }
}

void check_tile_edge(const Settings& settings) {
  if (!positive(settings.tile_edge_m)) {
    throw InputError("The tile edge is " + to_text(settings.tile_edge_m) +
                     " m (allowed: a finite number above 0). Give --tile a length in metres, for example 0.1.");
  }
}

// Without a bin width no channel is measured: other settings of channels would do nothing.
void check_no_channel(const ChannelSettings& channel) {
  const char* given = channel.time_span_s                  ? "--time-span"
                      : channel.orders > 0                 ? "--orders"
                      : channel.per_emitter                ? "--per-emitter"
                      : channel.frequencies.step_hz != 0.0 ? "--frequencies"
                      : channel.squared_weights            ? "--squared-weights"
                                                           : nullptr;
  if (given == nullptr) return;
  throw InputError(std::string(given) + " is given without --impulse-response (allowed: both). Give " +
                   "--impulse-response the width of a bin, for example 1ns, or leave out " + given + ".");
}

void check_bins(const ChannelSettings& channel) {
  const double width = *channel.bin_width_s;
  if (!positive(width)) {
    throw InputError("The width of a bin of impulse responses is " + to_text(width) +
                     " s (allowed: a finite number above 0). Give --impulse-response a time or a length of path, for "
                     "example 0.2ns or 0.1m.");
  }
  if (!channel.time_span_s) return;
  const double span = *channel.time_span_s;
  if (!positive(span) || span < width) {
    throw InputError("The time span of impulse responses is " + to_text(span) +
                     " s (allowed: a finite number, at least the width of a bin, " + to_text(width) +
                     " s). Give --time-span a time or a length of path, for example 400ns.");
  }
  constexpr double most_bins = 1 << 24;
  if (span > most_bins * width) {
    throw InputError("The time span of impulse responses is " + to_text(span) + " s, with bins of " + to_text(width) +
                     " s (allowed: up to 2^24 bins). Give --time-span a shorter time, or --impulse-response a greater "
                     "width.");
  }
}

void check_orders(const ChannelSettings& channel) {
  constexpr std::uint32_t most_orders = 64;
  if (channel.orders <= most_orders) return;
  throw InputError("The number of reflections that are kept apart is " + std::to_string(channel.orders) +
                   " (allowed: 0 to " + std::to_string(most_orders) +
                   "). Give --orders a smaller number; all more reflections are counted together.");
}

void check_frequencies(const FrequencyRange& range) {
  if (range.step_hz == 0.0) return;
  const std::string given =
      to_text(range.first_hz) + " to " + to_text(range.last_hz) + " Hz in steps of " + to_text(range.step_hz) + " Hz";
  const bool finite = std::isfinite(range.first_hz) && std::isfinite(range.last_hz) && positive(range.step_hz);
  if (!finite || range.first_hz < 0.0 || range.last_hz < range.first_hz) {
    throw InputError("The frequencies are " + given +
                     " (allowed: finite numbers, the first 0 or more, the last not below it, a step above 0). Give "
                     "--frequencies such numbers, for example 0:400MHz:1MHz.");
  }
  constexpr double most_frequencies = 100'000;
  if ((range.last_hz - range.first_hz) / range.step_hz > most_frequencies - 1.0) {
    throw InputError("The frequencies are " + given + ", more than " + std::to_string(std::lround(most_frequencies)) +
                     " (the limit). Give --frequencies a greater step.");
  }
}

void check_channel(const ChannelSettings& channel) {
  if (!channel.wanted()) return check_no_channel(channel);
  check_bins(channel);
  check_orders(channel);
  check_frequencies(channel.frequencies);
}

void check_threads(const Settings& settings) {
  constexpr unsigned most_threads = 4096;
  if (settings.threads > most_threads) {
    throw InputError("The number of threads is " + std::to_string(settings.threads) + " (allowed: 1 to " +
                     std::to_string(most_threads) + "). Give --threads a smaller number.");
  }
}

}  // namespace

void check_settings(const Settings& settings) {
  check_part(settings);
  check_histories(settings);
  check_stop_rules(settings);
  check_error_floor(settings);
  check_direct_error(settings);
  check_max_bounces(settings);
  check_tile_edge(settings);
  check_channel(settings.channel);
  check_threads(settings);
}

namespace {

// The largest memory per tile, in bytes, during a forward walk.
double bytes_per_tile(const Settings& settings, unsigned threads, unsigned processes, bool has_reflectance_maps) {
  const bool automatic = settings.estimator == Estimator::automatic;
  const bool hits_apart = automatic || score_law(settings.estimator, has_reflectance_maps).hits == Hits::apart;
  // Tile and its cell; Totals; a thread's Tally (see walk/many_hits.hpp and walk/many_scores.hpp).
  constexpr double of_tiling = sizeof(Tile) + sizeof(std::uint32_t);
  const double of_totals = sizeof(Moments) + (hits_apart ? sizeof(std::uint64_t) : 0);
  const double of_tally = sizeof(Moments) + (hits_apart ? 16 : 8);
  const double candidates = automatic ? 3 : 1;
  const double walking = (candidates + (processes > 1 ? 1 : 0)) * of_totals + threads * of_tally;
  const double ending = 2 * of_totals + of_tally;             // an incomplete last batch is counted separately
  const double writing = 2 * of_totals + sizeof(TileResult);  // the state, and its file in memory
  return of_tiling + std::max({walking, ending, writing});
}

}  // namespace

void check_memory(const Room& room, const Tiling& tiling, const Settings& settings, unsigned threads,
                  unsigned processes, bool has_reflectance_maps) {
  if (settings.tile_walk != WalkDirection::forward || settings.measured == Measured::receivers) return;
  const double tiles = static_cast<double>(tiling.tiles.size());
  const double needed = tiles * bytes_per_tile(settings, threads, processes, has_reflectance_maps);
  const double limit = memory_limit();
  if (needed <= limit) return;
  constexpr double gigabyte = 1e9;
  throw InputError("The tallies of " + std::to_string(tiling.tiles.size()) + " tiles in " + room.source + " for " +
                   to_text(threads, "thread") + " need " + to_text(std::round(10.0 * needed / gigabyte) / 10.0) +
                   " GB of memory (allowed: " + to_text(std::floor(10.0 * limit / gigabyte) / 10.0) +
                   " GB, the available memory). Give --tile a greater length, or fewer --threads.");
}

namespace {

// Bytes that impulse responses need.
double channel_memory(const Room& room, const ChannelAxes& axes, unsigned threads) {
  const auto receivers = static_cast<double>(room.receivers.size());
  // The sums of the run and those of a step; then the results (h and its error of each order and of all) with their
  // files, or the state with its file in memory.
  const double sums = receivers * bytes_of_sums(axes);
  const double rows = receivers * axes.groups * (axes.orders + 3.0);
  const double results = 2.0 * sizeof(double) * rows * axes.bins;
  const double of_threads =
      threads * std::min(receivers, static_cast<double>(receivers_in_block(axes))) * bytes_of_scores(axes);
  return 2.0 * sums + std::max(of_threads, std::max(2.0 * results, sums + results));
}

}  // namespace

MemoryForecast forecast_channel_memory(const Room& room, const Settings& settings, unsigned threads) {
  const MemoryForecast nothing{0.0, memory_available()};
  if (!settings.channel.wanted() || room.receivers.empty()) return nothing;
  try {
    check_settings(settings);
  } catch (const InputError&) {  // simulate() refuses them, with the reason
    return nothing;
  }
  return {channel_memory(room, ChannelAxes(room, settings), threads), memory_available()};
}

namespace {

void check_channel_memory(const Room& room, const Settings& settings) {
  const ChannelAxes axes(room, settings);
  const double needed = channel_memory(room, axes, settings.threads == 0 ? 1 : settings.threads);
  const double limit = memory_limit();
  if (needed <= limit) return;
  const auto gigabytes = [](double bytes) { return short_number(bytes / 1e9) + " GB"; };
  throw InputError(
      "The impulse responses of " + to_text(room.receivers.size(), "receiver") + " from " +
      to_text(axes.groups, "emitter") + (settings.channel.per_emitter ? "" : " (all together)") + ", by " +
      to_text(axes.orders + 2, "order") + " and " + to_text(axes.bins, "bin") + ", need " + gigabytes(needed) +
      " of memory (allowed: up to " + gigabytes(limit) +
      ", that of this machine). Give --impulse-response a greater width or --time-span a shorter time, fewer --orders, "
      "--frequencies or receivers, or leave out --per-emitter or --squared-weights.");
}

void check_receivers_for_channels(const Room& room, const Settings& settings) {
  if (!settings.channel.wanted()) return;
  if (settings.measured == Measured::tiles) {
    throw InputError(
        "Impulse responses are requested, but only tiles are measured (--impulse-response with --only tiles; allowed: "
        "one of them). Leave out --only tiles, or --impulse-response.");
  }
  if (room.receivers.empty()) {
    throw InputError("There is no receiver in " + room.source +
                     " (allowed: at least one for impulse responses). Give nodes of the room the custom property "
                     "'receiver', or give points with --receivers or --grid.");
  }
  const auto cell = std::find_if(room.receivers.begin(), room.receivers.end(),
                                 [](const Receiver& receiver) { return receiver.is_cell(); });
  if (cell != room.receivers.end()) {
    throw InputError("Receiver " + in_quotes(cell->name) + " of " + room.source +
                     " is a cell of a calculation grid (allowed: points for impulse responses). Leave the columns ux, "
                     "uy, uz, vx, vy, vz out of the table of receivers, or --impulse-response.");
  }
  check_channel_memory(room, settings);
}

}  // namespace

void check_settings_for(const Room& room, const Settings& settings) {
  check_receivers_for_channels(room, settings);
  check_parts(room, settings);
  if (settings.measured == Measured::receivers && room.receivers.empty()) {
    throw InputError("There is no receiver in " + room.source +
                     " (allowed: at least one if only receivers are measured). Give nodes of the room the custom "
                     "property 'receiver', or "
                     "give points with --receivers or --grid.");
  }
  if (settings.measured == Measured::receivers && settings.tile_walk == WalkDirection::backward) {
    throw InputError(
        "Backward walks from tiles are requested, but only receivers are measured (--tiles backward with --only "
        "receivers; allowed: one of them). Leave out --only receivers, or --tiles backward.");
  }
  if (settings.estimator == Estimator::absorption) {
    if (const Surface* surface = surface_that_absorbs_nothing(room)) {
      throw InputError("The estimator 'absorption' cannot score on the surface " + in_quotes(surface->name) +
                       " (material " + in_quotes(surface->material) + ") of " + room.source + ": its reflectance is 1" +
                       (surface->reflectance_map           ? " in parts of its texture"
                        : !surface->vertex_colours.empty() ? " in parts of it"
                                                           : "") +
                       ", so that it never absorbs there. Use the estimator 'collision' or 'weight', or a "
                       "reflectance below 1.");
    }
  }
}

}  // namespace lichtmc
