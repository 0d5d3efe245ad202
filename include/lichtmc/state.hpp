// The state of a run: what it has counted so far, as exact integers. Enough to go on with it later, and to add the
// runs of other machines to it: the sums, and so every digit of the results, are those of one uninterrupted run.
//
// Histories are numbered, and every one draws random words of its own. They are simulated in batches of 1024
// (State::batch); a state holds whole batches only. Where a run ended within one, that batch is simulated again when
// results are made, in a millisecond.
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

struct StateData;  // the library's own

// A value: copies share what they hold, which does not change any more.
class State {
 public:
  static constexpr std::uint32_t batch = 1024;  // histories

  State() = default;  // of no run
  explicit State(std::shared_ptr<const StateData> data) : data_(std::move(data)) {}

  bool empty() const { return data_ == nullptr; }

  // Of a state that is not empty:
  // As the run was asked for; max_seconds is the walking time of all sessions together.
  const Settings& settings() const;
  const Fingerprint& room() const;
  const std::string& version() const;  // of lichtmc that made it
  const std::string& note() const;     // what write_state() was given
  // Histories from the emitters to the tiles, in order, apart from each other; none where no photon was counted.
  std::vector<HistoryRange> histories() const;
  // Rounds of walks back, one from every receiver: in order, apart from each other.
  std::vector<HistoryRange> receiver_rounds() const;
  // Histories back from the receivers, all together.
  std::uint64_t receiver_histories() const;
  double seconds() const;  // wall-clock time that it took, of all walks

  const StateData& data() const { return *data_; }

 private:
  std::shared_ptr<const StateData> data_;
};

// Throws InputError where another version of lichtmc has made the state: it may count differently.
void check_version(const State& state);

// Adds states of one room and one setting whose histories do not overlap: those of one run that simulates all of them.
// Order and grouping do not matter. Gaps are allowed. Throws InputError, naming states by `names` (one each), where
// rooms, settings or versions differ, histories overlap, or one that is not the last ends within a batch.
State merge(const std::vector<State>& states, const std::vector<std::string>& names);

// Writes a state as HDF5 (docs/state.md has the layout): to a temporary file, flushed to the disk and renamed, so that
// there is the old file or the new one whatever happens. note: of the caller, kept with it. Throws RuntimeError where
// it cannot be written.
void write_state(const State& state, const std::filesystem::path& file, std::string_view note = {});

// Reads it. Throws InputError where the file is missing, damaged in any bit, or of another layout.
State read_state(const std::filesystem::path& file);

}  // namespace lichtmc
