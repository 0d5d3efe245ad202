// lichtmc resume: goes on with a run from its state.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "commands.hpp"
#include "continue_run.hpp"
#include "lichtmc/error.hpp"
#include "quantities.hpp"
#include "run_job.hpp"
#include "run_options.hpp"

namespace lichtmc::app {

namespace {

namespace fs = std::filesystem;

struct ResumeOptions {
  std::string state;
  OverrideOptions overrides;
  StopOptions stop;
  std::string checkpoint = "60s";
};

// The rules that are given; where none is, those of the run, of whose time some is over. A part stays within its
// histories unless it is told otherwise: what is behind them another part may have.
Settings rules_for(const ResumeOptions& options, const State& state) {
  Settings rules = state.settings();
  if (options.stop.any()) {
    rules.target_error.reset();
    rules.max_seconds.reset();
    apply_stop_options(options.stop, rules);
    if (rules.part && !options.stop.photons) rules.photons = state.settings().photons;
  } else if (rules.max_seconds) {
    constexpr double at_once = 1e-9;
    rules.max_seconds = std::max(*rules.max_seconds - state.seconds(), at_once);
  }
  rules.threads = parse_threads(options.overrides.threads);
  return rules;
}

// Where the results go. A copy of a state must not replace the state that it lies beside.
fs::path folder_for(const ResumeOptions& options, const fs::path& file) {
  if (!options.overrides.output.empty()) return options.overrides.output;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code unknown;
  if (fs::exists(folder / "state.h5", unknown) && !fs::equivalent(folder / "state.h5", file, unknown))
    throw InputError("The results of " + file.string() + " would replace those in " + folder.string() +
                     ", whose state.h5 is another file (allowed: the folder's own state, or another folder). Choose a "
                     "folder with --output.");
  return folder;
}

void resume_run(const ResumeOptions& options, const Invocation& invocation) {
  const fs::path file = state_file(options.state);
  State state = read_state(file);
  const RunOptions run = options_of(state, file, options.overrides);
  const Settings rules = rules_for(options, state);
  const fs::path folder = folder_for(options, file);
  RunJob job = job_of(state, run, options.overrides, invocation.command_line);
  job.settings = rules;
  job.checkpoint_seconds = parse_checkpoint(options.checkpoint);
  job.folder = folder;
  job.communicator = invocation.communicator;
  carry_out_run(job, [&](const Control& control) { return resume(job.room, std::move(state), rules, control); });
}

}  // namespace

void add_resume_command(CLI::App& program, const Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("resume", "Go on with a run that was interrupted, or that is to go further");
  auto options = std::make_shared<ResumeOptions>();
  command->add_option("state", options->state, "state.h5 of a run, or the folder that it is in")
      ->required()
      ->type_name("STATE");
  const std::string machine = "How";
  add_stop_options(*command, options->stop);
  command->get_option("--photons")->description("Go on until there are so many light packets in all: 10M, 2G");
  add_checkpoint_option(*command, options->checkpoint, machine);
  add_override_options(*command, options->overrides, "Folder for the results [that of STATE]", machine);
  command->footer(
      "Photons are counted from the start of the run: --photons 10M goes on until there are 10 million in all. Time "
      "is\n"
      "that of this session. Without any of these rules the run goes on to its own. The results are, to the last "
      "digit,\n"
      "those of a run without interruption.\n\n"
      "Examples:\n"
      "  lichtmc resume room.out                         after a power cut\n"
      "  lichtmc resume room.out --target-error 1%       further than before\n"
      "  lichtmc resume room.out --max-time 8h -o night");
  command->callback([options, &invocation] { resume_run(*options, invocation); });
}

}  // namespace lichtmc::app
