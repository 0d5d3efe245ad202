// The light that reaches a receiver from the emitters without reflection, with its path lengths.
//
// A point emitter has one path, which is exact. An area light is sampled in independent sets of stratified points and
// flights (area_light_sampling.hpp): their differences give the errors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "chance/stream.hpp"
#include "lichtmc/room.hpp"
#include "walk/channel_axes.hpp"
#include "walk/direct_light.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

// A path from an emitter to a receiver.
struct SightPath {
  std::uint32_t group = 0;  // of emitters, see ChannelAxes
  double length_m = 0.0;    // with the delay of the emitter
  double irradiance = 0.0;  // W/m² or lx; of a sampled path: its part of the mean of its set
  static constexpr std::uint32_t exact = 0xFFFFFFFF;
  std::uint32_t set = exact;  // 0 … jackknife_groups − 1 of a sampled path
};

// The first light without reflection, of each group of emitters.
struct FirstSight {
  double length_m = std::numeric_limits<double>::infinity();  // with the delay; infinite: none
  bool exact = false;                                         // else a bound from above
};

struct LineOfSight {
  std::vector<SightPath> paths;
  std::vector<FirstSight> first;  // of each group
};

// Of a receiver; `number` selects the random words of its samples. Not of cells.
LineOfSight line_of_sight(const Room& room, const ChannelAxes& axes, const DirectLight& light, const Tracer& tracer,
                          const ReferencePoint& receiver, const Stream& stream, std::uint64_t number);

}  // namespace lichtmc
