#include "stop_options.hpp"

#include "lichtmc/error.hpp"
#include "lichtmc/units.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

void apply_usual_rules(Settings& settings) {
  settings.photons = no_photon_limit;
  settings.target_error = 0.05;
  settings.max_seconds = 60.0;
}

void apply_stop_options(const StopOptions& options, Settings& settings) {
  // With another stop rule the number of photons has no limit by default.
  if (options.target_error || options.max_time) settings.photons = no_photon_limit;
  if (options.photons) settings.photons = parse_count(*options.photons, "--photons");
  if (options.target_error) settings.target_error = parse_fraction(*options.target_error, "--target-error");
  if (options.max_time) settings.max_seconds = parse_seconds(*options.max_time, "--max-time");
}

void apply_error_floor(const std::optional<std::string>& error_floor, Settings& settings) {
  if (!error_floor) return;
  const ErrorFloor floor = parse_error_floor(*error_floor, "--error-floor");
  settings.error_floor.reset();
  (floor.unit ? settings.error_floor.emplace() : settings.error_floor_share) = floor.value;
}

void check_error_floor(const std::optional<std::string>& error_floor, const Room& room) {
  if (!error_floor) return;
  const ErrorFloor floor = parse_error_floor(*error_floor, "--error-floor");
  if (!floor.unit || *floor.unit == room.quantity) return;
  throw InputError("The error floor is " + *error_floor + ", the " + std::string(irradiance_word(room.quantity)) +
                   "s of " + room.source + " are in " + std::string(irradiance_unit(room.quantity)) +
                   " (allowed: the unit of the room, or a share of the " + "mean). Give --error-floor a number of " +
                   std::string(irradiance_unit(room.quantity)) + ", or for example 1%.");
}

void add_error_floor_option(CLI::App& command, std::optional<std::string>& error_floor, const std::string& group) {
  command
      .add_option(
          "--error-floor", error_floor,
          "Errors are relative to at least this irradiance: a share of the mean, as 1%, or 1lx, 0.1W/m^2; 0: to "
          "the irradiance of each place, however dark [1%]")
      ->type_name("F")
      ->group(group);
}

void add_stop_options(CLI::App& command, StopOptions& options) {
  const std::string group = "Stop rules (the first rule that is met ends the run)";
  command.add_option("--photons", options.photons, "Number of photons: 1000000, 1e6, 10M, 2G [no limit]")
      ->type_name("N")
      ->group(group);
  command
      .add_option("--target-error", options.target_error,
                  "Stop at this relative standard error (tiles: area-weighted rms; receivers: rms): 1% or 0.01 [5%, if "
                  "no other rule is given]")
      ->type_name("P")
      ->group(group);
  command
      .add_option("--max-time", options.max_time,
                  "Stop after this time: 60s, 5min, 2h [60s, if no other rule is given]")
      ->type_name("T")
      ->group(group);
  add_error_floor_option(command, options.error_floor, group);
}

}  // namespace lichtmc::app
