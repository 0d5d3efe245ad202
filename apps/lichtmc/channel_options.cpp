#include "channel_options.hpp"

#include "lichtmc/error.hpp"
#include "lichtmc/overrides.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

void add_channel_options(CLI::App& command, ChannelOptions& options) {
  const std::string group = "Optical channel: impulse responses at the receivers";
  command
      .add_option("--impulse-response", options.impulse_response,
                  "Measure the impulse response of every receiver in bins of this width: a time, as 0.2ns, or a length "
                  "of path, as 0.1m. The options below require it")
      ->type_name("WIDTH")
      ->group(group);
  command
      .add_option("--time-span", options.time_span,
                  "Time that the bins cover, as 400ns or 120m; later light is counted apart [chosen from the room]")
      ->type_name("T")
      ->group(group);
  command
      .add_option("--orders", options.orders,
                  "Keep paths of 0, 1, ... N reflections apart from each other and from the rest, up to 64 [0]")
      ->type_name("N")
      ->group(group);
  command
      .add_flag("--per-emitter", options.per_emitter,
                "Keep the part of each emitter (of those of one name together) at receivers and areas apart, for `lichtmc "
                "scene`; with --impulse-response: a channel from each emitter, instead of one from all together")
      ->group(group);
  command
      .add_option("--frequencies", options.frequencies,
                  "Measure the frequency response from A to B in steps of STEP, path by path: 0:400MHz:1MHz [computed "
                  "from the bins]")
      ->type_name("A:B:STEP")
      ->group(group);
  command
      .add_flag("--squared-weights", options.squared_weights,
                "Add the rms delay spread with the weights h^2, which depends on the width of the bins")
      ->group(group);
  command
      .add_option("--delay", options.delays,
                  "The light of an emitter is late by this time, as lamp=5ns (name or pattern; repeatable) [as given "
                  "in the file]")
      ->type_name("EMITTER=T")
      ->expected(1)
      ->take_all()
      ->group(group);
}

void apply_channel_options(const ChannelOptions& options, Settings& settings) {
  ChannelSettings& channel = settings.channel;
  if (options.impulse_response) channel.bin_width_s = parse_delay(*options.impulse_response, "--impulse-response");
  if (options.time_span) channel.time_span_s = parse_delay(*options.time_span, "--time-span");
  if (options.orders) channel.orders = parse_orders(*options.orders, "--orders");
  channel.per_emitter = options.per_emitter && channel.wanted();
  settings.per_emitter = options.per_emitter && !channel.wanted();
  if (options.frequencies) channel.frequencies = parse_frequencies(*options.frequencies, "--frequencies");
  channel.squared_weights = options.squared_weights;
}

void apply_delays(const ChannelOptions& options, Room& room) {
  if (options.delays.empty()) return;
  if (!options.impulse_response)
    throw InputError(
        "--delay is given without --impulse-response (allowed: both; a delay changes only impulse responses). Give "
        "--impulse-response the width of a bin, for example 1ns, or leave out --delay.");
  for (const std::string& text : options.delays) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos)
      throw InputError("The value '" + text +
                       "' of --delay cannot be used (allowed: EMITTER=T, with the name of an emitter and a time). Give "
                       "it in that form, for example lamp=5ns.");
    set_delay(room, text.substr(0, equals), parse_short_time(text.substr(equals + 1), "--delay " + text));
  }
}

}  // namespace lichtmc::app
