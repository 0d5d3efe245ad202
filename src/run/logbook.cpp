#include "run/logbook.hpp"

#include <algorithm>
#include <utility>

#include "run/team_work.hpp"

namespace lichtmc {

namespace {

std::chrono::steady_clock::duration seconds(double value) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(value));
}

}  // namespace

Logbook::Logbook(const Control& control, StateData data, bool only_read)
    : control_(&control),
      data_(std::move(data)),
      only_read_(only_read),
      next_(Clock::now() + seconds(control.checkpoint_seconds)) {}

void Logbook::checkpoint(const std::function<void(StateData&)>& fill_in) {
  const Clock::time_point began = Clock::now();
  fill_in(data_);
  if (rank_of(control_->team) == 0) control_->checkpoint(State(std::make_shared<const StateData>(data_)));
  const Clock::time_point now = Clock::now();
  next_ = now + std::max(seconds(control_->checkpoint_seconds), cost_factor * (now - began));
}

State Logbook::close() {
  return State(std::make_shared<const StateData>(std::move(data_)));
}

}  // namespace lichtmc
