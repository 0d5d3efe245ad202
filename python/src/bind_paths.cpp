// Paths of single photons.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "aside.hpp"
#include "checked_call.hpp"
#include "lichtmc/paths.hpp"
#include "named_values.hpp"
#include "room_parts.hpp"

namespace lichtmc::python {

namespace {

View<double> points_of(const PhotonPath& path) {
  std::vector<double> values;
  for (const PathPoint& point : path.points) values.insert(values.end(), {point.place.x, point.place.y, point.place.z});
  return owned<double, 2>(std::move(values), {path.points.size(), 3});
}

View<double> weights_of(const PhotonPath& path) {
  std::vector<double> values;
  for (const PathPoint& point : path.points) values.push_back(point.weight);
  return owned<double, 1>(std::move(values), {path.points.size()});
}

View<std::int64_t> surfaces_of(const PhotonPath& path) {
  std::vector<std::int64_t> values;
  for (const PathPoint& point : path.points)
    values.push_back(point.surface == no_surface ? -1 : static_cast<std::int64_t>(point.surface));
  return owned<std::int64_t, 1>(std::move(values), {path.points.size()});
}

std::vector<PhotonPath> paths(const SharedRoom& room, nb::handle count, nb::handle seed, nb::handle estimator) {
  Settings settings;
  settings.seed = seed_of(seed);
  settings.estimator =
      named<Estimator>("estimator", text_of(estimator, "estimator"),
                       {Estimator::automatic, Estimator::collision, Estimator::weight, Estimator::absorption});
  const auto number = static_cast<std::uint64_t>(whole_number_of(count, "number of paths", 1, 1'000'000));
  const auto kept = room.kept();
  return aside<std::vector<PhotonPath>>([&] { return trace_paths(kept->room, settings, number); });
}

// Signatures, for Python and for messages.
constexpr const char* paths_signature =
    "def paths(self, count: int = 50, *, seed: int = 1, estimator: str = 'collision') -> list[Path]";

}  // namespace

void bind_paths(nb::module_& module, RoomClass& room) {
  nb::class_<PhotonPath>(module, "Path", "The path of one photon: its start and the ends of its flights.")
      .def("__len__", [](const PhotonPath& path) { return path.points.size(); })
      .def_ro("history", &PhotonPath::history, "Number of the photon, from 0.")
      .def_prop_ro("points", &points_of, has_owner, "Start, then the end of each flight, m, float64 (k, 3).")
      .def_prop_ro("weights", &weights_of, has_owner,
                   "Weight of the photon on arrival, float64 (k,): below 1 with the estimator 'weight' only.")
      .def_prop_ro("surfaces", &surfaces_of, has_owner,
                   "Index into Room.surfaces of each point, int64 (k,); −1: on none (a point emitter, an escape).")
      .def_prop_ro(
          "end", [](const PhotonPath& path) { return std::string(to_string(path.end)); },
          "How it ended: 'absorbed', 'escaped', 'cut off' or 'lost'.")
      .def("__repr__", [](const PhotonPath& path) {
        return "<Path " + std::to_string(path.history) + ": " + std::to_string(path.points.size()) + " points, " +
               std::string(to_string(path.end)) + ">";
      });
  room.def("paths", checked("paths", paths_signature, &paths), any_arg("count") = 50, nb::kw_only(),
           any_arg("seed") = 1, any_arg("estimator") = "collision", other_keywords(), nb::sig(paths_signature),
           R"(The paths of the first photons of a run with this seed and estimator, a list of :class:`Path`.

Args:
    count: Number of photons, 1 to 1 000 000.
    seed: Of the random numbers.
    estimator: "collision", "weight", "absorption", or "auto": collision.)");
}

}  // namespace lichtmc::python
