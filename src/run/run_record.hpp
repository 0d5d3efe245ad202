// The record of a run: its state, continued from earlier sessions, and the schedule of checkpoints
// (Control::checkpoint).
//
// Checkpoints come every Control::checkpoint_seconds, but take less than a hundredth of the time: the interval to the
// next one is at least 125 times the time of the last. Before the first, its time is estimated from its size.
#pragma once

#include <chrono>
#include <functional>

#include "lichtmc/simulate.hpp"
#include "run/state_data.hpp"

namespace lichtmc {

class RunRecord {
 public:
  // data: of an earlier session, or new. Control must outlive the record. only_read: no histories are simulated that
  // the state does not contain.
  RunRecord(const Control& control, StateData data, bool only_read);

  StateData& data() { return data_; }
  const StateData& data() const { return data_; }
  bool only_read() const { return only_read_; }

  // Whether a checkpoint is due. Any thread may call this.
  bool due() const { return control_->checkpoint && Clock::now() >= next_; }

  // Sets the expected size of the state in bytes. Not while threads call due().
  void expect(double bytes);

  // Updates the data by `fill_in`, and calls back. Not while threads call due().
  void checkpoint(const std::function<void(StateData&)>& fill_in);

  // Adds a further cost of the last checkpoint in s, which delays the next one. Not while threads call due().
  void add_cost(double seconds);

  // Time of all checkpoints so far, s.
  double spent() const { return spent_; }

  // The state at the end; the record is empty afterwards.
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
