#include "run_options.hpp"

#include <cstdint>
#include <cstdio>
#include <iostream>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/overrides.hpp"
#include "lichtmc/receiver_table.hpp"
#include "lichtmc/receivers.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

namespace {

Estimator parse_estimator(const std::string& text) {
  if (text == "weight" || text == "1") return Estimator::weight;
  if (text == "collision" || text == "2") return Estimator::collision;
  if (text == "absorption" || text == "3") return Estimator::absorption;
  if (text == "auto") return Estimator::automatic;
  throw InputError(
      "The estimator '" + text +
      "' is not known (allowed: weight, collision, absorption, or 1, 2, 3; auto). Give one of these to --estimator.");
}

Engine parse_engine(const std::string& text) {
  if (text == "auto") return Engine::automatic;
  if (text == "cuboid") return Engine::cuboid;
  if (text == "embree") return Engine::embree;
  if (text == "embree-fast") return Engine::embree_fast;
  throw InputError("The engine '" + text +
                   "' is not known (allowed: auto, cuboid, embree, embree-fast). Give one of these to --engine.");
}

// "forward" and "backward" are aliases from earlier versions.
Measured parse_measured(const std::string& text) {
  if (text == "tiles" || text == "forward") return Measured::tiles;
  if (text == "receivers" || text == "backward") return Measured::receivers;
  throw InputError("The value '" + text +
                   "' of --only is not known (allowed: tiles, receivers). Give one of these, or leave --only out to "
                   "measure both.");
}

WalkDirection parse_tiles(const std::string& text) {
  if (text == "forward") return WalkDirection::forward;
  if (text == "backward") return WalkDirection::backward;
  throw InputError("The direction '" + text +
                   "' of the walk for tiles is not known (allowed: forward, backward). Give one of these to --tiles.");
}

ReceiverWalk parse_receiver_walk(const std::string& text) {
  if (text == "auto") return ReceiverWalk::automatic;
  if (text == "two-way") return ReceiverWalk::two_way;
  if (text == "next-event") return ReceiverWalk::next_event;
  if (text == "backward") return ReceiverWalk::backward;
  throw InputError("The walk for receivers '" + text +
                   "' is not known (allowed: auto, two-way, next-event, backward). Give one of these to "
                   "--receiver-walk.");
}

Direct parse_direct(const std::string& text, WalkDirection tiles) {
  if (text == "sampled" && tiles == WalkDirection::backward) {
    throw InputError(
        "Backward walks from the tiles do not sample direct light (--direct sampled with --tiles backward; allowed: "
        "analytic). Leave out --direct.");
  }
  if (text == "sampled") return Direct::sampled;
  if (text == "analytic") return Direct::analytic;
  throw InputError("The method '" + text +
                   "' for direct light is not known (allowed: sampled, analytic). Give one of these to --direct.");
}

ReceiverTable read_stdin_table() {
  std::string bytes;
  char block[1 << 16];
  do {
    std::cin.read(block, sizeof block);
    bytes.append(block, static_cast<std::size_t>(std::cin.gcount()));
  } while (std::cin && bytes.size() <= largest_receiver_table);
  if (std::cin.bad() || std::ferror(stdin) != 0)
    throw InputError("Cannot read stdin, the table of --receivers -. Check what is connected to it.");
  if (bytes.size() > largest_receiver_table)
    throw InputError("The table on stdin is longer than the limit of " + std::to_string(largest_receiver_table) +
                     " bytes. Split it.");
  return parse_receiver_table(bytes, "The table on stdin");
}

// Adds the receivers of the command line to those of the room.
void add_receivers(Room& room, const RunOptions& options, std::vector<std::string>& notes) {
  if (options.receivers) {
    ReceiverTable table = *options.receivers == "-" ? read_stdin_table() : read_receiver_table(*options.receivers);
    room.receivers.insert(room.receivers.end(), table.receivers.begin(), table.receivers.end());
    notes.insert(notes.end(), table.notes.begin(), table.notes.end());
  }
  if (options.grid_spacing && !options.grid)
    throw InputError("--grid-spacing is given without --grid. Give --grid the height of the grid, for example 0.85.");
  if (!options.grid) return;
  const double height = parse_number(*options.grid, "--grid");
  const ReceiverGrid grid =
      lay_receiver_grid(room, height, parse_number(options.grid_spacing.value_or("0.5"), "--grid-spacing"));
  notes.push_back(description_of(grid, height));
  room.receivers.insert(room.receivers.end(), grid.receivers.begin(), grid.receivers.end());
}

// "A:B", histories A to B − 1.
void parse_histories(const std::string& text, const StopOptions& stop, Settings& settings) {
  if (stop.photons)
    throw InputError(
        "--photons and --histories both set the number of histories (allowed: one of them). Leave one out.");
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw InputError("The value '" + text +
                     "' of --histories cannot be used (allowed: A:B). Give the first history and the one after the "
                     "last, for example 0:1024000.");
  settings.first_history = parse_count(text.substr(0, colon), "--histories");
  const std::uint64_t end = parse_count(text.substr(colon + 1), "--histories");
  if (end <= settings.first_history)
    throw InputError("The range of histories " + text +
                     " is empty (allowed: A:B with A less than B). Give --histories a larger second number.");
  settings.photons = end - settings.first_history;
  settings.part = true;
}

// With --histories the user determines what is simulated, and all parts require the same estimator. Impulse responses
// get the most of late light from the weights of the photons.
Estimator usual_estimator(const RunOptions& options) {
  if (options.max_bounces || options.channel.impulse_response) return Estimator::weight;
  return options.histories ? Estimator::collision : Estimator::automatic;
}

}  // namespace

Settings parse_settings(const RunOptions& options) {
  Settings settings;
  settings.estimator = options.estimator ? parse_estimator(*options.estimator) : usual_estimator(options);
  if (!options.stop.any() && !options.histories) apply_usual_rules(settings);
  apply_stop_options(options.stop, settings);
  apply_error_floor(options.stop.error_floor, settings);
  if (options.histories) parse_histories(*options.histories, options.stop, settings);
  if (options.max_bounces) {
    constexpr std::uint64_t most = 4'000'000'000;
    const std::uint64_t flights = parse_count(*options.max_bounces, "--max-bounces");
    if (flights > most)
      throw InputError("The maximum number of flights is " + *options.max_bounces +
                       " (allowed: 1 to 4e9). Give --max-bounces a smaller number.");
    settings.max_bounces = static_cast<std::uint32_t>(flights);
  }
  settings.tile_edge_m = parse_number(options.tile, "--tile");
  settings.seed = parse_seed(options.seed, "--seed");
  settings.threads = parse_threads(options.threads);
  settings.engine = parse_engine(options.engine);
  if (options.only) settings.measured = parse_measured(*options.only);
  apply_channel_options(options.channel, settings);
  settings.tile_walk = parse_tiles(options.tiles);
  settings.receiver_walk = parse_receiver_walk(options.receiver_walk);
  if (options.direct) settings.direct = parse_direct(*options.direct, settings.tile_walk);
  if (options.direct_error) settings.direct_error = parse_fraction(*options.direct_error, "--direct-error");
  return settings;
}

namespace {

ScaleType parse_scale_type(const std::string& text) {
  if (text == "auto") return ScaleType::automatic;
  if (text == "linear") return ScaleType::linear;
  if (text == "log") return ScaleType::logarithmic;
  throw InputError("The type of scale '" + text +
                   "' is not known (allowed: auto, linear, log). Give one of these to --scale-type.");
}

ColourMap parse_colour_map(const std::string& text) {
  if (text == "viridis") return ColourMap::viridis;
  if (text == "inferno") return ColourMap::inferno;
  throw InputError("The colour map '" + text +
                   "' is not known (allowed: viridis, inferno). Give one of these to --colormap.");
}

ReportStyle parse_report_style(const std::string& text) {
  if (text == "lighting") return ReportStyle::lighting;
  if (text == "technical") return ReportStyle::technical;
  throw InputError(
      "The report style '" + text +
      "' is not known (allowed: lighting, technical). Give one of these to --report-style, or leave it out: "
      "lighting where the room has calculation areas, else technical.");
}

// The first option given that has no meaning without a report.
const char* option_for_report(const ReportArguments& report_arguments) {
  if (report_arguments.scale_max) return "--scale-max";
  if (report_arguments.pictures) return "--pictures";
  if (report_arguments.paths) return "--paths";
  if (report_arguments.style) return "--report-style";
  if (report_arguments.project) return "--project";
  if (report_arguments.author) return "--author";
  return report_arguments.date ? "--date" : nullptr;
}

}  // namespace

ReportOptions parse_report(const ReportArguments& report_arguments, const std::optional<int>& threads,
                           const std::string& command_line) {
  ReportOptions report;
  report.command = command_line;
  report.scale.type = parse_scale_type(report_arguments.scale_type.value_or("auto"));
  report.scale.colours = parse_colour_map(report_arguments.colour_map.value_or("viridis"));
  if (report_arguments.scale_max) {
    report.scale.high = parse_number(*report_arguments.scale_max, "--scale-max");
    if (!(*report.scale.high >= least_scale_top && *report.scale.high <= greatest_scale_top))
      throw InputError("The upper end of the colour scale is " + *report_arguments.scale_max +
                       " (allowed: a number above 0, from 1e-300 to 1e300, in lx or W/m^2). Give --scale-max such a "
                       "number, or leave it out.");
  }
  if (report_arguments.pictures && *report_arguments.pictures != "exr")
    throw InputError("The picture format '" + *report_arguments.pictures +
                     "' is not known (allowed: exr). Give exr to --pictures, or leave it out for SVG and PNG only.");
  report.exr_pictures = report_arguments.pictures.has_value();
  report.tile_images = wants_images(report_arguments);
  constexpr std::uint64_t most_paths = 10'000;
  if (report_arguments.paths) report.paths = parse_count(*report_arguments.paths, "--paths");
  if (report.paths > most_paths)
    throw InputError("The number of photon paths is " + *report_arguments.paths +
                     " (allowed: 1 to 10000). Give --paths a smaller number.");
  if (report_arguments.style) report.style = parse_report_style(*report_arguments.style);
  report.project = report_arguments.project.value_or("");
  report.author = report_arguments.author.value_or("");
  report.date = report_arguments.date.value_or("");
  const char* option = option_for_report(report_arguments);
  if (!wants_report(report_arguments) && option != nullptr)
    throw InputError(std::string(option) +
                     " requires the report, but --no-report is given (allowed: one of the two). Leave one out.");
  report.threads = parse_threads(threads);
  return report;
}

double parse_checkpoint(const std::string& text) {
  const double seconds = parse_seconds(text, "--checkpoint");
  if (!(seconds > 0.0))
    throw InputError("The interval between checkpoints is " + text +
                     " (allowed: above 0). Give --checkpoint a time, for example 60s.");
  return seconds;
}

Room read_run_room(const RunOptions& options, std::vector<std::string>& notes) {
  Room room = read_room(options.reading);
  check_error_floor(options.stop.error_floor, room);
  if (!options.measure.empty()) measure_only(room, options.measure);
  apply_delays(options.channel, room);
  add_receivers(room, options, notes);
  lay_all_areas(options.areas, room, notes);
  check_room(room);
  return room;
}

void ReportArguments::override_with(const ReportArguments& other) {
  const auto take = [](auto& mine, const auto& theirs) {
    if (theirs) mine = theirs;
  };
  if (!other.report.empty()) report = other.report;
  if (!other.images.empty()) images = other.images;
  take(pictures, other.pictures);
  take(paths, other.paths);
  take(scale_max, other.scale_max);
  take(scale_type, other.scale_type);
  take(colour_map, other.colour_map);
  take(style, other.style);
  take(project, other.project);
  take(author, other.author);
  take(date, other.date);
}

}  // namespace lichtmc::app
