// Parts of the texts of findings: shares, points, sizes and lists of names, in one form for all topics.
#pragma once

#include <cstddef>
#include <string>

#include <glm/vec3.hpp>

#include "lichtmc/inspect.hpp"

namespace lichtmc {

// Adds a finding. `topic` is one of the words of Finding.
void add(Inspection& facts, Severity severity, const char* topic, std::string text, std::string advice);

std::string in_percent(double share);           // 0.5: "50 %"
std::string text_of(const glm::dvec3& point);   // "(1, 2, 3)", without a unit
std::string size_text(const glm::dvec3& size);  // "1 × 2 × 3 m"

// A list of names that shows the first few: "'a', 'b', 'c', 'd', 'e' and 4 more".
class Names {
 public:
  void add(const std::string& text);
  std::size_t count() const { return count_; }
  std::string text() const;

 private:
  std::size_t count_ = 0;
  std::string text_;
};

}  // namespace lichtmc
