#include "aside.hpp"

#include <utility>

#include "lichtmc/error.hpp"
#include "lichtmc/lay_areas.hpp"

namespace lichtmc::python {

namespace {

Room changed_copy(const KeptRoom& before, const std::function<void(Room&)>& change) {
  return aside<Room>([&] {
    Room copy = before.room;
    change(copy);
    return copy;
  });
}

}  // namespace

void change_aside(SharedRoom& room, const std::function<void(Room&)>& change) {
  const auto before = room.kept();
  Room changed = changed_copy(*before, change);
  if (room.kept() != before)
    throw InputError("The room " + before->room.source +
                     " was changed by another thread meanwhile (allowed: one change at a time). Use a lock, or give "
                     "each thread a copy() of the room.");
  room.replace(std::move(changed));
}

std::shared_ptr<const KeptRoom> with_areas(SharedRoom& room) {
  const auto before = room.kept();
  if (before->room.area_requests.empty()) return before;
  Room changed = changed_copy(*before, lay_areas);
  if (room.kept() == before) room.replace(std::move(changed));
  if (room.room().area_requests.empty()) return room.kept();
  // Not laid out again: a thread that goes on changing the room could keep this one from ever ending.
  return std::make_shared<const KeptRoom>(std::move(changed));
}

}  // namespace lichtmc::python
