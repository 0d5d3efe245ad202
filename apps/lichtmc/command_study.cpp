// lichtmc study: computing time against error in a room.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <unistd.h>

#include "commands.hpp"
#include "console.hpp"
#include "interrupt.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/inspect.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/study.hpp"
#include "lichtmc/visible_text.hpp"
#include "progress_line.hpp"
#include "quantities.hpp"
#include "room_options.hpp"
#include "run_options.hpp"
#include "stop_options.hpp"

namespace lichtmc::app {

namespace {

struct StudyCommand {
  RoomOptions reading;
  std::string output;
  std::optional<std::string> max_time, tile, error_floor;
  std::string seed = "1";
  std::optional<int> threads;
  std::optional<std::string> progress;
  bool quick = false;
  bool quiet = false;
};

StudyOptions parse_options(const StudyCommand& command) {
  constexpr double quick_seconds = 45.0;  // less than a minute with reading, start and writing
  StudyOptions options;
  if (command.quick && command.max_time)
    throw InputError("Both --quick and --max-time are given (allowed: one of them). Leave one out.");
  if (command.quick) options.seconds = quick_seconds;
  if (command.max_time) options.seconds = parse_seconds(*command.max_time, "--max-time");
  if (command.tile) options.tile_edge_m = parse_number(*command.tile, "--tile");
  options.seed = parse_seed(command.seed, "--seed");
  options.threads = parse_threads(command.threads);
  Settings settings;
  apply_error_floor(command.error_floor, settings);
  options.error_floor_share = settings.error_floor_share;
  options.error_floor = settings.error_floor;
  return options;
}

// On a terminal one line that is overwritten; elsewhere one line for each run.
std::function<void(const StudyProgress&)> progress_printer(bool terminal) {
  return [terminal, last = std::string()](const StudyProgress& progress) mutable {
    std::string line = progress.of > 0 ? std::to_string(progress.done + 1) + " of " + std::to_string(progress.of) + ": "
                                       : std::string();
    line += progress.what;
    if (terminal) {
      bar_stream() << "\r" + line + ", " + std::to_string(std::lround(progress.seconds)) + " s of about " +
                          std::to_string(std::lround(progress.of_seconds)) + " s\x1b[K";
    } else if (line != last) {
      std::cerr << line << '\n' << std::flush;
    }
    last = line;
  };
}

ProgressFacts facts_of(const StudyProgress& progress) {
  ProgressFacts facts;
  facts.stage = "study";
  facts.step = progress.what;
  if (progress.of_seconds > 0.0) {
    facts.fraction = std::min(1.0, progress.seconds / progress.of_seconds);
    facts.seconds_left = std::max(0.0, progress.of_seconds - progress.seconds);
  }
  return facts;
}

void run(const StudyCommand& command) {
  const ProgressForm form = parse_progress(command.progress, command.quiet);
  StudyOptions options = parse_options(command);
  Room room = read_room(command.reading);
  room.area_requests.clear();  // as receivers, areas are not studied
  check_room(room);
  check_error_floor(command.error_floor, room);
  const std::filesystem::path folder = command.output.empty()
                                           ? std::filesystem::path(command.reading.file).stem().concat(".study")
                                           : std::filesystem::path(command.output);
  const FolderLock lock = prepare_output(folder);
  const InterruptWatch interrupt;
  options.stop = interrupt.token();
  for (const std::string& line : warning_lines(room, inspect(room, std::numeric_limits<double>::max())))
    std::cerr << "Warning: " << visible_text(line) << '\n';
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (form == ProgressForm::bar) options.progress = progress_printer(terminal);
  std::optional<ProgressJson> json;
  if (form == ProgressForm::json) {
    json.emplace();
    options.progress = [&json](const StudyProgress& progress) { json->tell(facts_of(progress)); };
  }
  const Study found = study(room, options);
  if (form == ProgressForm::bar && terminal) bar_stream() << "\r\x1b[K";
  write_study(found, folder);
  json.reset();
  if (form == ProgressForm::json) tell_done(std::nullopt, std::nullopt);
  std::cout << advice_text(found);
  if (!command.quiet) {
    std::cerr << "\nResults are in " << visible_text(folder.string())
              << ": advice.txt, study.csv, error_over_time.svg, bias_over_bounces.svg, figures_of_merit.svg.\n";
  }
}

}  // namespace

void add_study_command(CLI::App& program, const Invocation& /*invocation*/) {
  CLI::App* command = program.add_subcommand("study", "Measure time against error in a room, and recommend settings");
  auto options = std::make_shared<StudyCommand>();
  add_room_argument(*command, options->reading);
  command->add_option("-o,--output", options->output, "Folder for the results [name of ROOM with .study]")
      ->type_name("DIR");
  command->add_option("--max-time", options->max_time, "Time for the whole study: 60s, 10min, 2h [10min]")
      ->type_name("T");
  command->add_flag("--quick", options->quick, "Short study of less than one minute");
  command
      ->add_option(
          "--tile", options->tile,
          "Edge of a tile in metres; half and twice this edge are measured too [0.1, more in rooms above 20 m^2]")
      ->type_name("M");
  add_error_floor_option(*command, options->error_floor, "");
  command->add_option("--seed", options->seed, "Seed of the random numbers; the reference uses another seed")
      ->type_name("S")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "Number of threads [one per processor]")->type_name("N");
  add_room_options(*command, options->reading);
  add_message_options(*command, options->progress, options->quiet,
                      "Print only the advice, the warnings of check and errors, no progress");
  command->footer(
      "The study runs every estimator, forward and backward, with direct light sampled and integrated, with "
      "increasing\n"
      "numbers of photons; the weight estimator with histories of 2 to 50 flights; and other tile sizes. All results "
      "are\n"
      "compared with a reference of 30 times as many photons. The advice is for the tiles; receivers are not "
      "studied.\n\n"
      "Examples:\n"
      "  lichtmc study room.glb --quick\n"
      "  lichtmc study hall.glb --tile 0.25 --max-time 30min -o out/hall_study");
  command->callback([options] { run(*options); });
}

}  // namespace lichtmc::app
