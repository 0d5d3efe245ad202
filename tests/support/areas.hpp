// Calculation areas for tests, with all points of their grid.
#pragma once

#include <cstdint>
#include <string>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/lichtmc.hpp"

namespace lichtmc::test {

// Adds an area with a grid of columns × rows cells of the edges u and v, and its receivers, to a room.
inline Area& add_area(Room& room, const std::string& name, const glm::dvec3& corner, const glm::dvec3& u,
                      const glm::dvec3& v, std::uint32_t columns, std::uint32_t rows, const glm::dvec3& normal,
                      bool cells = false) {
  Area area;
  area.properties.name = name;
  area.properties.cells = cells;
  area.quantity = AreaQuantity::normal;
  area.corner = corner;
  area.u = u;
  area.v = v;
  area.normal = normal;
  area.columns = columns;
  area.rows = rows;
  area.first_receiver = room.receivers.size();
  for (std::uint32_t cell = 0; cell < columns * rows; ++cell) {
    area.cells.push_back(cell);
    Receiver receiver;
    receiver.name = name + "_" + std::to_string(cell % columns) + "_" + std::to_string(cell / columns);
    receiver.position = area.centre(cell);
    receiver.normal = normal;
    if (cells) {
      receiver.cell_u = u;
      receiver.cell_v = v;
    }
    room.receivers.push_back(receiver);
  }
  room.areas.push_back(area);
  return room.areas.back();
}

}  // namespace lichtmc::test
