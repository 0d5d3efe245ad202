// lichtmc run: simulates a room and writes the irradiance of every tile.
#include <filesystem>
#include <memory>
#include <string>

#include "commands.hpp"
#include "continue_run.hpp"
#include "light_spec.hpp"
#include "progress_line.hpp"
#include "run_job.hpp"
#include "run_options.hpp"

namespace lichtmc::app {

namespace {

void run(const RunOptions& options, const Invocation& invocation) {
  const Settings settings = parse_settings(options);
  RunJob job;
  job.settings = settings;
  job.report = parse_report(options.report_arguments, options.threads, invocation.command_line);
  job.with_report = wants_report(options.report_arguments);
  job.files.tile_images = wants_images(options.report_arguments);
  job.checkpoint_seconds = parse_checkpoint(options.checkpoint);
  job.note = note_of(invocation.arguments);
  job.quiet = options.quiet;
  job.progress = parse_progress(options.progress, options.quiet);
  job.folder = options.output.empty() ? std::filesystem::path(options.reading.file).stem().concat(".out")
                                      : std::filesystem::path(options.output);
  job.communicator = invocation.communicator;
  {
    StepLine line(is_rank_0(job.communicator) ? job.progress : ProgressForm::none);
    line.update("Reading the room");
    job.room = read_run_room(options, job.notes);
  }
  carry_out_run(job, [&](const Control& control) { return simulate(job.room, settings, control); });
}

}  // namespace

void add_run_command(CLI::App& program, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "run", "Simulate a room: irradiance or illuminance of every tile, with its standard error");
  auto options = std::make_shared<RunOptions>();
  add_run_options(*command, *options);
  command->footer(
      std::string(
          "Photons are followed from the light sources until they are absorbed or leave through an opening. Results: "
          "the\n"
          "irradiance (W/m^2) or illuminance (lx) of every tile of every surface, each with its standard error.\n\n") +
      light_forms + "\n" + area_forms +
      "\nExamples:\n"
      "  lichtmc run room.glb                      to an error of 5 % or for a minute, tiles of 0.1 m, in room.out/\n"
      "  lichtmc run room.glb --target-error 2% --max-time 5min --tile 0.25\n"
      "  lichtmc run office.glb --grid 0.85 --only receivers --target-error 2%     only at desk height\n"
      "  lichtmc run office.glb --plane 0.75:0.5:target_lx=500:target_uniformity=0.6 --only receivers\n"
      "  lichtmc run hall.glb --light point:5,3,5:8000lm --max-reflectance 0.9 -o out/hall\n"
      "Ctrl-C ends a run early and writes the results so far; a second Ctrl-C ends the program at once.");
  command->callback([options, &invocation] { run(*options, invocation); });
}

}  // namespace lichtmc::app
