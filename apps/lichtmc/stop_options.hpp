// The options that determine when a run stops.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc::app {

struct StopOptions {
  std::optional<std::string> photons, target_error, max_time;
  std::optional<std::string> error_floor;  // no rule, but what the target error refers to

  bool any() const { return photons || target_error || max_time; }
};

void add_stop_options(CLI::App& command, StopOptions& options);
void add_error_floor_option(CLI::App& command, std::optional<std::string>& error_floor, const std::string& group);

// The values of the options. Throw InputError that names the option.
// Sets the rules that are given; with --target-error or --max-time alone the number of photons has no limit.
void apply_stop_options(const StopOptions& options, Settings& settings);
// The rules of a run for which none is given: an error of 5 %, a minute.
void apply_usual_rules(Settings& settings);
void apply_error_floor(const std::optional<std::string>& error_floor, Settings& settings);
// Throws InputError if the error floor has a unit that is not that of the room.
void check_error_floor(const std::optional<std::string>& error_floor, const Room& room);

}  // namespace lichtmc::app
