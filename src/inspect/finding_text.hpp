// Parts of the texts of findings: shares, points and sizes, in one form for all topics.
#pragma once

#include <string>

#include <glm/vec3.hpp>

#include "base/message.hpp"
#include "lichtmc/inspect.hpp"

namespace lichtmc {

// Adds a finding. `topic` is one of the words of Finding.
void add(Inspection& facts, Severity severity, const char* topic, std::string text, std::string advice);

std::string in_percent(double share);  // 0.5: "50 %"
// "1,2,3" with the separator ",".
std::string coordinates(const glm::dvec3& point, const char* separator);
std::string text_of(const glm::dvec3& point);   // "(1, 2, 3)", without a unit
std::string size_text(const glm::dvec3& size);  // "1 × 2 × 3 m"

}  // namespace lichtmc
