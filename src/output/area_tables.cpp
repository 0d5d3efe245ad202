#include "output/area_tables.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/csv.hpp"
#include "base/message.hpp"
#include "output/table_rows.hpp"

namespace lichtmc {

namespace {

std::string text_or_empty(const std::optional<double>& value) {
  return value ? to_text(*value) : std::string();
}

// A block of the grid's values: heading, then a row of the table for each row of the grid.
void append_grid(std::string& table, const AreaDrawing& drawing, std::string_view heading,
                 const std::vector<double>& values) {
  table += '\n' + std::string(heading) + '\n';
  table += "down \\ right (m)";
  const auto place = [](double cell, std::size_t k) { return decimal(cell * (static_cast<double>(k) + 0.5), 4); };
  for (std::size_t column = 0; column < drawing.columns; ++column) table += ',' + place(drawing.cell.x, column);
  table += '\n';
  for (std::size_t row = 0; row < drawing.rows; ++row) {
    table += place(drawing.cell.y, row);
    for (std::size_t column = 0; column < drawing.columns; ++column) {
      const std::size_t k = row * drawing.columns + column;
      table += ',' + (drawing.has_point[k] ? to_text(values[k]) : std::string());
    }
    table += '\n';
  }
}

}  // namespace

std::string areas_csv(const Result& result) {
  std::string table =
      "area,role,quantity,points,left_out,em,em_se,emin,emin_se,emax,emax_se,u0,u0_se,ud,target_lx,target_uniformity,"
      "verdict,ud_se,em_verdict,u0_verdict,em_initial,emin_initial,emax_initial,lowest,highest,unit\n";
  for (const AreaResult& one : result.areas) {
    const AreaProperties& properties = one.area.properties;
    std::uint64_t left_out = 0;
    for (const AreaLeftOut& some : one.area.left_out) left_out += some.points;
    append_row(table, csv_field(properties.name), csv_field(properties.role), to_string(one.area.quantity),
               std::to_string(one.area.cells.size()), std::to_string(left_out), to_text(one.mean.value),
               to_text(one.mean.standard_error), to_text(one.minimum.value), to_text(one.minimum.standard_error),
               to_text(one.maximum.value), to_text(one.maximum.standard_error), to_text(one.uniformity.value),
               to_text(one.uniformity.standard_error), to_text(one.diversity.value),
               text_or_empty(properties.target_lx), text_or_empty(properties.target_uniformity), to_string(one.verdict),
               to_text(one.diversity.standard_error), to_string(one.mean_verdict), to_string(one.uniformity_verdict),
               to_text(one.initial_mean.value), to_text(one.initial_minimum.value), to_text(one.initial_maximum.value),
               to_text(one.lowest), to_text(one.highest), irradiance_unit(result.quantity));
  }
  return table;
}

std::string area_grid_csv(const Result& result, std::size_t k, const AreaDrawing& drawing) {
  const AreaResult& one = result.areas[k];
  const glm::dvec3 corner = drawing.upper_left(one.area);
  const auto place = [](const glm::dvec3& p) { return to_text(p.x) + ',' + to_text(p.y) + ',' + to_text(p.z); };
  const std::string unit(irradiance_unit(result.quantity));
  std::string table;
  append_row(table, "area", csv_field(one.area.properties.name));
  append_row(table, "role", csv_field(one.area.properties.role));
  append_row(table, "quantity", to_string(one.area.quantity));
  append_row(table, "upper left corner (x y z in m)", place(corner));
  append_row(table, "right (x y z)", place(drawing.right));
  append_row(table, "down (x y z)", place(drawing.down));
  append_grid(table, drawing, std::string(irradiance_word(result.quantity)) + " (" + unit + ")", drawing.values);
  append_grid(table, drawing, "standard error (" + unit + ")", drawing.errors);
  return table;
}

}  // namespace lichtmc
