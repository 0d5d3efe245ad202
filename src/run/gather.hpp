// Backward walks from many origins (receivers, or faces of tiles): direct light → walks → stop rule → sums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "run/run_record.hpp"
#include "run/stop_watch.hpp"
#include "walk/backward.hpp"
#include "walk/direct_light.hpp"

namespace lichtmc {

// Thrown where a stop comes before there is anything to tell.
class StoppedTooSoon : public RuntimeError {
 public:
  using RuntimeError::RuntimeError;
};

// The direct light of every origin, found by all threads of all members of a team. direct(k, count) is called once for
// each k below `origins`; rays are counted in `traced`. Throws StoppedTooSoon where the watch says stop before all are
// done.
using DirectOf = std::function<DirectIrradiance(std::size_t, TraceCount&)>;
std::vector<DirectIrradiance> direct_light_of(std::size_t origins, const DirectOf& direct, const Control& control,
                                              unsigned threads, StopWatch& watch, TraceCount& traced);

// What walks from some origins have found.
struct Gathered {
  std::vector<DirectIrradiance> direct;             // per origin
  std::shared_ptr<std::vector<BackwardSums>> sums;  // per origin, of all rounds
  std::uint64_t rounds = 0;                         // per origin
  std::uint32_t group = 1;                          // walks in a round
  double unit = 1.0;                                // of the sums, W/m² or lx
  BackwardCount count;
  double direct_seconds = 0.0;  // integrating direct light, in this session
  StopReason stopped_by = StopReason::photons;
  Estimator estimator = Estimator::collision;                             // as used
  std::string choice;                                                     // why, where it was chosen
  double histories_to_target = std::numeric_limits<double>::quiet_NaN();  // as Result::histories_to_target
  std::vector<ConvergencePoint> convergence;

  std::uint64_t histories() const { return rounds * group * sums->size(); }
  // Irradiance that reached origin k reflected, and its standard error: NaN where fewer than two rounds were simulated.
  double indirect(std::size_t k) const;
  double indirect_error(std::size_t k) const;
};

struct GatherTask {
  Progress::Stage stage = Progress::Stage::receivers;
  std::size_t origins = 0;
  std::uint32_t group = 1;  // as make_walk's origins have
  double unit = 1.0;        // as make_walk's scale has
  DirectOf direct;
  std::function<std::unique_ptr<BackwardWalk>(const Settings&)> make_walk;  // one for each thread
  std::function<double(const Gathered&)> error;                             // what Settings::target_error is about
  // For Estimator::automatic: each origin's weight in the mean of squares that `error` is the root of, and what the
  // origins are called.
  std::vector<double> weights;
  std::string name;
  std::optional<BackwardState> StateData::*slot = nullptr;  // where the logbook has these walks
};

// Walks until the first stop rule is met; goes on from the walks that the logbook has, and leaves there what was found.
// Every origin gets as many walks; Settings::photons is the number of all
// together. The same settings give the same sums for any number of threads. Estimator::automatic is replaced by the one
// that does best in a pilot, see pilot.hpp. Throws StoppedTooSoon where the run is stopped before the first round is
// whole.
Gathered gather(GatherTask task, const Room& room, Settings settings, const Control& control, StopWatch& watch,
                unsigned threads, RunRecord& record);

}  // namespace lichtmc
