// Whether numbers and indices of unpacked rooms and results fit each other, so that no work and no view reads outside of
// their lists.
#pragma once

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc::python {

bool is_consistent(const Room& room);

// Of a result of this room, without its state.
bool is_consistent(const Result& result, const Room& room);

}  // namespace lichtmc::python
