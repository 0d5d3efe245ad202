// The state of a run: its sums so far, as exact integers. It is sufficient to continue the run later and to add parts
// from other machines: the sums, and therefore all digits of the results, are those of one uninterrupted run.
//
// Histories are numbered, and each has its own random words. They are simulated in batches of 1024 (State::batch); a
// state contains whole batches only. If a run ended within a batch, that batch is simulated again when results are
// computed, which takes a millisecond.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/fingerprint.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc {

// Histories first … last − 1.
struct HistoryRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;

  bool operator==(const HistoryRange&) const = default;
};

struct StateData;  // internal

// A value: copies share their immutable data.
class State {
 public:
  static constexpr std::uint32_t batch = 1024;  // histories

  State() = default;  // of no run
  explicit State(std::shared_ptr<const StateData> data) : data_(std::move(data)) {}

  bool empty() const { return data_ == nullptr; }

  // For a state that is not empty:
  // The requested settings; max_seconds is the limit of the walking time of all sessions together.
  const Settings& settings() const;
  const Fingerprint& room() const;
  const std::string& version() const;  // version of lichtmc that made it
  const std::string& note() const;     // text given to write_state()
  // Histories of the forward walk, in order, not adjacent; empty if there was none.
  std::vector<HistoryRange> histories() const;
  // Rounds of backward walks, one from every receiver: in order, not adjacent.
  std::vector<HistoryRange> receiver_rounds() const;
  // Backward histories of all receivers together.
  std::uint64_t receiver_histories() const;
  double seconds() const;  // wall-clock time of all walks, s

  const StateData& data() const { return *data_; }

 private:
  std::shared_ptr<const StateData> data_;
};

// Throws InputError if another version of lichtmc has made the state: its scores may differ.
void check_version(const State& state);

// Adds states with the same room and settings whose histories do not overlap: the result is the state of one run of all
// these histories. Order and grouping have no influence. Gaps are allowed. Throws InputError, naming states by `names`
// (one each), if rooms, settings or versions differ, histories overlap, or a range other than the last ends within a
// batch.
State merge(const std::vector<State>& states, const std::vector<std::string>& names);

// Writes a state as HDF5 (docs/state.md has the layout) atomically: to a temporary file, flushed to the disk and
// renamed. note: text of the caller, stored in the file. Throws RuntimeError if it cannot be written.
void write_state(const State& state, const std::filesystem::path& file, std::string_view note = {});

// Reads a state. Throws InputError if the file is missing, damaged in any bit, of another layout, or its contents are
// not those of a run.
State read_state(const std::filesystem::path& file);

}  // namespace lichtmc
