// lichtmc merge: adds the states of parts of one run.
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "lichtmc/error.hpp"
#include "run_job.hpp"
#include "run_options.hpp"

namespace lichtmc::app {

namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::vector<std::string> states;
  std::string output;
  std::optional<std::string> room;
  std::optional<std::string> receivers;
  std::optional<int> threads;
  LookOptions looks;
  bool quiet = false;
};

// One after the other, so that no more than two are in memory.
State read_and_merge(const std::vector<fs::path>& files) {
  State sum = read_state(files.front());
  std::string names = files.front().string();
  for (std::size_t k = 1; k < files.size(); ++k) {
    sum = merge({std::move(sum), read_state(files[k])}, {names, files[k].string()});
    if (k < 3) names += ", " + files[k].string();
    if (k == 3) names += ", ...";
  }
  return sum;
}

// The sum must not take the place of a part.
void check_output(const fs::path& folder, const std::vector<fs::path>& files) {
  std::error_code unknown;
  for (const fs::path& file : files) {
    if (fs::equivalent(folder / "state.h5", file, unknown))
      throw InputError("The merged state would replace " + file.string() +
                       ", one of its parts (allowed: a folder of its own). Choose another folder with --output.");
  }
}

// A part that was forgotten makes the errors larger, nothing worse; but it should not go unnoticed.
void tell_gaps(const State& state) {
  const std::vector<HistoryRange> ranges = state.histories();
  for (std::size_t k = 1; k < ranges.size(); ++k)
    std::cerr << "The parts leave out histories " << ranges[k - 1].last << " to " << ranges[k].first - 1
              << "; the results are sound without them.\n";
}

void merge_states(const MergeOptions& options, const Started& started) {
  std::vector<fs::path> files;
  for (const std::string& name : options.states) files.push_back(state_file(name));
  State state = read_and_merge(files);
  RunOptions run = options_of(state, files.front());
  if (options.room) run.reading.file = *options.room;
  if (options.receivers) run.receivers = *options.receivers;
  run.looks.override_with(options.looks);

  RunJob job;
  job.settings = state.settings();
  job.report = parse_report(run.looks, options.threads, started.command_line);
  job.with_report = wants_report(run.looks);
  job.note = state.note();
  job.quiet = options.quiet;
  job.folder = options.output.empty() ? fs::path(run.reading.file).stem().concat(".merged") : fs::path(options.output);
  check_output(job.folder, files);
  job.room = read_run_room(run);
  if (!options.quiet) tell_gaps(state);
  carry_out(job, [&](const Control& control) { return result_of(job.room, std::move(state), control); });
}

}  // namespace

void add_merge_command(CLI::App& program, const Started& started) {
  CLI::App* command = program.add_subcommand("merge", "Add up the parts of a run that other machines have simulated");
  auto options = std::make_shared<MergeOptions>();
  command->add_option("states", options->states, "state.h5 of each part, or the folder that it is in")
      ->required()
      ->type_name("STATE");
  command->add_option("-o,--output", options->output, "Folder for the results [name of the room with .merged]")
      ->type_name("DIR");
  command->add_option("--room", options->room, "The room's file, where it is not where the first part had it")
      ->type_name("ROOM");
  command
      ->add_option("--receivers", options->receivers,
                   "The table of receivers, where it is elsewhere, or came from stdin")
      ->type_name("FILE.csv");
  add_threads_option(*command, options->threads, "How");
  add_look_options(*command, options->looks);
  command->add_flag("--quiet", options->quiet, "No progress, no summary; only errors");
  command->footer(
      "Parts are runs of the same room with the same settings and --histories A:B that do not overlap. In any order "
      "and\n"
      "grouping they add up, to the last digit, to one run of all histories. The sum may be merged again, or "
      "resumed.\n\n"
      "Example:\n"
      "  lichtmc run room.glb --histories 0:10240000 -o one            on one machine\n"
      "  lichtmc run room.glb --histories 10240000:20480000 -o two     on another\n"
      "  lichtmc merge one two -o both");
  command->callback([options, &started] { merge_states(*options, started); });
}

}  // namespace lichtmc::app
