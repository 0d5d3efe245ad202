// The options of `lichtmc run` as the command line knows them: names, help, groups. Their values: run_options.cpp.
#include "run_options.hpp"

namespace lichtmc::app {

void add_threads_option(CLI::App& command, std::optional<int>& threads, const std::string& group) {
  command.add_option("--threads", threads, "Number of threads [one per processor]")->type_name("N")->group(group);
}

void add_checkpoint_option(CLI::App& command, std::string& checkpoint, const std::string& group) {
  command
      .add_option(
          "--checkpoint", checkpoint,
          "Interval between checkpoints (state.h5), from which `lichtmc resume` continues after a power failure")
      ->type_name("T")
      ->capture_default_str()
      ->group(group);
}

void add_message_options(CLI::App& command, std::optional<std::string>& progress, bool& quiet,
                         const std::string& quiet_help) {
  command
      .add_option("--progress", progress,
                  "Progress on stderr: bar (a line every few seconds where stderr is no terminal), json (for programs: "
                  "one object per line), or none [bar; none with --quiet]")
      ->type_name("FORM");
  command.add_flag("--quiet", quiet, quiet_help);
}

void add_report_options(CLI::App& command, ReportArguments& options) {
  const std::string group = "Report (report.html, room_lit.glb and pictures/)";
  command.add_flag("--images,!--no-images", options.images, "Write the tile maps as images, tiles/*.exr [yes]")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  command.add_flag("--report,!--no-report", options.report, "Write the report [yes]")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
      ->group(group);
  command
      .add_option("--scale-max", options.scale_max,
                  "Upper end of the colour scale, in lx or W/m^2 [chosen from the tiles]")
      ->type_name("E")
      ->group(group);
  command
      .add_option("--scale-type", options.scale_type,
                  "linear, log (three decades), or auto: log if a small area is far above the median")
      ->type_name("TYPE")
      ->default_str("auto")
      ->group(group);
  command.add_option("--colormap", options.colour_map, "viridis or inferno")
      ->type_name("NAME")
      ->default_str("viridis")
      ->group(group);
  command.add_option("--paths", options.paths, "Show the paths of the first N photons, up to 10000 [none]")
      ->type_name("N")
      ->group(group);
  command
      .add_option("--report-style", options.style,
                  "lighting: pages for a client, the technical report behind them; or technical alone [lighting where "
                  "the room has calculation areas]")
      ->type_name("STYLE")
      ->group(group);
  command.add_option("--project", options.project, "Name of the project, for the first page of a lighting report")
      ->type_name("TEXT")
      ->group(group);
  command.add_option("--author", options.author, "Who answers for it, for the first page")
      ->type_name("TEXT")
      ->group(group);
  command.add_option("--date", options.date, "Date for the first page, in any form [none]")
      ->type_name("TEXT")
      ->group(group);
  command.add_option("--pictures", options.pictures, "exr: also write the pictures as OpenEXR")
      ->type_name("FORM")
      ->group(group);
}

namespace {

void add_tile_options(CLI::App& command, RunOptions& options, const std::string& group) {
  command.add_option("--tile", options.tile, "Edge of a tile in metres")
      ->type_name("M")
      ->capture_default_str()
      ->group(group);
  command
      .add_option(
          "--measure", options.measure,
          "Measure only surfaces, or surfaces of materials, of this name or pattern (repeatable); the others only "
          "reflect [all]")
      ->type_name("NAME")
      ->expected(1)
      ->take_all()
      ->group(group);
}

void add_estimator_options(CLI::App& command, RunOptions& options, const std::string& group) {
  command
      .add_option(
          "--estimator", options.estimator,
          "weight, collision or absorption (or 1, 2, 3): same mean, different variance. auto: the most efficient "
          "of them, determined by a short pilot of each [auto; weight with --max-bounces or --impulse-response, "
          "collision with --histories]")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--direct", options.direct,
                  "Direct light: sampled by the photons, or analytic, integrated over each tile")
      ->type_name("METHOD")
      ->default_str("sampled")
      ->group(group);
  command
      .add_option("--direct-error", options.direct_error,
                  "Relative error of integrated direct light: 1% or 0.01 [a part of the target error]")
      ->type_name("P")
      ->group(group);
  command
      .add_option("--tiles", options.tiles,
                  "forward: photons from the emitters are scored on the tiles; backward: walks from random points of "
                  "each tile to the emitters")
      ->type_name("DIRECTION")
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--max-bounces", options.max_bounces,
                  "With --estimator weight: end histories after N flights; the first flight, from the emitter, counts "
                  "[Russian roulette, unbiased]")
      ->type_name("N")
      ->group(group);
}

void add_execution_options(CLI::App& command, RunOptions& options, const std::string& group) {
  command.add_option("--seed", options.seed, "Seed of the random numbers: the same seed gives identical results")
      ->type_name("S")
      ->capture_default_str()
      ->group(group);
  add_threads_option(command, options.threads, group);
  command
      .add_option("--engine", options.engine,
                  "Tracer of the flights: auto, cuboid (closed form, only for empty cuboids), embree, or embree-fast "
                  "(may lose one photon in many millions at edges)")
      ->type_name("NAME")
      ->capture_default_str()
      ->group(group);
}

void add_part_options(CLI::App& command, RunOptions& options) {
  const std::string group = "Long runs, and runs in parts";
  add_checkpoint_option(command, options.checkpoint, group);
  command
      .add_option("--histories", options.histories,
                  "Simulate a part of a run, histories A to B - 1, for `lichtmc merge`; A is a multiple of 1024")
      ->type_name("A:B")
      ->group(group);
}

void add_receiver_options(CLI::App& command, RunOptions& options) {
  const std::string group = "Receivers, in addition to the tiles";
  command
      .add_option("--receivers", options.receivers,
                  "Table of receivers: columns x,y,z,nx,ny,nz and name by their heading, or in this order without one, "
                  "with a heading also area, fov, concentrator_index, filter_gain; metres; - for stdin")
      ->type_name("FILE.csv")
      ->group(group);
  command
      .add_option("--grid", options.grid, "Grid of upward-facing receivers at this height above the floor in metres")
      ->type_name("H")
      ->group(group);
  command.add_option("--grid-spacing", options.grid_spacing, "Spacing of the grid in metres [0.5]")
      ->type_name("M")
      ->group(group);
  command
      .add_option(
          "--receiver-walk", options.receiver_walk,
          "next-event: every impact of photons from the emitters contributes to every receiver; backward: walks "
          "from each receiver to the emitters; two-way: both combined; auto: the one with the smallest error "
          "for the same work")
      ->type_name("NAME")
      ->capture_default_str()
      ->group(group);
  command.add_option("--only", options.only, "Measure only these: tiles or receivers")->type_name("WHAT")->group(group);
}

}  // namespace

void add_run_options(CLI::App& command, RunOptions& options) {
  add_room_argument(command, options.reading);
  command.add_option("-o,--output", options.output, "Folder for the results [name of ROOM with .out]")
      ->type_name("DIR");
  add_stop_options(command, options.stop);
  const std::string method = "Method";
  add_tile_options(command, options, method);
  add_estimator_options(command, options, method);
  add_execution_options(command, options, method);
  add_part_options(command, options);
  add_receiver_options(command, options);
  add_area_options(command, options.areas);
  add_channel_options(command, options.channel);
  add_report_options(command, options.report_arguments);
  add_room_options(command, options.reading);
  add_message_options(command, options.progress, options.quiet,
                      "Print only warnings of check and errors, no progress and no summary");
}

}  // namespace lichtmc::app
