// What the program measures: rows of its table.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "measure.hpp"

namespace lichtmc::bench {

struct Options {
  bool json = false;
  bool quick = false;
  std::string only;
  int turns() const { return quick ? 5 : 9; }
  double impacts() const { return quick ? 2e6 : 1e7; }
};

struct Measured {
  std::string what;
  double value = 0.0;
  std::optional<double> bar;  // none: only measured
  bool at_least = true;       // else at most
  std::string unit;           // empty for a ratio
  nlohmann::ordered_json details;
  bool reached() const { return !bar || (at_least ? value >= *bar : value <= *bar); }
};

inline nlohmann::ordered_json details_of(const Ratio& ratio, const char* first, const char* second) {
  return {{first, ratio.first}, {second, ratio.second}, {"ratios", ratio.ratios}};
}

}  // namespace lichtmc::bench
