// Runs in pieces: resume and merge.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/simulate.hpp"
#include "run_result.hpp"
#include "simulate.hpp"

namespace lichtmc::python {

namespace {

// The rules that are given; if none is given, those of the run, with the time that remains. A part keeps to its
// histories unless a number of photons is given: the histories after them may be in another part.
Settings rules_for(const State& state, std::optional<std::uint64_t> photons, std::optional<double> target_error,
                   std::optional<double> max_time, unsigned threads) {
  Settings rules = state.settings();
  rules.threads = threads;
  if (photons || target_error || max_time) {
    rules.target_error = target_error;
    rules.max_seconds = max_time;
    if (!rules.part || photons) rules.photons = photons.value_or(no_photon_limit);
  } else if (rules.max_seconds) {
    constexpr double at_once = 1e-9;
    rules.max_seconds = std::max(*rules.max_seconds - state.seconds(), at_once);
  }
  return rules;
}

std::vector<std::string> names_of(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count; ++k) names.push_back("results[" + std::to_string(k) + "]");
  return names;
}

// What is missing in a sum of parts, which only makes the errors larger; a sentence or two each.
std::vector<std::string> gaps_in(const std::vector<State>& parts, const State& sum) {
  std::vector<std::string> notes;
  const auto note = [&notes](const std::vector<HistoryRange>& ranges, const std::string& what) {
    for (std::size_t k = 1; k < ranges.size(); ++k)
      notes.push_back("No part contains the " + what + " " + std::to_string(ranges[k - 1].last) + " to " +
                      std::to_string(ranges[k].first - 1) + "; the result is valid without them.");
  };
  note(sum.histories(), "histories");
  note(sum.receiver_rounds(), "backward histories from the receivers of the rounds");
  if (sum.receiver_histories() == 0) return notes;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts[k].receiver_histories() == 0)
      notes.push_back(names_of(k + 1).back() +
                      " has no histories of the receivers, but other parts have: it was stopped before them. The "
                      "result is valid without them. Resume that part, then merge again.");
  }
  return notes;
}

}  // namespace

void bind_continue(nb::module_& module) {
  module.def(
      "resume",
      [](const RunResultPtr& run, std::optional<std::uint64_t> photons, std::optional<double> target_error,
         std::optional<double> max_time, unsigned threads, nb::object progress) {
        const Settings rules = rules_for(run->result.state, photons, target_error, max_time, threads);
        return run_aside(run->room, threads, std::move(progress), [&](const Control& control) {
          return resume(run->room->room, run->result.state, rules, control);
        });
      },
      nb::arg("result"), nb::arg("photons").none(), nb::arg("target_error").none(), nb::arg("max_time").none(),
      nb::arg("threads"), nb::arg("progress").none(), "See lichtmc.resume(), which documents the arguments.");
  module.def(
      "merge",
      [](const std::vector<RunResultPtr>& results, unsigned threads, nb::object progress) {
        if (results.empty())
          throw InputError("There are no results to merge (allowed: one or more). Give the results of the parts.");
        std::vector<State> states;
        for (const RunResultPtr& run : results) states.push_back(run->result.state);
        const State sum = merge(states, names_of(states.size()));
        const auto merged = run_aside(
            results.front()->room, threads, std::move(progress),
            [&](const Control& control) { return result_of(results.front()->room->room, sum, threads, control); },
            Interrupted::raises);
        return std::make_pair(merged, gaps_in(states, sum));
      },
      nb::arg("results"), nb::arg("threads"), nb::arg("progress").none(),
      "The merged result, and what is missing in it. See lichtmc.merge(), which documents the arguments.");
}

}  // namespace lichtmc::python
