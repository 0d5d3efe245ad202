// Studies: time against error in a room.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/study.hpp"
#include "shared_room.hpp"
#include "worker.hpp"

namespace lichtmc::python {

namespace {

using Fields = std::vector<std::pair<const char*, const char*>>;  // name and type, in numpy's words

const Fields fields_of_row{{"direction", "U8"},      {"estimator", "U10"},  {"engine", "U11"}, {"direct", "U8"},
                           {"histories", "u8"},      {"max_bounces", "u4"}, {"tile", "f8"},    {"seconds", "f8"},
                           {"direct_seconds", "f8"}, {"rms_error", "f8"},   {"bias", "f8"},    {"standard_error", "f8"},
                           {"figure_of_merit", "f8"}};

nb::tuple values_of(const StudyRow& row) {
  const auto text = [](std::string_view word) { return std::string(word); };
  return nb::make_tuple(text(to_string(row.direction)), text(to_string(row.estimator)), text(to_string(row.engine)),
                        text(to_string(row.direct)), row.histories, row.max_bounces.value_or(0), row.tile_edge_m,
                        row.seconds, row.direct_seconds, row.rms_error, row.bias, row.standard_error,
                        row.figure_of_merit);
}

const Fields fields_of_reference{
    {"tile", "f8"}, {"tiles", "u8"}, {"histories", "u8"}, {"standard_error", "f8"}, {"area_share", "f8"}};

nb::tuple values_of(const StudyReference& reference) {
  return nb::make_tuple(reference.tile_edge_m, reference.tiles, reference.histories, reference.standard_error,
                        reference.area_share);
}

// A structured array, read-only, with an element for each row.
template <class Row>
nb::object structured(const std::vector<Row>& rows, const Fields& fields) {
  nb::list values;
  for (const Row& row : rows) values.append(values_of(row));
  nb::list type;
  for (const auto& [name, kind] : fields) type.append(nb::make_tuple(name, kind));
  nb::object array = nb::module_::import_("numpy").attr("array")(values, type);
  array.attr("flags").attr("writeable") = false;
  return array;
}

Study study_aside(const SharedRoom& shared, StudyOptions options, const nb::object& on_progress) {
  Room room = shared.room();
  room.area_requests.clear();  // as receivers, areas are not studied
  const auto work = [&](std::stop_token stop, const std::function<void(const StudyProgress&)>& tell) {
    options.stop = std::move(stop);
    options.progress = tell;
    return study(room, options);
  };
  std::function<void(const StudyProgress&)> on_report;
  if (!on_progress.is_none()) on_report = [&](const StudyProgress& progress) { on_progress(progress); };
  return work_aside<Study, StudyProgress>(work, on_report);
}

}  // namespace

void bind_study(nb::module_& module) {
  nb::class_<StudyProgress>(module, "StudyProgress", "How far a study is, for callbacks.")
      .def_ro("what", &StudyProgress::what, "The current run: 'forward, collision, tiles of 0.1 m'.")
      .def_ro("done", &StudyProgress::done, "Number of runs that have ended.")
      .def_ro("of", &StudyProgress::of, "Number of all runs; 0 while it is unknown.")
      .def_ro("seconds", &StudyProgress::seconds, "Since the study began, s.")
      .def_ro("of_seconds", &StudyProgress::of_seconds, "Of the whole study, s.");
  nb::class_<Advice>(module, "Advice", "The setting with the lowest cost for one accuracy.")
      .def_ro("error", &Advice::error, "The relative error, 0.1, 0.01 or 0.001.")
      .def_ro("histories", &Advice::histories, "Histories that it requires.")
      .def_ro("seconds", &Advice::seconds, "Forecast of the time, s.")
      .def_ro("sentence", &Advice::sentence, "The advice in words.")
      .def_prop_ro(
          "setting",
          [](const Advice& advice) {
            const nb::object rows = structured<StudyRow>({advice.setting}, fields_of_row);
            return nb::object(rows[0]);
          },
          "The row of Study.rows from which it is derived.")
      .def("__str__", [](const Advice& advice) { return advice.sentence; })
      .def("__repr__", [](const Advice& advice) { return "<lichtmc.Advice: " + advice.sentence + ">"; });
  nb::class_<Study>(module, "Study", "Time against error in a room. str() of it is the advice.")
      .def_ro("room", &Study::room, "Where the room comes from.")
      .def_ro("threads", &Study::threads, "Number of threads.")
      .def_prop_ro(
          "rows", [](const Study& study) { return structured(study.rows, fields_of_row); },
          "The runs: a structured array (n,) with direction, estimator, engine, direct (texts), histories, max_bounces "
          "(0: no limit), tile (m), seconds, direct_seconds (s), rms_error, bias, standard_error (relative), "
          "figure_of_merit (1/s).")
      .def_prop_ro(
          "references", [](const Study& study) { return structured(study.references, fields_of_reference); },
          "What the rows are compared with, one for each size of tiles: a structured array with tile (m), tiles, "
          "histories, standard_error (relative), area_share (of the lit area on tiles known to 10 % or better).")
      .def_ro("advice", &Study::advice, "A list of Advice: the settings with the lowest cost.")
      .def_ro("left_out", &Study::left_out, "Runs without enough time, or not possible in the room: sentences.")
      .def(
          "write",
          [](const Study& study, const std::filesystem::path& folder) {
            const FolderLock lock = prepare_output(folder);
            write_study(study, folder);
          },
          nb::arg("folder"), nb::call_guard<nb::gil_scoped_release>(),
          "Writes study.csv, advice.txt and pictures into a folder, as `lichtmc study` does.")
      .def("__str__", [](const Study& study) { return advice_text(study); })
      .def("__repr__", [](const Study& study) {
        return "<lichtmc.Study of '" + study.room + "', " + std::to_string(study.rows.size()) + " runs>";
      });
  module.def(
      "study",
      [](const SharedRoom& room, double seconds, std::optional<double> tile, std::uint64_t seed, unsigned threads,
         const nb::object& progress) {
        StudyOptions options;
        options.seconds = seconds;
        options.tile_edge_m = tile;
        options.seed = seed;
        options.threads = threads;
        return study_aside(room, std::move(options), progress);
      },
      nb::arg("room"), nb::arg("seconds"), nb::arg("tile").none(), nb::arg("seed"), nb::arg("threads"),
      nb::arg("progress").none(), "See lichtmc.study(), which documents the arguments.");
}

}  // namespace lichtmc::python
