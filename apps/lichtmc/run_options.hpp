// The options of `lichtmc run`, and those that resume and merge share with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "area_options.hpp"
#include "channel_options.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/settings.hpp"
#include "room_options.hpp"
#include "stop_options.hpp"

namespace lichtmc::app {

// The report of a run. Options that are not given are empty, so that resume and merge keep those of the run.
struct ReportArguments {
  std::string report;  // "true" or "false"
  std::string images;  // the same, for the tile maps as images
  std::optional<std::string> pictures, paths, scale_max, scale_type, colour_map;
  std::optional<std::string> style, project, author, date;

  // Options that are given in `other` replace those given here.
  void override_with(const ReportArguments& other);
};

struct RunOptions {
  RoomOptions reading;
  std::string output;
  StopOptions stop;
  std::optional<std::string> histories;
  std::optional<std::string> estimator;
  std::optional<std::string> max_bounces;
  std::vector<std::string> measure;
  std::string tile = "0.1";
  std::string seed = "1";
  std::optional<int> threads;
  std::string engine = "auto";
  std::optional<std::string> direct, direct_error;
  std::string tiles = "forward";
  std::string receiver_walk = "auto";
  std::optional<std::string> receivers, grid, grid_spacing, only;
  AreaOptions areas;
  ChannelOptions channel;
  ReportArguments report_arguments;
  std::string checkpoint = "60s";
  std::optional<std::string> progress;
  bool quiet = false;
};

void add_run_options(CLI::App& command, RunOptions& options);
void add_report_options(CLI::App& command, ReportArguments& options);
void add_threads_option(CLI::App& command, std::optional<int>& threads, const std::string& group);
// --progress and --quiet.
void add_message_options(CLI::App& command, std::optional<std::string>& progress, bool& quiet,
                         const std::string& quiet_help);
void add_checkpoint_option(CLI::App& command, std::string& checkpoint, const std::string& group);

// The values of the options. Throw InputError that names the option.
Settings parse_settings(const RunOptions& options);
ReportOptions parse_report(const ReportArguments& report_arguments, const std::optional<int>& threads,
                           const std::string& command_line);
inline bool wants_report(const ReportArguments& report_arguments) {
  return report_arguments.report != "false";
}
inline bool wants_images(const ReportArguments& report_arguments) {
  return report_arguments.images != "false";
}
double parse_checkpoint(const std::string& text);

// The room of the file with the receivers and areas of the command line. `notes`: what was not read of their table, and
// where their points lie.
Room read_run_room(const RunOptions& options, std::vector<std::string>& notes);

}  // namespace lichtmc::app
