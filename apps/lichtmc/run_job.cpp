#include "run_job.hpp"

#include <cstddef>
#include <exception>
#include <iostream>
#include <span>
#include <stop_token>
#include <vector>

#include "interrupt.hpp"
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

bool is_first(const RunJob& job) {
  return job.communicator == nullptr || job.communicator->rank() == 0;
}

Result simulate_with(const RunJob& job, const std::stop_token& stop, ProgressLine::Show show,
                     const std::function<Result(const Control&)>& simulate) {
  ProgressLine line(is_first(job) ? show : ProgressLine::Show::no, job.settings);
  Control control;
  control.stop = stop;
  control.communicator = job.communicator;
  if (is_first(job)) {
    control.progress = [&line](const Progress& progress) { line.update(progress); };
    control.checkpoint = [&job](const State& state) { write_checkpoint(state, job); };
  }
  control.checkpoint_seconds = job.checkpoint_seconds;
  return simulate(control);
}

// Folders that are made for a run, and removed again where it is refused: as long as they are empty.
class NewFolders {
 public:
  explicit NewFolders(const fs::path& folder) {
    std::error_code unknown;
    for (fs::path path = fs::absolute(folder); !path.empty() && !fs::exists(path, unknown); path = path.parent_path())
      made_.push_back(path);
  }
  ~NewFolders() {
    std::error_code not_empty;
    for (const fs::path& path : made_) fs::remove(path, not_empty);
  }
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;
  void keep() { made_.clear(); }

 private:
  std::vector<fs::path> made_;  // the innermost first
};

void write_all(RunJob& job, Result& result, ProgressLine::Show show) {
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

}  // namespace

void carry_out_run(RunJob& job, const std::function<Result(const Control&)>& simulate) {
  const InterruptWatch interrupt;
  const auto show = job.quiet ? ProgressLine::Show::no : ProgressLine::Show::yes;
  if (!is_first(job)) {
    simulate_with(job, interrupt.token(), show, simulate);
  } else {
    NewFolders made(job.folder);
    prepare_output(job.folder);
    Result result = simulate_with(job, interrupt.token(), show, simulate);
    made.keep();
    write_all(job, result, show);
  }
  // A member that a signal ends while the first still writes would take it along.
  std::byte written{};
  if (job.communicator != nullptr) job.communicator->broadcast(std::span(&written, 1));
}

}  // namespace lichtmc::app
