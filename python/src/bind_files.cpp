// Results in folders: what `lichtmc run` writes, and reading it again.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

#include "aside.hpp"
#include "bindings.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/inspect.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/simulate.hpp"
#include "lichtmc/state.hpp"
#include "named_values.hpp"
#include "noted_room.hpp"
#include "outcome.hpp"
#include "packed.hpp"
#include "run_result.hpp"
#include "simulate.hpp"

namespace lichtmc::python {

namespace {

namespace fs = std::filesystem;

// The note of states that have no other: then `lichtmc resume` tells where to continue.
constexpr const char* python_note = R"({"python":"lichtmc.Result.write"})";

// The first bytes of state.h5, among them its checksum: they tell whether result.lichtmc belongs to it.
std::string seal_of_state(const fs::path& file) {
  constexpr std::size_t length = 512;
  std::string seal(length, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(seal.data(), length);
  seal.resize(static_cast<std::size_t>(stream.gcount()));
  return seal;
}

struct FileOptions {
  bool report = true;
  ResultFiles files;
  ReportOptions page;
};

// What write_report() would refuse, when the tables are written already.
void check_page(const ReportOptions& page) {
  constexpr std::uint64_t most_paths = 10'000;
  if (page.paths > most_paths)
    throw InputError("The argument paths is " + std::to_string(page.paths) +
                     " (allowed: 0 to 10000). Give a smaller number.");
  const std::optional<double>& high = page.scale.high;
  if (high && !(*high >= least_scale_top && *high <= greatest_scale_top)) {
    std::ostringstream text;
    text << *high;
    throw InputError("The argument scale_max is " + text.str() +
                     " (allowed: a number above 0, from 1e-300 to 1e300, in W/m² or lx). Give such a number, or leave "
                     "it out.");
  }
}

// A state that is written beside its later place, and removed unless it is moved there. Killed processes leave it
// behind; its name is one of those that prepare_output() then removes.
class StagedState {
 public:
  StagedState(const State& state, const fs::path& folder, const std::string& note)
      : file_(folder / "state.h5"), staged_(folder / ("state.h5.tmp" + std::to_string(::getpid()))) {
    write_state(state, staged_, note);
  }
  ~StagedState() {
    std::error_code moved;
    fs::remove(staged_, moved);
  }
  StagedState(const StagedState&) = delete;
  StagedState& operator=(const StagedState&) = delete;

  std::string seal() const { return seal_of_state(staged_); }
  void publish() {
    std::error_code error;
    fs::rename(staged_, file_, error);
    if (error) throw RuntimeError("Cannot write " + file_.string() + " (" + error.message() + "). Write it again.");
  }

 private:
  fs::path file_, staged_;
};

void write_files(const RunResult& run, const fs::path& folder, FileOptions options) {
  check_page(options.page);
  const Room& room = run.room->room;
  const FolderLock lock = prepare_output(folder);
  options.page.prepared = run.room->prepared(run.result.settings.threads);
  options.page.inspection =
      std::make_shared<const Inspection>(inspect(room, run.result.settings.tile_edge_m, options.page.prepared));
  const std::string& note = run.result.state.note();
  StagedState state(run.result.state, folder, note.empty() ? python_note : note);
  options.files.kept = pack_beside_state(room, run.result, state.seal());

  // As the command line does: with the warnings of the check. Only they need a copy.
  const std::vector<std::string> of_check = warning_lines(room, *options.page.inspection);
  std::optional<Result> with_warnings;
  if (!of_check.empty()) {
    with_warnings = run.result;
    with_warnings->warnings = app::without_repeated(run.result.warnings, of_check);
    with_warnings->warnings.insert(with_warnings->warnings.end(), of_check.begin(), of_check.end());
  }
  const Result& written = with_warnings ? *with_warnings : run.result;
  write_results(room, written, folder, options.files);
  state.publish();
  if (options.report) write_report(room, written, folder, options.page);
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// A state with the seal that its file had.
struct SealedState {
  State state;
  std::string seal;
};

SealedState state_in(const fs::path& folder) {
  const fs::path file = folder / "state.h5";
  std::error_code unknown;
  if (!fs::exists(folder, unknown))
    throw InputError("The folder " + folder.string() +
                     " does not exist (allowed: the folder of a result that Result.write() or `lichtmc run` has "
                     "written). Correct the path.");
  if (!fs::exists(file, unknown))
    throw InputError("The folder " + folder.string() +
                     " contains no state.h5 (allowed: the folder of a result that Result.write() or `lichtmc run` has "
                     "written). Give that folder.");
  SealedState found;
  found.seal = seal_of_state(file);
  found.state = read_state(file);
  if (seal_of_state(file) != found.seal)
    throw InputError("The file " + file.string() +
                     " was replaced while it was read (allowed: a folder that nobody writes into). Load it again.");
  return found;
}

// The result that Result.write() has kept, if it belongs to this state.
RunResultPtr kept_result(const fs::path& folder, const SealedState& sealed) {
  const fs::path file = folder / "result.lichtmc";
  std::error_code unknown;
  if (!fs::exists(file, unknown)) return nullptr;
  auto kept = unpack_beside_state(content_of(file), sealed.seal, "the file " + file.string());
  if (!kept) return nullptr;
  kept->result.state = sealed.state;
  return make_run_result(std::make_shared<KeptRoom>(std::move(kept->room)), std::move(kept->result));
}

RunResultPtr load(const fs::path& folder, std::optional<SharedRoom> room) {
  SealedState sealed;
  std::shared_ptr<const KeptRoom> of_state = room ? with_areas(*room) : nullptr;
  {
    const nb::gil_scoped_release without_lock;
    sealed = state_in(folder);
    if (!of_state) {
      if (RunResultPtr kept = kept_result(folder, sealed)) return kept;
      of_state = std::make_shared<KeptRoom>(app::noted_room(sealed.state, folder / "state.h5"));
    }
  }
  constexpr unsigned all_processors = 0;
  return run_aside(
      of_state, all_processors, nb::none(),
      [&](const Control& control) { return result_of(of_state->room, sealed.state, all_processors, control); },
      Interrupted::raises);
}

}  // namespace

void bind_files(nb::module_& module) {
  auto result = nb::borrow<nb::class_<RunResult>>(module.attr("Result"));
  result.def(
      "write",
      [](const RunResult& run, const fs::path& folder, bool report, bool images, const std::string& report_style,
         const std::string& project, const std::string& author, const std::string& date, const std::string& colours,
         const std::string& scale, std::optional<double> scale_max, std::uint64_t paths) {
        FileOptions options;
        options.report = report;
        options.files.tile_images = images;
        ReportOptions& page = options.page;
        page.style = named<ReportStyle>("report_style", report_style,
                                        {{"auto", ReportStyle::automatic},
                                         {"lighting", ReportStyle::lighting},
                                         {"technical", ReportStyle::technical}});
        page.project = project;
        page.author = author;
        page.date = date;
        page.scale.colours =
            named<ColourMap>("colours", colours, {{"viridis", ColourMap::viridis}, {"inferno", ColourMap::inferno}});
        page.scale.type = named<ScaleType>(
            "scale", scale,
            {{"auto", ScaleType::automatic}, {"linear", ScaleType::linear}, {"log", ScaleType::logarithmic}});
        page.scale.high = scale_max;
        page.tile_images = images;
        page.paths = paths;
        page.threads = run.result.settings.threads;
        const nb::gil_scoped_release without_lock;
        write_files(run, folder, std::move(options));
      },
      nb::arg("folder"), nb::kw_only(), nb::arg("report") = true, nb::arg("images") = true,
      nb::arg("report_style") = "auto", nb::arg("project") = "", nb::arg("author") = "", nb::arg("date") = "",
      nb::arg("colours") = "viridis", nb::arg("scale") = "auto", nb::arg("scale_max").none() = nb::none(),
      nb::arg("paths") = 0,
      R"(Writes the files that `lichtmc run` writes into a folder: tables, state.h5, a report; docs/results.md lists them.

One more, result.lichtmc, is for Result.load(), which gives the same result again, exactly. The folder and its parents
are created. Tables, state.h5 and result.lichtmc are replaced together, when all the new ones are complete, then those of
the report: never is one half written. Files of an earlier result that this one does not have are removed.

Args:
    folder: The folder.
    report: Whether report.html, room_lit.glb and pictures are written too.
    images: Whether the tiles are written as OpenEXR images too.
    report_style: "lighting" (pages for a client), "technical", or "auto": lighting if there are areas.
    project: Words for the title of lighting pages.
    author: The same.
    date: The same.
    colours: "viridis" or "inferno".
    scale: "linear", "log" (logarithmic), or "auto": logarithmic if few tiles are far brighter than the others.
    scale_max: Irradiance of the top colour, W/m² or lx. Default: chosen from the tiles.
    paths: Number of photon paths in the report, 0 to 10 000.

Raises:
    InputError: The folder cannot be used, another run is writing into it, or an argument is not valid.
    RuntimeError: A file cannot be written. Unless it is one of the report, those of an earlier result are then
        unchanged.)");
  result.def(
      "summary",
      [](const RunResult& run) {
        std::string text;
        {
          const nb::gil_scoped_release without_lock;
          text = summary_json(run.room->room, run.result);
        }
        return nb::cast<nb::dict>(nb::module_::import_("json").attr("loads")(text));
      },
      "The content of summary.json as a dict: settings, balance of powers, errors, warnings, figures of surfaces, "
      "receivers, areas and channels; docs/results.md describes the keys. None where a number is unknown.");
  result.def_static("load", &load, nb::arg("folder"), nb::arg("room").none() = nb::none(),
                    R"(The result in a folder that Result.write() or `lichtmc run` has written.

A folder of Result.write() gives the result that was written, exactly. A folder of `lichtmc run` contains the sums of the
walks and how the room was read: the room is read again, and the figures, to the last digit those of the run, are
computed again. This takes as long as the direct light of the run, but no photons are simulated.

Load only folders whose origin you trust: a checksum detects damage, not files that were made to do harm.

Args:
    folder: The folder.
    room: The room, if its file was moved, or if another program has written the folder. It must be the same.

Raises:
    InputError: The folder contains no result, or one of another version of lichtmc; it is damaged; or the room is
        missing or not the same.)");
}

}  // namespace lichtmc::python
