// lichtmc resume: goes on with a run from its state.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "commands.hpp"
#include "lichtmc/error.hpp"
#include "quantities.hpp"
#include "run_job.hpp"
#include "run_options.hpp"

namespace lichtmc::app {

namespace {

struct ResumeOptions {
  std::string state;
  std::string output;
  std::optional<std::string> room;
  std::optional<std::string> receivers;
  StopOptions stop;
  std::optional<int> threads;
  std::string checkpoint = "60s";
  LookOptions looks;
  bool quiet = false;
};

// The rules that are given; where none is, those of the run, of whose time some is over.
Settings rules_for(const ResumeOptions& options, const State& state) {
  Settings rules = state.settings();
  if (options.stop.any()) {
    rules.target_error.reset();
    rules.max_seconds.reset();
    apply_stop_options(options.stop, rules);
  } else if (rules.max_seconds) {
    constexpr double at_once = 1e-9;
    rules.max_seconds = std::max(*rules.max_seconds - state.seconds(), at_once);
  }
  rules.threads = parse_threads(options.threads);
  return rules;
}

void resume_run(const ResumeOptions& options, const Started& started) {
  const std::filesystem::path file = state_file(options.state);
  State state = read_state(file);
  RunOptions run = options_of(state, file);
  if (options.room) run.reading.file = *options.room;
  if (options.receivers) run.receivers = *options.receivers;
  if (run.receivers == "-" && !options.receivers)
    throw InputError(
        "The receivers of this run came from stdin (allowed here: a file, or - again). Give them with "
        "--receivers.");
  run.looks.override_with(options.looks);

  const Settings rules = rules_for(options, state);
  RunJob job;
  job.settings = rules;
  job.report = parse_report(run.looks, options.threads, started.command_line);
  job.with_report = wants_report(run.looks);
  job.checkpoint_seconds = parse_checkpoint(options.checkpoint);
  job.note = state.note();
  job.quiet = options.quiet;
  job.folder = options.output.empty() ? file.parent_path() : std::filesystem::path(options.output);
  if (job.folder.empty()) job.folder = ".";
  job.team = started.team;
  job.room = read_run_room(run);
  carry_out(job, [&](const Control& control) { return resume(job.room, std::move(state), rules, control); });
}

}  // namespace

void add_resume_command(CLI::App& program, const Started& started) {
  CLI::App* command =
      program.add_subcommand("resume", "Go on with a run that was interrupted, or that is to go further");
  auto options = std::make_shared<ResumeOptions>();
  command->add_option("state", options->state, "state.h5 of a run, or the folder that it is in")
      ->required()
      ->type_name("STATE");
  command->add_option("-o,--output", options->output, "Folder for the results [that of STATE]")->type_name("DIR");
  command->add_option("--room", options->room, "The room's file, where it is not any more where it was")
      ->type_name("ROOM");
  command
      ->add_option("--receivers", options->receivers,
                   "The table of receivers, where it is elsewhere, or came from stdin")
      ->type_name("FILE.csv");
  add_stop_options(*command, options->stop);
  command->get_option("--photons")->description("Go on until there are so many light packets in all: 10M, 2G");
  const std::string machine = "How";
  add_threads_option(*command, options->threads, machine);
  add_checkpoint_option(*command, options->checkpoint, machine);
  add_look_options(*command, options->looks);
  command->add_flag("--quiet", options->quiet, "No progress, no summary; only errors");
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
  command->callback([options, &started] { resume_run(*options, started); });
}

}  // namespace lichtmc::app
