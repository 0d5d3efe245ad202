#include "output/area_layout_json.hpp"

#include <array>
#include <optional>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

glm::dvec3 vector_from(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

std::optional<double> optional_from(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

constexpr std::array quantities{AreaQuantity::normal, AreaQuantity::horizontal, AreaQuantity::cylindrical,
                                AreaQuantity::semicylindrical};

AreaQuantity quantity_from(const Json& json) {
  for (const AreaQuantity one : quantities) {
    if (json.get<std::string>() == to_string(one)) return one;
  }
  throw InputError("'" + json.get<std::string>() + "' is no quantity of an area");
}

}  // namespace

Json layout_of(const Area& area) {
  const AreaProperties& properties = area.properties;
  Json left_out = Json::array();
  for (const AreaLeftOut& some : area.left_out) left_out.push_back({{"why", some.why}, {"points", some.points}});
  Json outline = Json::array();
  for (const auto& line : area.outline) outline.push_back({vector_of(line[0]), vector_of(line[1])});
  return {{"name", properties.name},
          {"role", properties.role},
          {"asked_quantity", properties.quantity ? Json(std::string(to_string(*properties.quantity))) : Json(nullptr)},
          {"direction", properties.direction ? vector_of(*properties.direction) : Json(nullptr)},
          {"spacing_m", number_or_null(properties.spacing_m)},
          {"asked_margin_m", number_or_null(properties.margin_m)},
          {"cells_measured", properties.cells},
          {"target_lx", number_or_null(properties.target_lx)},
          {"target_uniformity", number_or_null(properties.target_uniformity)},
          {"quantity", std::string(to_string(area.quantity))},
          {"corner", vector_of(area.corner)},
          {"u", vector_of(area.u)},
          {"v", vector_of(area.v)},
          {"normal", vector_of(area.normal)},
          {"columns", area.columns},
          {"rows", area.rows},
          {"first_receiver", area.first_receiver},
          {"cells", area.cells},
          {"left_out", left_out},
          {"margin_m", area.margin_m},
          {"above_floor_m", number_or_null(area.above_floor_m)},
          {"outline", outline},
          {"notes", area.notes}};
}

Area area_from(const Json& layout) {
  Area area;
  AreaProperties& properties = area.properties;
  properties.name = layout.at("name").get<std::string>();
  properties.role = layout.at("role").get<std::string>();
  if (!layout.at("asked_quantity").is_null()) properties.quantity = quantity_from(layout.at("asked_quantity"));
  if (!layout.at("direction").is_null()) properties.direction = vector_from(layout.at("direction"));
  properties.spacing_m = optional_from(layout.at("spacing_m"));
  properties.margin_m = optional_from(layout.at("asked_margin_m"));
  properties.cells = layout.at("cells_measured").get<bool>();
  properties.target_lx = optional_from(layout.at("target_lx"));
  properties.target_uniformity = optional_from(layout.at("target_uniformity"));
  area.quantity = quantity_from(layout.at("quantity"));
  area.corner = vector_from(layout.at("corner"));
  area.u = vector_from(layout.at("u"));
  area.v = vector_from(layout.at("v"));
  area.normal = vector_from(layout.at("normal"));
  area.columns = layout.at("columns").get<std::uint32_t>();
  area.rows = layout.at("rows").get<std::uint32_t>();
  area.first_receiver = layout.at("first_receiver").get<std::size_t>();
  area.cells = layout.at("cells").get<std::vector<std::uint32_t>>();
  for (const Json& some : layout.at("left_out"))
    area.left_out.push_back({some.at("why").get<std::string>(), some.at("points").get<std::uint64_t>()});
  area.margin_m = layout.at("margin_m").get<double>();
  area.above_floor_m = optional_from(layout.at("above_floor_m"));
  for (const Json& line : layout.at("outline"))
    area.outline.push_back({vector_from(line.at(0)), vector_from(line.at(1))});
  area.notes = layout.at("notes").get<std::vector<std::string>>();
  return area;
}

}  // namespace lichtmc
