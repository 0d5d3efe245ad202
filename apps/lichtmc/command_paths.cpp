// lichtmc paths: the paths of a few photons as a picture, a table and a glTF file.
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/paths.hpp"
#include "lichtmc/visible_text.hpp"
#include "quantities.hpp"
#include "room_options.hpp"

namespace lichtmc::app {

namespace {

struct PathsCommand {
  RoomOptions reading;
  std::string output;
  std::string photons = "50";
  std::string seed = "1";
  bool quiet = false;
};

void run(const PathsCommand& command) {
  Settings settings;
  settings.seed = parse_seed(command.seed, "--seed");
  const std::uint64_t count = parse_count(command.photons, "--photons");
  constexpr std::uint64_t most = 10'000;
  if (count < 1 || count > most)
    throw InputError("The number of photons is " + command.photons +
                     " (allowed: 1 to 10000). Give --photons such a number.");
  const Room room = read_room(command.reading);
  check_room(room);
  const std::filesystem::path folder = command.output.empty()
                                           ? std::filesystem::path(command.reading.file).stem().concat(".paths")
                                           : std::filesystem::path(command.output);
  const FolderLock lock = prepare_output(folder);
  const std::vector<PhotonPath> paths = trace_paths(room, settings, count);
  write_paths(room, paths, folder);
  if (command.quiet) return;
  std::size_t flights = 0;
  std::size_t escaped = 0;
  for (const PhotonPath& path : paths) {
    flights += path.points.size() - 1;
    escaped += path.end == PathEnd::escaped ? 1 : 0;
  }
  std::cerr << paths.size() << (paths.size() == 1 ? " photon, " : " photons, ") << flights << " flights; " << escaped
            << " escaped.\nThe paths are in " << visible_text(folder.string())
            << ": paths.svg (open it in a browser), paths.csv (one row per flight), paths.glb (lines, for any glTF "
               "viewer).\n";
}

}  // namespace

void add_paths_command(CLI::App& program, const Invocation& /*invocation*/) {
  CLI::App* command = program.add_subcommand("paths", "Trace a few photons and show their paths");
  auto options = std::make_shared<PathsCommand>();
  add_room_argument(*command, options->reading);
  command->add_option("-o,--output", options->output, "Folder for the results [name of ROOM with .paths]")
      ->type_name("DIR");
  command->add_option("--photons", options->photons, "Number of photons, up to 10000")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of the random numbers: the first photons of a run with this seed")
      ->type_name("S")
      ->capture_default_str();
  add_room_options(*command, options->reading);
  command->add_flag("--quiet", options->quiet, "Print only errors, no summary");
  command->footer(
      "A photon travels in a straight line to a surface. There it is absorbed with probability 1 - reflectance, or\n"
      "reflected in a random direction (Lambert's law). The colour of a line gives the number of the flight.\n\n"
      "Examples:\n"
      "  lichtmc paths room.glb\n"
      "  lichtmc paths room.glb --photons 10 --seed 7 -o out/paths\n"
      "  lichtmc run room.glb --paths 50          the same paths in the report of a run");
  command->callback([options] { run(*options); });
}

}  // namespace lichtmc::app
