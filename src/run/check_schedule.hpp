// When the error of a walk is computed: after numbers of histories, or of rounds, that depend only on the
// settings and the room: a run ends at the same history for any number of threads, ranks and sessions.
#pragma once

#include <algorithm>
#include <cstdint>

namespace lichtmc {

class CheckSchedule {
 public:
  // first, last: counts of the first check and of the end of the walk. The interval between checks is 1/part of the
  // count so far, in whole units.
  CheckSchedule(std::uint64_t first, std::uint64_t last, std::uint64_t unit, std::uint64_t part)
      : next_(std::min(first, last)), last_(last), unit_(unit), part_(part) {}

  std::uint64_t next() const { return next_; }
  bool is_last() const { return next_ == last_; }
  void advance() {
    const std::uint64_t more = std::max<std::uint64_t>(1, next_ / unit_ / part_) * unit_;
    next_ = last_ - next_ > more ? next_ + more : last_;
  }
  // Skips the checks up to `done`, which an earlier session has made.
  void skip(std::uint64_t done) {
    while (next_ < done && !is_last()) advance();
  }

 private:
  std::uint64_t next_;
  std::uint64_t last_;
  std::uint64_t unit_;
  std::uint64_t part_;
};

}  // namespace lichtmc
