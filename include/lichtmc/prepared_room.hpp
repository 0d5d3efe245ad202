// What lichtmc finds out about the surfaces of a room before any light is followed, kept for the next call.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "lichtmc/room.hpp"

namespace lichtmc {

class PreparedRoom;

// In rooms of millions of triangles, most of the time before the first photon goes into what depends on the surfaces
// alone: faces in one plane, closed shells, tiles, and the tree in which rays find triangles. inspect(), simulate() and
// write_report() compute these once if they are given the same prepared room; without one, each does so for itself.
// Each is computed when it is first needed: prepare() itself takes no time.
//
// The room must outlive the prepared room, stay where it is, and its surfaces must not change meanwhile; its emitters,
// receivers and reflectances may. threads: for this work, at most; 0: one per processor. progress: called with a
// description before each step, by the thread that needs it. Results are the same with and without, for any number of
// threads. A prepared room may be used by several threads at a time.
std::shared_ptr<PreparedRoom> prepare(const Room& room, unsigned threads = 0,
                                      std::function<void(std::string_view)> progress = {});

}  // namespace lichtmc
