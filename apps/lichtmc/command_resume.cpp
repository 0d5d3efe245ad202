// lichtmc resume: continues a run from its state.
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

// The rules that are given; if none is given, those of the run, with the time that remains. A part keeps to its
// histories unless --photons is given: the histories after them may be in another part.
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
  apply_error_floor(options.stop.error_floor, rules);
  rules.threads = parse_threads(options.overrides.threads);
  return rules;
}

// The folder of the results. A copy of a state must not replace the state in the same folder.
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
  const fs::path folder = folder_for(options, file);
  // Before the state is read: it must be the last one that another run in this folder writes.
  std::optional<FolderLock> lock;
  std::error_code unknown;
  if (is_rank_0(invocation.communicator) && fs::exists(file, unknown) && fs::is_directory(folder, unknown))
    lock = prepare_output(folder);
  State state = read_state(file);
  const RunOptions run = options_of(state, file, options.overrides);
  const Settings rules = rules_for(options, state);
  RunJob job = job_of(state, run, options.overrides, invocation.command_line);
  check_error_floor(options.stop.error_floor, job.room);
  job.settings = rules;
  job.checkpoint_seconds = parse_checkpoint(options.checkpoint);
  job.folder = folder;
  job.lock = std::move(lock);
  job.communicator = invocation.communicator;
  carry_out_run(job, [&](const Control& control) { return resume(job.room, std::move(state), rules, control); });
}

}  // namespace

void add_resume_command(CLI::App& program, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("resume", "Continue a run that was interrupted, or extend a finished run");
  auto options = std::make_shared<ResumeOptions>();
  command->add_option("state", options->state, "state.h5 of a run, or its folder")->required()->type_name("STATE");
  const std::string machine = "Execution";
  add_stop_options(*command, options->stop);
  command->get_option("--photons")->description("Continue to this total number of photons: 10M, 2G");
  add_checkpoint_option(*command, options->checkpoint, machine);
  add_override_options(*command, options->overrides, "Folder for the results [that of STATE]", machine);
  command->footer(
      "Photons are counted from the start of the run: --photons 10M continues to a total of 10 million. --max-time "
      "counts\n"
      "the time of this session. Without any of these rules the run continues to its own rules. The results are "
      "identical\n"
      "to those of a run without interruption.\n\n"
      "Examples:\n"
      "  lichtmc resume room.out                         after a power failure\n"
      "  lichtmc resume room.out --target-error 1%       to a smaller error\n"
      "  lichtmc resume room.out --max-time 8h -o night");
  command->callback([options, &invocation] { resume_run(*options, invocation); });
}

}  // namespace lichtmc::app
