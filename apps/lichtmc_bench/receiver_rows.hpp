// Rows of the table: receivers, walks from receivers and tiles, impulse responses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "row.hpp"

namespace lichtmc::bench {

Measured backward_speed(const Options& options);
Measured backward_variance(const Options& options);
Measured direct_light(const Options& options);
Measured many_lamps(const Options& options);
Measured bins_to_one_percent(const Options& options);

std::vector<Measured> points_rows(const Options& options);
std::vector<Measured> channel_rows(const Options& options);

}  // namespace lichtmc::bench
