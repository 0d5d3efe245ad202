// The state of a run as it grows: what earlier sessions have left, what this one adds, and when to show it to the
// caller (Control::checkpoint).
//
// Checkpoints come every Control::checkpoint_seconds, but so seldom that they take less than a hundredth of the time:
// the next one is due 125 times as long after the last as that took, the first by what its size lets expect.
#pragma once

#include <chrono>
#include <functional>

#include "lichtmc/simulate.hpp"
#include "run/state_data.hpp"

namespace lichtmc {

class RunRecord {
 public:
  // data: of an earlier session, or with nothing counted. Control must outlive the logbook. only_read: nothing is to be
  // simulated that the state does not hold.
  RunRecord(const Control& control, StateData data, bool only_read);

  StateData& data() { return data_; }
  const StateData& data() const { return data_; }
  bool only_read() const { return only_read_; }

  // Whether it is time. Any thread may ask.
  bool due() const { return control_->checkpoint && Clock::now() >= next_; }

  // The state will have about so many bytes. Not while threads ask.
  void expect(double bytes);

  // Has `fill_in` bring the data up to date, and calls back. Not while threads ask.
  void checkpoint(const std::function<void(StateData&)>& fill_in);

  // What the last checkpoint has cost besides, in seconds: the next one waits longer for it. Not while threads ask.
  void add_cost(double seconds);

  // Seconds that all checkpoints have cost so far.
  double spent() const { return spent_; }

  // The state at the end; the logbook is empty then.
  State close();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int cost_factor = 125;

  const Control* control_;
  StateData data_;
  bool only_read_;
  Clock::time_point next_;
  double spent_ = 0.0;
};

}  // namespace lichtmc
