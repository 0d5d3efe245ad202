// lichtmc merge: adds the states of parts of one run.
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "continue_run.hpp"
#include "lichtmc/error.hpp"
#include "quantities.hpp"
#include "run_job.hpp"
#include "run_options.hpp"

namespace lichtmc::app {

namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::vector<std::string> states;
  OverrideOptions overrides;
};

// Parts that were stopped before they had walked back from the receivers: beside parts that have they leave a gap.
class Unfinished {
 public:
  void look_at(const State& state, const fs::path& file) {
    if (state.receiver_histories() > 0) {
      some_have_ = true;
    } else {
      files_.push_back(file);
    }
  }
  void tell() const {
    if (!some_have_) return;
    for (const fs::path& file : files_)
      std::cerr << "Warning: " << file.string()
                << " has no walks back from the receivers, other parts have: it was stopped before. The results are "
                   "sound without them. Go on with it by lichtmc resume, then merge again.\n";
  }

 private:
  bool some_have_ = false;
  std::vector<fs::path> files_;
};

// One after the other, so that no more than two and their sum are in memory.
State read_and_merge(const std::vector<fs::path>& files, Unfinished& unfinished) {
  State sum = read_state(files.front());
  unfinished.look_at(sum, files.front());
  std::string names = files.front().string();
  for (std::size_t k = 1; k < files.size(); ++k) {
    State next = read_state(files[k]);
    unfinished.look_at(next, files[k]);
    sum = merge({std::move(sum), std::move(next)}, {names, files[k].string()});
    if (k < 3) names += ", " + files[k].string();
    if (k == 3) names += ", ...";
  }
  return sum;
}

// The sum must not take the place of a part.
void check_output(const fs::path& folder, const std::vector<fs::path>& files) {
  std::error_code unknown;
  for (const fs::path& file : files) {
    if (fs::equivalent(folder / "state.h5", file, unknown))
      throw InputError("The merged state would replace " + file.string() +
                       ", one of its parts (allowed: a folder of its own). Choose another folder with --output.");
  }
}

// A part that was forgotten makes the errors larger, nothing worse; but it should not go unnoticed.
void tell_gaps(const State& state) {
  const auto tell = [](const std::vector<HistoryRange>& ranges, const std::string& what) {
    for (std::size_t k = 1; k < ranges.size(); ++k)
      std::cerr << "The parts leave out " << what << ' ' << ranges[k - 1].last << " to " << ranges[k].first - 1
                << "; the results are sound without them.\n";
  };
  tell(state.histories(), "histories");
  tell(state.receiver_rounds(), "walks back from the receivers, rounds");
}

void merge_states(const MergeOptions& options, const Invocation& invocation) {
  std::vector<fs::path> files;
  for (const std::string& name : options.states) files.push_back(state_file(name));
  Unfinished unfinished;
  State state = read_and_merge(files, unfinished);
  const OverrideOptions& overrides = options.overrides;
  const RunOptions run = options_of(state, files.front(), overrides);
  const fs::path folder =
      overrides.output.empty() ? fs::path(run.reading.file).stem().concat(".merged") : fs::path(overrides.output);
  check_output(folder, files);
  RunJob job = job_of(state, run, overrides, invocation.command_line);
  job.folder = folder;
  if (!job.quiet) tell_gaps(state);
  unfinished.tell();
  const unsigned threads = parse_threads(overrides.threads);
  carry_out_run(job, [&](const Control& control) { return result_of(job.room, std::move(state), threads, control); });
}

}  // namespace

void add_merge_command(CLI::App& program, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("merge", "Add up the parts of a run that other machines have simulated");
  auto options = std::make_shared<MergeOptions>();
  command->add_option("states", options->states, "state.h5 of each part, or the folder that it is in")
      ->required()
      ->type_name("STATE");
  add_override_options(*command, options->overrides, "Folder for the results [name of the room with .merged]", "How");
  command->footer(
      "Parts are runs of the same room with the same settings and --histories A:B that do not overlap. In any order "
      "and\n"
      "grouping they add up, to the last digit, to one run of all histories. The sum may be merged again, or "
      "resumed.\n\n"
      "Example:\n"
      "  lichtmc run room.glb --histories 0:10240000 -o one            on one machine\n"
      "  lichtmc run room.glb --histories 10240000:20480000 -o two     on another\n"
      "  lichtmc merge one two -o both");
  command->callback([options, &invocation] { merge_states(*options, invocation); });
}

}  // namespace lichtmc::app
