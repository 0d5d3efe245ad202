#include "run/run_record.hpp"

#include <algorithm>
#include <utility>

#include "run/collectives.hpp"

namespace lichtmc {

namespace {

std::chrono::steady_clock::duration seconds(double value) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(value));
}

}  // namespace

RunRecord::RunRecord(const Control& control, StateData data, bool only_read)
    : control_(&control),
      data_(std::move(data)),
      only_read_(only_read),
      next_(Clock::now() + seconds(control.checkpoint_seconds)) {}

void RunRecord::expect(double bytes) {
  constexpr double bytes_per_second =
      4e8;  // of writing to a disk of 2020; replaced by a measurement after the first checkpoint
  constexpr double negligible = 0.01;  // s: a first checkpoint that takes less is not delayed
  const double cost = bytes / bytes_per_second;
  if (cost > negligible) next_ = std::max(next_, Clock::now() + cost_factor * seconds(cost));
}

void RunRecord::checkpoint(const std::function<void(StateData&)>& fill_in) {
  const Clock::time_point began = Clock::now();
  fill_in(data_);
  if (rank_of(control_->communicator) == 0) control_->checkpoint(State(std::make_shared<const StateData>(data_)));
  const Clock::time_point now = Clock::now();
  spent_ += std::chrono::duration<double>(now - began).count();
  next_ = now + std::max(seconds(control_->checkpoint_seconds), cost_factor * (now - began));
}

void RunRecord::add_cost(double cost) {
  next_ += cost_factor * seconds(cost);
  spent_ += cost;
}

State RunRecord::close() {
  return State(std::make_shared<const StateData>(std::move(data_)));
}

}  // namespace lichtmc
