// Work without Python's lock that cannot be stopped half-way: reading files, checks, grids.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>

#include "shared_room.hpp"
#include "worker.hpp"

namespace lichtmc::python {

// The outcome of work(), which runs in another thread while other Python threads go on. After Ctrl-C KeyboardInterrupt
// is raised, once the work has ended.
template <class Outcome>
Outcome aside(const std::function<Outcome()>& work) {
  return work_aside<Outcome, int>(
      [&](const std::stop_token& /*stop*/, const std::function<void(const int&)>& /*tell*/) { return work(); }, {},
      Interrupted::raises);
}

// A room that calculation areas have been added to, or other slow work been done on: change(Room&) works on a copy.
// Throws InputError if the room was changed meanwhile by another thread.
void change_aside(SharedRoom& room, const std::function<void(Room&)>& change);

// The room with the areas of its file laid out: when they are first needed, because the emitters that are added after
// reading tell which rooms are lit. If another thread changes the room meanwhile, it is the room as it was before, or
// the one in which that thread has laid them out.
std::shared_ptr<const KeptRoom> with_areas(SharedRoom& room);

}  // namespace lichtmc::python
