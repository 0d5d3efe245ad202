// Rooms and results as bytes, exactly: for pickles, copies in other processes, and the file result.lichtmc.
//
// The bytes begin with a line of text: what they are, their layout, the version of lichtmc, their number and checksum.
// Bytes of another version are refused, as states are: its figures may differ. A change of any bit is detected before
// anything is read.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "run_result.hpp"

namespace lichtmc::python {

std::string pack(const Room& room);
// With the state.
std::string pack(const RunResult& run);
// Without the state, which is in a file of its own that begins with `seal`: the first line has its checksum.
std::string pack_beside_state(const Room& room, const Result& result, std::string_view seal);

// source: what messages call the bytes. Throw InputError if they are damaged, of another version, or something else.
Room unpack_room(std::string_view bytes, const std::string& source);
RunResult unpack_result(std::string_view bytes, const std::string& source);

struct ResultBesideState {
  Room room;
  Result result;  // without its state
};
// Nothing if the bytes belong to another state, whatever else they are.
std::optional<ResultBesideState> unpack_beside_state(std::string_view bytes, std::string_view seal,
                                                     const std::string& source);

}  // namespace lichtmc::python
