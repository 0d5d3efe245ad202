#include "run_job.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "interrupt.hpp"
#include "lichtmc/inspect.hpp"
#include "lichtmc/visible_text.hpp"
#include "outcome.hpp"
#include "progress_line.hpp"

namespace lichtmc::app {

namespace fs = std::filesystem;

namespace {

// Someone may have removed the folder during the run: then it is created and locked again.
void hold_folder(RunJob& job) {
  if (!job.lock || !job.lock->holds()) job.lock = prepare_output(job.folder);
}

// A checkpoint that fails does not end a run: the next may succeed.
void write_checkpoint(const State& state, RunJob& job) {
  try {
    hold_folder(job);
    write_state(state, job.folder / "state.h5", job.note);
  } catch (const std::exception& error) {
    std::cerr << "\nWarning: the checkpoint was not written; the run continues. " << visible_text(error.what()) << '\n';
  }
}

// prepared: of the room, or null.
Result simulate_with(RunJob& job, const std::shared_ptr<PreparedRoom>& prepared, const std::stop_token& stop,
                     ProgressForm form, const std::function<Result(const Control&)>& simulate) {
  ProgressLine line(is_rank_0(job.communicator) ? form : ProgressForm::none, job.settings);
  Control control;
  control.stop = stop;
  control.communicator = job.communicator;
  control.prepared = prepared;
  if (is_rank_0(job.communicator)) {
    control.progress = [&line](const Progress& progress) { line.update(progress); };
    control.checkpoint = [&job](const State& state) { write_checkpoint(state, job); };
  }
  control.checkpoint_seconds = job.checkpoint_seconds;
  return simulate(control);
}

// Folders that are created for a run, and removed if the run is refused and they are empty.
class NewFolders {
 public:
  explicit NewFolders(const fs::path& folder) {
    std::error_code unknown;
    for (fs::path path = fs::absolute(folder); !path.empty() && !fs::exists(path, unknown); path = path.parent_path())
      created_.push_back(path);
  }
  ~NewFolders() {
    std::error_code not_empty;
    for (const fs::path& path : created_) fs::remove(path, not_empty);
  }
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;
  void keep() { created_.clear(); }

 private:
  std::vector<fs::path> created_;  // the innermost first
};

// Ends the lock of a folder before it may be removed.
class ReleaseAtEnd {
 public:
  explicit ReleaseAtEnd(std::optional<FolderLock>& lock) : lock_(&lock) {}
  ~ReleaseAtEnd() { lock_->reset(); }
  ReleaseAtEnd(const ReleaseAtEnd&) = delete;
  ReleaseAtEnd& operator=(const ReleaseAtEnd&) = delete;

 private:
  std::optional<FolderLock>* lock_;
};

// The photometric files, and along which side of their openings C0 lies: they are never turned.
void print_luminaires(const Inspection& inspection) {
  constexpr std::size_t shown = 3;
  std::size_t count = 0;
  for (const Finding& finding : inspection.findings) {
    if (finding.topic != "luminaires" || ++count > shown) continue;
    std::cerr << "Note: " << visible_text(finding.text) << '\n';
  }
  if (count > shown)
    std::cerr << "Note: " << count - shown << " more photometric " << (count - shown == 1 ? "file" : "files")
              << ": lichtmc check.\n";
}

// Before the run: what `lichtmc check` warns of. A room with a fault is refused with a message of its own, unless the
// number of flights is limited: then light may be enclosed without absorption.
std::vector<std::string> print_warnings_of_check(const RunJob& job, const Inspection& inspection) {
  if (inspection.count(Severity::fault) > 0 && !job.settings.max_bounces) return {};
  if (!job.quiet) print_luminaires(inspection);
  std::vector<std::string> lines = warning_lines(job.room, inspection);
  for (const std::string& line : lines) std::cerr << "Warning: " << visible_text(line) << '\n';
  return lines;
}

// The greater error of those of tiles and receivers.
std::optional<double> error_of(const Result& result) {
  std::optional<double> error;
  if (!result.tiles.empty()) error = result.walk.rms_relative_error;
  if (!result.receiver_results.empty()) error = std::max(error.value_or(0.0), result.receiver_walk.rms_relative_error);
  return error;
}

void write_all(RunJob& job, Result& result, const std::vector<std::string>& printed, ProgressForm form) {
  hold_folder(job);
  hold_folder(job);
  const std::vector<std::string> of_the_run = without_repeated(result.warnings, printed);
  result.warnings = of_the_run;
  result.warnings.insert(result.warnings.end(), printed.begin(), printed.end());
  {
    StepLine line(form);
    line.set_stage("writing");
    line.update("Writing the results");
    write_state(result.state, job.folder / "state.h5", job.note);
    result.state = {};  // frees as much memory as the tiles need
    write_results(job.room, result, job.folder, job.files);
  }
  if (job.with_report) {
    StepLine line(form);
    line.set_stage("writing");
    job.report.progress = [&line](std::string_view what) { line.update(what); };
    write_report(job.room, result, job.folder, job.report);
  }
  if (form == ProgressForm::json) tell_done(error_of(result), result.settings.target_error);
  result.warnings = of_the_run;
  for (std::string& note : files_left_out(result)) result.warnings.push_back(std::move(note));
  if (!job.quiet) print_outcome(job.room, result, job.folder, job.with_report, job.files.tile_images);
}

std::string gigabytes(double bytes) {
  char text[32];
  constexpr double many = 99.5e9;  // two digits would need an exponent
  std::snprintf(text, sizeof text, bytes < many ? "%.2g GB" : "%.0f GB", bytes / 1e9);
  return text;
}

std::string megabytes(double bytes) {
  return bytes < 1e9 ? std::to_string(std::lround(std::max(1.0, bytes / 1e6))) + " MB" : gigabytes(bytes);
}

// Before anything is prepared: a run that gets no more memory is ended by the system, without a message.
void tell_memory(const RunJob& job) {
  const unsigned threads =
      job.report.threads > 0 ? job.report.threads : std::max(1U, std::thread::hardware_concurrency());
  const MemoryForecast memory = forecast_memory(job.room, job.settings.tile_edge_m, threads);
  const std::string needs = " run needs about " + gigabytes(memory.needed) + " of memory";
  const double of_channels = forecast_channel_memory(job.room, job.settings, threads).needed;
  if (of_channels > 0.0 && !job.quiet) {
    std::cerr << "Note: the impulse responses need about " << megabytes(of_channels) << " of memory"
              << (std::isfinite(memory.available) ? "; " + gigabytes(memory.available) + " are free" : "") << ".\n";
  }
  constexpr double large = 1e9;
  if (memory.needed > memory.available) {
    std::cerr
        << "Warning: The" << needs << ", but only " << gigabytes(memory.available)
        << " are free: the system may end it. Give --tile a greater length, use meshes of fewer triangles, or end "
           "other programs.\n";
  } else if (memory.needed > large && !job.quiet) {
    std::cerr << "Note: the" << needs
              << (std::isfinite(memory.available) ? "; " + gigabytes(memory.available) + " are free" : "") << ".\n";
  }
}

// What the user should know before the simulation.
void print_notes(const RunJob& job) {
  if (!job.lock->supported())
    std::cerr << "Warning: the file system of " << visible_text(job.folder.string())
              << " has no locks: start no other run with this output folder before this run ends.\n";
  if (job.quiet) return;
  for (const std::string& note : job.notes) std::cerr << "Note: " << visible_text(note) << '\n';
}

}  // namespace

bool is_rank_0(const Communicator* communicator) {
  return communicator == nullptr || communicator->rank() == 0;
}

void carry_out_run(RunJob& job, const std::function<Result(const Control&)>& simulate) {
  const InterruptWatch interrupt;
  const ProgressForm form = job.progress;
  if (!is_rank_0(job.communicator)) {
    simulate_with(job, nullptr, interrupt.token(), form, simulate);
  } else {
    NewFolders created(job.folder);
    const ReleaseAtEnd release(job.lock);
    hold_folder(job);
    print_notes(job);
    tell_memory(job);
    StepLine line(form);
    const auto prepared = prepare(job.room, job.report.threads, [&line](std::string_view step) { line.update(step); });
    const double edge_m = job.settings.tile_edge_m;
    const auto inspection = std::make_shared<const Inspection>(inspect(job.room, edge_m, prepared));
    line.clear();
    const std::vector<std::string> warnings = print_warnings_of_check(job, *inspection);
    Result result = simulate_with(job, prepared, interrupt.token(), form, simulate);
    created.keep();
    job.report.prepared = prepared;
    if (result.settings.tile_edge_m == edge_m) job.report.inspection = inspection;
    write_all(job, result, warnings, form);
  }
  // All ranks wait until rank 0 has written: mpirun ends all processes if a signal ends one of them.
  std::byte written{};
  if (job.communicator != nullptr) job.communicator->broadcast(std::span(&written, 1));
}

}  // namespace lichtmc::app
