#include "aside.hpp"

#include <utility>

#include "lichtmc/error.hpp"
#include "lichtmc/lay_areas.hpp"

namespace lichtmc::python {

void change_aside(SharedRoom& room, const std::function<void(Room&)>& change) {
  const auto before = room.kept();
  Room changed = aside<Room>([&] {
    Room copy = before->room;
    change(copy);
    return copy;
  });
  if (room.kept() != before)
    throw InputError("The room " + before->room.source +
                     " was changed by another thread meanwhile (allowed: one change at a time). Use a lock, or give "
                     "each thread a copy() of the room.");
  room.replace(std::move(changed));
}

const SharedRoom& with_areas(SharedRoom& room) {
  if (!room.room().area_requests.empty()) change_aside(room, [](Room& changed) { lay_areas(changed); });
  return room;
}

}  // namespace lichtmc::python
