// The parts of emitters in a result, and scenes with some of them dimmed.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "bindings.hpp"
#include "lichtmc/dimmed_scene.hpp"
#include "lichtmc/emitter_parts_file.hpp"
#include "lichtmc/error.hpp"
#include "result_parts.hpp"
#include "vectors.hpp"
#include "views.hpp"

namespace lichtmc::python {

namespace {

struct Parts {
  RunResultPtr run;

  const EmitterParts& parts() const { return *run->result.parts; }
  std::array<std::size_t, 2> shape() const { return {parts().receivers, parts().parts.size()}; }
};

struct Scene {
  RunResultPtr run;
  const DimmedScene scene;
};
using ScenePtr = std::shared_ptr<Scene>;

View<double> of_parts(const Parts& parts, double EmitterParts::Part::*member) {
  std::vector<double> values;
  for (const EmitterParts::Part& part : parts.parts().parts) values.push_back(part.*member);
  const std::size_t count = values.size();
  return owned(std::move(values), std::array<std::size_t, 1>{count});
}

View<double> irradiance(const Parts& parts) {
  const EmitterParts& all = parts.parts();
  std::vector<double> values(all.direct.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = all.direct[k] + all.reflected[k];
  return owned(std::move(values), parts.shape());
}

View<double> all_covariances(const Parts& parts) {
  const auto [receivers, count] = parts.shape();
  return owned(covariances(parts.parts()), std::array<std::size_t, 3>{receivers, count, count});
}

View<double> standard_errors(const Parts& parts) {
  const auto [receivers, count] = parts.shape();
  const std::vector<double> all = covariances(parts.parts());
  std::vector<double> errors;
  for (std::size_t k = 0; k < receivers; ++k) {
    for (std::size_t i = 0; i < count; ++i)
      errors.push_back(std::sqrt(std::max(0.0, all[(k * count + i) * count + i])));
  }
  return owned(std::move(errors), parts.shape());
}

const EmitterParts& parts_of(const RunResult& run) {
  if (!run.result.parts)
    throw InputError(
        "The result does not keep the parts of the emitters apart (allowed: results of simulate(…, per_emitter=True) "
        "without impulse_response). Simulate the room again with per_emitter=True.");
  return *run.result.parts;
}

double factor_of(nb::handle name, nb::handle value) {
  double factor = 0.0;
  if (!nb::isinstance<nb::str>(value) && nb::try_cast(value, factor)) return factor;
  throw InputError("The factor of " + std::string(nb::repr(name).c_str()) + " is " + nb::repr(value).c_str() +
                   " (allowed: a number of 0 or more). Give a number.");
}

// From a dict of names and patterns, or from one number for each part.
std::vector<double> factors_from(const EmitterParts& parts, nb::handle given) {
  if (nb::hasattr(given, "items")) {
    std::vector<DimmedEmitter> dimmed;
    for (const nb::handle item : nb::list(given.attr("items")())) {
      const nb::object name = item[0];
      if (!nb::isinstance<nb::str>(name))
        throw InputError("The name of an emitter is " + std::string(nb::repr(name).c_str()) +
                         " (allowed: a text). Give the name of an emitter or a pattern as a str.");
      dimmed.push_back({nb::cast<std::string>(name), factor_of(name, item[1])});
    }
    return factors_of(parts, dimmed);
  }
  const DoubleArray array = doubles_of(given, "array of factors");
  if (array.ndim() != 1 || array.shape(0) != parts.parts.size())
    throw InputError("The array of factors has the shape " + shape_text(array) + " (allowed: (" +
                     std::to_string(parts.parts.size()) +
                     ",), one for each of the parts). Give one number for each of result.parts.names, or a dict of "
                     "names and factors.");
  return {array.data(), array.data() + array.size()};
}

ScenePtr dim_emitters(const RunResultPtr& run, nb::object given) {
  const EmitterParts& parts = parts_of(*run);
  std::vector<Area> areas;
  for (const AreaResult& one : run->result.areas) areas.push_back(one.area);
  DimmedScene scene = dim(parts, run->result.receivers, areas, factors_from(parts, given));
  return std::make_shared<Scene>(Scene{run, std::move(scene)});
}

Measurements measurements_of_scene(const ScenePtr& scene) {
  const Result& result = scene->run->result;
  return {scene, result.quantity, &result.receivers, &scene->scene.receivers, &scene->scene.areas};
}

void bind_parts_class(nb::module_& module) {
  nb::class_<Parts>(module, "EmitterParts",
                    "The part of each emitter in the irradiance at the receivers; emitters of one name are one part. "
                    "Light is linear: with the factors f of the parts, the irradiance is parts.irradiance @ f, and "
                    "its standard error at receiver k is √(f @ parts.covariance[k] @ f). R receivers (with the points "
                    "of areas: parts.irradiance[area.receivers]), P parts.")
      .def("__len__", [](const Parts& parts) { return parts.parts().parts.size(); })
      .def_prop_ro(
          "names",
          [](const Parts& parts) {
            std::vector<std::string> names;
            for (const EmitterParts::Part& part : parts.parts().parts) names.push_back(part.name);
            return names;
          },
          "Names of the emitters of each part.")
      .def_prop_ro(
          "power", [](const Parts& parts) { return of_parts(parts, &EmitterParts::Part::power); }, has_owner,
          "Maintained power of the emitters of each part, W or lm, float64 (P,). A copy.")
      .def_prop_ro(
          "maintenance_factor",
          [](const Parts& parts) { return of_parts(parts, &EmitterParts::Part::maintenance_factor); }, has_owner,
          "Power over the power of new emitters, float64 (P,). A copy.")
      .def_prop_ro("irradiance", &irradiance, has_owner,
                   "Irradiance (W/m²) or illuminance (lx) at each receiver by each part, float64 (R, P): direct + "
                   "reflected. A copy.")
      .def_prop_ro("standard_error", &standard_errors, has_owner,
                   "Standard errors of irradiance, same unit, float64 (R, P). A copy. The errors of different parts "
                   "are correlated, see covariance.")
      .def_prop_ro("covariance", &all_covariances, has_owner,
                   "Covariances of the irradiances by the parts, (W/m²)² or lx², float64 (R, P, P). A copy.")
      .def_prop_ro(
          "direct", [](const Parts& parts) { return shaped(parts.run, parts.parts().direct, parts.shape()); },
          has_owner, "Irradiance without reflection, W/m² or lx, float64 (R, P). A view.")
      .def_prop_ro(
          "direct_error",
          [](const Parts& parts) { return shaped(parts.run, parts.parts().direct_error, parts.shape()); }, has_owner,
          "Standard errors of direct, independent of each other, float64 (R, P). A view.")
      .def_prop_ro(
          "reflected", [](const Parts& parts) { return shaped(parts.run, parts.parts().reflected, parts.shape()); },
          has_owner, "Irradiance reflected at least once, W/m² or lx, float64 (R, P). A view.")
      .def("__repr__", [](const Parts& parts) {
        return "EmitterParts(" + std::to_string(parts.parts().parts.size()) + " parts, " +
               std::to_string(parts.parts().receivers) + " receivers)";
      });
}

void bind_scene(nb::module_& module) {
  nb::class_<Scene>(module, "Scene", "The receivers and areas of a result with some emitters dimmed.")
      .def_prop_ro(
          "factors",
          [](const ScenePtr& scene) {
            const std::vector<double>& factors = scene->scene.factors;
            return shaped(scene, factors, std::array<std::size_t, 1>{factors.size()});
          },
          has_owner, "Factor of each part, float64 (P,).")
      .def_prop_ro(
          "power", [](const Scene& scene) { return scene.scene.power; }, "Power of all emitters, W or lm.")
      .def_prop_ro(
          "receivers", [](const ScenePtr& scene) { return ReceiverResults{measurements_of_scene(scene)}; },
          "The receivers with their figures, as Result.receivers.")
      .def_prop_ro(
          "areas", [](const ScenePtr& scene) { return AreaResults{measurements_of_scene(scene)}; },
          "The calculation areas with their figures, as Result.areas.")
      .def(
          "write",
          [](const ScenePtr& scene, nb::handle folder) {
            const std::filesystem::path path = path_of(folder, "folder");
            const nb::gil_scoped_release without_lock;
            write_scene(kept_parts(scene->run->room->room, scene->run->result), scene->scene, path);
          },
          nb::arg("folder").none(), nb::sig("def write(self, folder: str | os.PathLike[str]) -> None"),
          "Writes scene.json, receivers.csv and, with areas, areas.csv and the plans of the areas into a folder, as "
          "`lichtmc scene` does.")
      .def("__repr__", [](const ScenePtr& scene) {
        std::string text = "Scene(";
        const std::vector<EmitterParts::Part>& parts = scene->run->result.parts->parts;
        for (std::size_t p = 0; p < parts.size(); ++p)
          text += (p > 0 ? ", '" : "'") + parts[p].name + "': " + nb::repr(nb::float_(scene->scene.factors[p])).c_str();
        return text + ")";
      });
}

}  // namespace

void bind_parts(nb::module_& module) {
  bind_parts_class(module);
  bind_scene(module);
  nb::borrow<nb::class_<RunResult>>(nb::type<RunResult>())
      .def_prop_ro(
          "parts",
          [](const RunResultPtr& run) { return run->result.parts ? std::optional<Parts>(Parts{run}) : std::nullopt; },
          "The parts of the emitters at receivers and areas; None unless the run had per_emitter=True.")
      .def("dim", &dim_emitters, nb::arg("factors").none(),
           nb::sig("def dim(self, factors: collections.abc.Mapping[str, float] | numpy.typing.ArrayLike) -> Scene"),
           "The receivers and areas with some emitters dimmed, without new photons; for runs with per_emitter=True.\n\n"
           "factors: a dict of names or patterns ('desk*') and factors of 0 or more, 1 for all others; or an array "
           "(P,) in the order of parts.names.");
}

}  // namespace lichtmc::python
