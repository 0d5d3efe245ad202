#include <algorithm>
#include <system_error>
#include <utility>

#include "base/message.hpp"
#include "base/names.hpp"
#include "lichtmc/emitter_parts_file.hpp"
#include "lichtmc/error.hpp"
#include "output/area_json.hpp"
#include "output/folder.hpp"
#include "output/json.hpp"
#include "output/tables.hpp"
#include "output/write_areas.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

namespace {

// As far as tables and plans need it.
Result result_of_scene(const KeptParts& kept, const DimmedScene& scene) {
  Result result;
  result.room = kept.room;
  result.quantity = kept.quantity;
  result.settings.measured = Measured::receivers;
  result.receivers = kept.receivers;
  result.receiver_results = scene.receivers;
  result.areas = scene.areas;
  return result;
}

}  // namespace

std::vector<double> factors_of(const EmitterParts& parts, const std::vector<DimmedEmitter>& dimmed) {
  std::vector<double> factors(parts.parts.size(), 1.0);
  std::vector<const DimmedEmitter*> given(factors.size(), nullptr);
  for (const DimmedEmitter& one : dimmed) {
    bool any = false;
    for (std::size_t p = 0; p < factors.size(); ++p) {
      if (!matches_pattern(one.name, parts.parts[p].name)) continue;
      if (given[p] != nullptr)
        throw InputError("Emitter " + in_quotes(parts.parts[p].name) + " gets two factors, from " +
                         in_quotes(given[p]->name) + " and " + in_quotes(one.name) +
                         " (allowed: one). Leave one out, or use narrower patterns.");
      given[p] = &one;
      factors[p] = one.factor;
      any = true;
    }
    if (any) continue;
    std::vector<std::string> names;
    for (const EmitterParts::Part& part : parts.parts) names.push_back(part.name);
    throw InputError("There is no emitter " + in_quotes(one.name) + " in the results (allowed: " +
                     nearest_names(one.name, std::move(names)) + "). Give one of these names, or a pattern.");
  }
  return factors;
}

std::string scene_json(const KeptParts& kept, const DimmedScene& scene) {
  Json json{{"room", kept.room},
            {"unit", std::string(power_unit(kept.quantity))},
            {"emitted", number(scene.power)},
            {"emitters", Json::array()}};
  for (std::size_t p = 0; p < scene.factors.size(); ++p) {
    const EmitterParts::Part& part = kept.parts.parts[p];
    json["emitters"].push_back({{"name", part.name},
                                {"factor", number(scene.factors[p])},
                                {"power", number(scene.factors[p] * part.power)},
                                {"maintenance_factor", number(part.maintenance_factor)}});
  }
  json["areas"] = areas_of(result_of_scene(kept, scene));
  return json.dump(2) + "\n";
}

void write_scene(const KeptParts& kept, const DimmedScene& scene, const fs::path& folder) {
  std::error_code unknown;
  if (fs::exists(folder / "summary.json", unknown))
    throw InputError("The folder " + in_quotes(folder.string()) +
                     " holds the results of a run (allowed: another folder, so that its tables are not replaced). Give "
                     "--output a new folder.");
  make_folder(folder);
  const Result result = result_of_scene(kept, scene);
  StagedFiles staged(folder);
  staged.write("receivers.csv", [&](const Sink& sink) { write_receivers_csv(result, sink); });
  write_areas(kept.section, result, staged);
  staged.write("scene.json", scene_json(kept, scene));
  staged.flush();
  remove_old(folder / "scene.json");
  remove_old_areas(result, folder);
  staged.publish("scene.json");
}

}  // namespace lichtmc
