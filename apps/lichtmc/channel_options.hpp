// The options of impulse responses at the receivers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc::app {

struct ChannelOptions {
  std::optional<std::string> impulse_response;  // width of a bin
  std::optional<std::string> time_span, orders, frequencies;
  std::vector<std::string> delays;  // "EMITTER=5ns"
  bool per_emitter = false;
  bool squared_weights = false;
};

void add_channel_options(CLI::App& command, ChannelOptions& options);

// The values of the options. Throws InputError that names the option.
void apply_channel_options(const ChannelOptions& options, Settings& settings);

// The delays of emitters. Throws InputError if no emitter of the room has the name, or without --impulse-response.
void apply_delays(const ChannelOptions& options, Room& room);

}  // namespace lichtmc::app
