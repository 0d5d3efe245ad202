#include "output/area_json.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "output/write_areas.hpp"

namespace lichtmc {

namespace {

Json verdict_or_null(Verdict verdict) {
  return verdict == Verdict::none ? Json(nullptr) : Json(std::string(to_string(verdict)));
}

void add_figures(const AreaResult& result, Json& json) {
  const auto add = [&json](const std::string& name, const Figure& figure) {
    json[name] = number(figure.value);
    json[name + "_se"] = number(figure.standard_error);
  };
  add("em", result.mean);
  add("emin", result.minimum);
  add("emax", result.maximum);
  add("u0", result.uniformity);
  add("ud", result.diversity);
  json["target_lx"] = number_or_null(result.area.properties.target_lx);
  json["target_uniformity"] = number_or_null(result.area.properties.target_uniformity);
  json["verdict"] = verdict_or_null(result.verdict);
  json["em_verdict"] = verdict_or_null(result.mean_verdict);
  json["u0_verdict"] = verdict_or_null(result.uniformity_verdict);
  add("em_initial", result.initial_mean);
  add("emin_initial", result.initial_minimum);
  add("emax_initial", result.initial_maximum);
  json["lowest"] = number(result.lowest);
  json["lowest_at"] = vector_of(result.area.centre(result.lowest_cell));
  json["highest"] = number(result.highest);
  json["highest_at"] = vector_of(result.area.centre(result.highest_cell));
}

void add_grid(const Area& area, Json& json) {
  json["columns"] = area.columns;
  json["rows"] = area.rows;
  json["spacing"] = {number(glm::length(area.u)), number(glm::length(area.v))};
  json["corner"] = vector_of(area.corner);
  json["u"] = vector_of(area.u);
  json["v"] = vector_of(area.v);
  json["normal"] = vector_of(area.normal);
  json["margin"] = number(area.margin_m);
  json["above_floor"] = number_or_null(area.above_floor_m);
  json["cells"] = area.properties.cells;
  json["first_receiver"] = area.first_receiver;
  Json left_out = Json::array();
  for (const AreaLeftOut& some : area.left_out) left_out.push_back({{"points", some.points}, {"why", some.why}});
  json["left_out"] = std::move(left_out);
  json["notes"] = area.notes;
}

}  // namespace

Json areas_of(const Result& result) {
  Json areas = Json::array();
  const std::vector<std::string> stems = area_file_stems(result);
  for (std::size_t k = 0; k < result.areas.size(); ++k) {
    const AreaResult& one = result.areas[k];
    Json json{{"name", one.area.properties.name},
              {"role", one.area.properties.role},
              {"quantity", std::string(to_string(one.area.quantity))},
              {"points", one.area.cells.size()}};
    add_figures(one, json);
    add_grid(one.area, json);
    json["files"] = Json::array();
    for (const char* ending : area_file_endings) json["files"].push_back("areas/" + stems[k] + ending);
    areas.push_back(std::move(json));
  }
  return areas;
}

}  // namespace lichtmc
