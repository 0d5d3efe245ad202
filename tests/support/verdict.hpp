// Checks of verdicts: the figures of every comparison are printed, whether it agrees or not.
#pragma once

#include <string>

#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace lichtmc::test {

// agrees = false: of a mutation, which must be rejected.
inline void check(const std::string& what, const Judgement& verdict, bool agrees = true) {
  INFO(what << ": " << verdict.text);
  WARN(what << ": " << verdict.text);
  CHECK(verdict.agrees == agrees);
}

}  // namespace lichtmc::test
