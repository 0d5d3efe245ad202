// The rooms of tests/data/channel, and its tables.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lichtmc/channel.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc::test {

// Configuration A of Barry 1993: 5 m × 3 m × 5 m, emitter "lamp" of 1 W in the middle of the ceiling, receiver "eye" of
// 1 cm² on the floor.
Room barry_room(double half_angle_deg = 85.0);

// The unit cube of the paper with ρ = 0.6 and the receivers "centre" and "corner" of 1 m² on the floor.
Room cube_with_receivers();

// 6 m × 2.7 m × 5 m, with a partition between the emitter and the receiver.
Room partitioned_room();

// Of receivers only, with the weight estimator and the orders 0 … 5.
Settings channel_settings(double width_s, double span_s, double histories, std::uint64_t seed);

ImpulseResponses channels_of(const Room& room, const Settings& settings);

// A table of tests/data/channel, by its name without ".csv".
std::map<std::string, std::vector<double>> channel_table(const std::string& name);

// The columns of a table of numbers, by the names in its first line that does not begin with #. Words and empty fields
// are NaN.
std::map<std::string, std::vector<double>> read_columns(const std::string& file);

// A row of derived.csv, by the names of its columns: room "barry", "cube_centre", "cube_corner" or "partition", set
// "all" or "nlos". NaN where a figure does not exist.
std::map<std::string, double> derived_reference(const std::string& room, const std::string& set);

}  // namespace lichtmc::test
