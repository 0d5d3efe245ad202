// Bins of impulse responses as gains with errors, to be compared with tables and with those of other runs.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/channel.hpp"
#include "lichtmc/result.hpp"
#include "support/statistics.hpp"

namespace lichtmc::test {

// Gains per bin and their standard errors.
struct Bins {
  std::vector<double> gain;
  std::vector<double> error;
};

// The bins of one order of a channel, or of all orders together.
Bins bins_of(const ImpulseResponses& found, std::size_t emitter, std::size_t receiver,
             std::optional<std::size_t> order = std::nullopt);

// The column "total", "k0", "k1", … of a table of tests/data/channel, with its errors if it has some.
Bins bins_of(const std::map<std::string, std::vector<double>>& table, const std::string& column);

// Those bins whose errors on both sides are below a tenth of either value, so that they follow a normal law: where less
// light than expected was met, the error is that of too few paths.
std::vector<Compared> against(const Bins& found, const Bins& expected);

// What a program would have measured that makes a mistake: times longer by a factor, and later by a part of a bin. The
// light of a bin is taken as spread evenly over it.
Bins with_times(const Bins& bins, double factor, double later_bins);

// Whether all figures of two results are the same bits, and the same are not numbers.
bool same_channels(const Result& a, const Result& b);

}  // namespace lichtmc::test
