#include "run_job.hpp"

#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>

#include "interrupt.hpp"
#include "lichtmc/error.hpp"
#include "outcome.hpp"
#include "progress_line.hpp"

namespace lichtmc::app {

namespace fs = std::filesystem;

namespace {

// A checkpoint that fails does not end a long run: the next may succeed, and the results are still to come.
void write_checkpoint(const State& state, const RunJob& job) {
  try {
    fs::create_directories(job.folder);
    write_state(state, job.folder / "state.h5", job.note);
  } catch (const std::exception& error) {
    std::cerr << "\nWarning: the checkpoint was not written; the run goes on. " << error.what() << '\n';
  }
}

Result simulate_with(const RunJob& job, ProgressLine::Show show,
                     const std::function<Result(const Control&)>& simulate) {
  const bool first = job.team == nullptr || job.team->rank() == 0;
  const InterruptWatch interrupt;
  ProgressLine line(first ? show : ProgressLine::Show::no, job.settings);
  Control control;
  control.stop = interrupt.token();
  control.team = job.team;
  if (first) {
    control.progress = [&line](const Progress& progress) { line.update(progress); };
    control.checkpoint = [&job](const State& state) { write_checkpoint(state, job); };
  }
  control.checkpoint_seconds = job.checkpoint_seconds;
  return simulate(control);
}

}  // namespace

void carry_out(RunJob& job, const std::function<Result(const Control&)>& simulate) {
  const bool first = job.team == nullptr || job.team->rank() == 0;
  if (first) prepare_output(job.folder);
  const auto show = job.quiet ? ProgressLine::Show::no : ProgressLine::Show::yes;
  Result result = simulate_with(job, show, simulate);
  if (!first) return;
  if (!fs::exists(job.folder)) prepare_output(job.folder);
  write_state(result.state, job.folder / "state.h5", job.note);
  result.state = {};  // as much memory as the tiles
  write_results(job.room, result, job.folder);
  if (job.with_report) {
    StepLine line(show);
    job.report.progress = [&line](std::string_view what) { line.tell(what); };
    write_report(job.room, result, job.folder, job.report);
  }
  if (!job.quiet) print_outcome(result, job.folder, job.with_report);
}

std::string note_of(const std::vector<std::string>& arguments) {
  const nlohmann::json note{{"directory", fs::current_path().string()}, {"arguments", arguments}};
  // Names of files may be any bytes: those that are no UTF-8 are replaced, and the file is then asked for by --room.
  return note.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

RunOptions options_of(const State& state, const fs::path& file) {
  const auto refuse = [&file](const std::string& why) {
    throw InputError("The state " + file.string() + " does not say how it was run" + why +
                     " (allowed: a state that `lichtmc run` has written). Go on with it in the program that made it.");
  };
  const nlohmann::json note = nlohmann::json::parse(state.note(), nullptr, false);
  if (!note.is_object() || !note.contains("arguments") || !note["arguments"].is_array() ||
      !note.contains("directory") || !note["directory"].is_string())
    refuse("");
  std::vector<std::string> words;
  for (const nlohmann::json& word : note["arguments"]) {
    if (!word.is_string()) refuse("");
    words.insert(words.begin(), word.get<std::string>());  // the parser takes them from the back
  }
  RunOptions options;
  CLI::App command;
  add_run_options(command, options);
  try {
    command.parse(words);
  } catch (const CLI::ParseError& error) {
    refuse(": " + std::string(error.what()));
  }
  const fs::path directory = note["directory"].get<std::string>();
  const auto there = [&directory](const std::string& name) { return (directory / name).lexically_normal().string(); };
  options.reading.file = there(options.reading.file);
  if (options.receivers && *options.receivers != "-") options.receivers = there(*options.receivers);
  return options;
}

fs::path state_file(const std::string& name) {
  const fs::path path(name);
  std::error_code unknown;
  return fs::is_directory(path, unknown) ? path / "state.h5" : path;
}

}  // namespace lichtmc::app
