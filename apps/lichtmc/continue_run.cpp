#include "continue_run.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "lichtmc/error.hpp"
#include "noted_room.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

namespace fs = std::filesystem;

std::string note_of(const std::vector<std::string>& arguments) {
  const nlohmann::json note{{"directory", fs::current_path().string()}, {"arguments", arguments}};
  // File names may be any bytes: those that are not UTF-8 are replaced, and resume then requires --room.
  return note.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void add_override_options(CLI::App& command, OverrideOptions& options, const std::string& output_help,
                          const std::string& machine_group) {
  command.add_option("-o,--output", options.output, output_help)->type_name("DIR");
  command.add_option("--room", options.room, "File of the room, if it was moved")->type_name("ROOM");
  command.add_option("--receivers", options.receivers, "Table of receivers, if it was moved or read from stdin")
      ->type_name("FILE.csv");
  add_threads_option(command, options.threads, machine_group);
  add_report_options(command, options.report_arguments);
  add_message_options(command, options.progress, options.quiet,
                      "Print only warnings of check and errors, no progress and no summary");
}

namespace {

// The note of a state; what is no JSON is discarded.
nlohmann::json parsed_note(const State& state) {
  return nlohmann::json::parse(state.note(), nullptr, false);
}

// Whether Result.write() has written the state, of a room that was not read by a command line.
bool is_from_python(const nlohmann::json& note) {
  return note.is_object() && note.contains("python");
}

// The options of the run, with file names relative to the folder in which it was started.
RunOptions noted_options(const State& state, const fs::path& file) {
  const auto refuse = [&file](const std::string& why) {
    throw InputError("The state " + file.string() + " does not contain the options of its run" + why +
                     " (allowed: a state written by `lichtmc run`). Continue it with the program that wrote it.");
  };
  const nlohmann::json note = parsed_note(state);
  if (is_from_python(note))
    throw InputError("The state " + file.string() +
                     " was written from Python, whose rooms have no options of a command line (allowed here: a state "
                     "written by `lichtmc run`). Continue it in Python: lichtmc.resume(lichtmc.Result.load(FOLDER), "
                     "…), or lichtmc.merge().");
  if (!note.is_object() || !note.contains("arguments") || !note["arguments"].is_array() ||
      !note.contains("directory") || !note["directory"].is_string())
    refuse("");
  std::vector<std::string> words;
  for (const nlohmann::json& word : note["arguments"]) {
    if (!word.is_string()) refuse("");
    words.push_back(word.get<std::string>());
  }
  std::reverse(words.begin(), words.end());  // CLI11 reads a vector of arguments from its end
  RunOptions options;
  CLI::App command;
  add_run_options(command, options);
  try {
    command.parse(words);
  } catch (const CLI::ParseError& error) {
    refuse(": " + std::string(error.what()));
  }
  const fs::path directory = note["directory"].get<std::string>();
  options.reading.file = (directory / options.reading.file).string();
  if (options.receivers && *options.receivers != "-") options.receivers = (directory / *options.receivers).string();
  return options;
}

}  // namespace

RunOptions options_of(const State& state, const fs::path& file, const OverrideOptions& overrides) {
  check_version(state);  // options of another version may be unknown
  RunOptions run = noted_options(state, file);
  if (overrides.room) run.reading.file = *overrides.room;
  if (overrides.receivers) run.receivers = overrides.receivers;
  if (run.receivers == "-" && !overrides.receivers)
    throw InputError(
        "The receivers of this run were read from stdin (allowed here: a file, or - again). Give them with "
        "--receivers.");
  run.report_arguments.override_with(overrides.report_arguments);
  return run;
}

namespace {

void check_exists(const std::string& file, const std::string& what, const std::string& remedy) {
  std::error_code unknown;
  if (fs::exists(file, unknown)) return;
  throw InputError("Cannot find " + what + " " + file + " of the run (allowed: the same content at any path). " +
                   remedy + ".");
}

}  // namespace

RunJob job_of(const State& state, const RunOptions& run, const OverrideOptions& overrides,
              const std::string& command_line) {
  if (!overrides.room) check_exists(run.reading.file, "the room", "Give its path with --room");
  if (!overrides.receivers && run.receivers)
    check_exists(*run.receivers, "the table of receivers", "Give its path with --receivers");
  RunJob job;
  job.settings = state.settings();
  job.report = parse_report(run.report_arguments, overrides.threads, command_line);
  job.with_report = wants_report(run.report_arguments);
  job.files.tile_images = wants_images(run.report_arguments);
  job.note = state.note();
  job.quiet = overrides.quiet;
  job.progress = parse_progress(overrides.progress, overrides.quiet);
  job.room = read_run_room(run, job.notes);
  return job;
}

Room noted_room(const State& state, const fs::path& file) {
  if (is_from_python(parsed_note(state)))
    throw InputError("The state " + file.string() +
                     " was written from Python, and beside it is no result.lichtmc of the same result (allowed: all "
                     "files of one Result.write(), or the room as well). Give the room: lichtmc.Result.load(FOLDER, "
                     "room=…).");
  RunOptions run = options_of(state, file, {});
  const std::string remedy = "Give the room to Result.load(), as room=…";
  check_exists(run.reading.file, "the room", remedy);
  if (run.receivers) check_exists(*run.receivers, "the table of receivers", remedy);
  std::vector<std::string> notes;
  return read_run_room(run, notes);
}

fs::path state_file(const std::string& name) {
  const fs::path path(name);
  std::error_code unknown;
  return fs::is_directory(path, unknown) ? path / "state.h5" : path;
}

}  // namespace lichtmc::app
