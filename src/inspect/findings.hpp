// The findings of an inspection as text.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/inspect.hpp"
#include "lichtmc/room.hpp"
#include "room/enclosure.hpp"

namespace lichtmc {

// Adds the findings that follow from the facts and from the room, with its closed shells, to Inspection::findings.
void add_findings(const Room& room, const Enclosure& enclosure, Inspection& facts);

// Adds an error message as a fault; what follows its first sentence becomes the advice.
void add_fault(const std::string& message, const std::string& topic, std::vector<Finding>& findings);

// Adds the fault: light is enclosed by surfaces with reflectance 1. emitter: its name, or empty; surface: one of them.
void add_non_absorbing_enclosure(const std::string& emitter, const std::string& surface,
                                 std::vector<Finding>& findings);

}  // namespace lichtmc
