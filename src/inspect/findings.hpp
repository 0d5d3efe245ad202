// What was found in a room, in words.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/inspect.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Adds everything that the facts and the room itself say to Inspection::findings.
void add_findings(const Room& room, Inspection& facts);

// A fault that an error message says, with what to do in its last sentence.
void add_fault(const std::string& message, const std::string& topic, std::vector<Finding>& findings);

// Light is shut in by surfaces that reflect all of it.
void add_trap(std::vector<Finding>& findings);

}  // namespace lichtmc
