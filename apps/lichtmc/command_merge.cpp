// lichtmc merge: adds the states of the parts of one run.
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
#include "lichtmc/visible_text.hpp"
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

// Parts that were stopped before their backward histories from the receivers: if other parts have them, there is a gap.
class IncompleteParts {
 public:
  void add(const State& state, const fs::path& file) {
    if (state.receiver_histories() > 0) {
      others_complete_ = true;
    } else {
      files_.push_back(file);
    }
  }
  void warn() const {
    if (!others_complete_) return;
    for (const fs::path& file : files_)
      std::cerr << "Warning: " << visible_text(file.string())
                << " has no backward histories from the receivers, but other parts have: the part was stopped before "
                   "them. The results are valid without them. Complete the part with lichtmc resume, then merge "
                   "again.\n";
  }

 private:
  bool others_complete_ = false;
  std::vector<fs::path> files_;
};

// One after the other, so that at most two states and their sum are in memory.
State read_and_merge(const std::vector<fs::path>& files, IncompleteParts& incomplete) {
  State sum = read_state(files.front());
  incomplete.add(sum, files.front());
  std::string names = files.front().string();
  for (std::size_t k = 1; k < files.size(); ++k) {
    State next = read_state(files[k]);
    incomplete.add(next, files[k]);
    sum = merge({std::move(sum), std::move(next)}, {names, files[k].string()});
    if (k < 3) names += ", " + files[k].string();
    if (k == 3) names += ", ...";
  }
  return sum;
}

// The sum must not replace a part.
void check_output(const fs::path& folder, const std::vector<fs::path>& files) {
  std::error_code unknown;
  for (const fs::path& file : files) {
    if (fs::equivalent(folder / "state.h5", file, unknown))
      throw InputError("The merged state would replace " + file.string() +
                       ", one of its parts (allowed: a folder without a part). Choose another folder with --output.");
  }
}

// A missing part only makes the standard errors larger, but it is reported.
void report_gaps(const State& state) {
  const auto report = [](const std::vector<HistoryRange>& ranges, const std::string& what) {
    for (std::size_t k = 1; k < ranges.size(); ++k)
      std::cerr << "No part contains the " << what << ' ' << ranges[k - 1].last << " to " << ranges[k].first - 1
                << "; the results are valid without them.\n";
  };
  report(state.histories(), "histories");
  report(state.receiver_rounds(), "backward histories from the receivers of the rounds");
}

void merge_states(const MergeOptions& options, const Invocation& invocation) {
  std::vector<fs::path> files;
  for (const std::string& name : options.states) files.push_back(state_file(name));
  IncompleteParts incomplete;
  State state = read_and_merge(files, incomplete);
  const OverrideOptions& overrides = options.overrides;
  const RunOptions run = options_of(state, files.front(), overrides);
  const fs::path folder =
      overrides.output.empty() ? fs::path(run.reading.file).stem().concat(".merged") : fs::path(overrides.output);
  check_output(folder, files);
  RunJob job = job_of(state, run, overrides, invocation.command_line);
  job.folder = folder;
  if (!job.quiet) report_gaps(state);
  incomplete.warn();
  const unsigned threads = parse_threads(overrides.threads);
  carry_out_run(job, [&](const Control& control) { return result_of(job.room, std::move(state), threads, control); });
}

}  // namespace

void add_merge_command(CLI::App& program, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("merge", "Add the parts of a run that were simulated separately");
  auto options = std::make_shared<MergeOptions>();
  command->add_option("states", options->states, "state.h5 of each part, or its folder")
      ->required()
      ->type_name("STATE");
  add_override_options(*command, options->overrides, "Folder for the results [name of the room with .merged]",
                       "Execution");
  command->footer(
      "Parts are runs of the same room with the same settings and ranges --histories A:B that do not overlap. Merged "
      "in\n"
      "any order and grouping, they give results identical to one run of all histories. The sum can be merged again "
      "or\n"
      "resumed.\n\n"
      "Example:\n"
      "  lichtmc run room.glb --histories 0:10240000 -o one            on one machine\n"
      "  lichtmc run room.glb --histories 10240000:20480000 -o two     on another\n"
      "  lichtmc merge one two -o both");
  command->callback([options, &invocation] { merge_states(*options, invocation); });
}

}  // namespace lichtmc::app
