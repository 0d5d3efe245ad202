#include <cmath>
#include <set>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "room/room_check.hpp"

namespace lichtmc {

namespace {

[[noreturn]] void refuse_area(const Room& room, const Area& area, const std::string& what, const std::string& value,
                              const std::string& allowed) {
  throw InputError("The " + what + " of the calculation area " + in_quotes(area.properties.name) + " in " +
                   room.source + " is " + value + " (allowed: " + allowed +
                   "). Let lay_areas() make the areas of a room.");
}

void check_grid_of(const Room& room, const Area& area) {
  const std::uint64_t cells = std::uint64_t{area.columns} * area.rows;
  if (cells == 0 || cells > 0xFFFFFFFF)
    refuse_area(room, area, "number of cells", std::to_string(cells), "1 to 4294967295");
  const double size = glm::length(area.u) * glm::length(area.v);
  const double place = glm::length(area.corner) + glm::length(area.normal);
  if (!(size > 0.0) || !std::isfinite(size) || !std::isfinite(place))
    refuse_area(room, area, "size in m² of a cell", to_text(size), "a finite number above 0, at a finite place");
}

void check_points_of(const Room& room, const Area& area) {
  const std::size_t points = area.cells.size();
  if (points == 0 || area.first_receiver > room.receivers.size() ||
      points > room.receivers.size() - area.first_receiver)
    refuse_area(room, area, "number of points", std::to_string(points),
                "1 to the number of receivers from its first one");
  for (std::size_t k = 0; k < points; ++k) {
    const bool ascending = k == 0 || area.cells[k] > area.cells[k - 1];
    if (!ascending || area.cells[k] >= area.columns * area.rows)
      refuse_area(room, area, "cell number " + std::to_string(k), std::to_string(area.cells[k]),
                  "numbers of cells, ascending");
  }
}

}  // namespace

void check_areas(const Room& room) {
  std::set<std::string> names;
  for (const Area& area : room.areas) {
    if (!names.insert(area.properties.name).second)
      throw InputError("There are two calculation areas with the name " + in_quotes(area.properties.name) + " in " +
                       room.source + " (allowed: one of each name). Rename one.");
    check_grid_of(room, area);
    check_points_of(room, area);
  }
}

}  // namespace lichtmc
