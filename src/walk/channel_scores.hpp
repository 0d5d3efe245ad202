// The scores of impulse responses: for one thread and a block of receivers, round by round.
//
// A round's scores of a bin are added in double, in a fixed order; at the end of the round their sum becomes an
// integer, whose square is added too: standard errors follow from the differences between rounds, as those of receivers
// do. Scores of walks from receivers are collected first, those of photons are added while the round is open.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "base/large_pages.hpp"
#include "base/wide.hpp"
#include "lichtmc/room.hpp"
#include "walk/channel_axes.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

struct ChannelSums;

// Units of the integers: 2⁻³² of the emitters' power over the area of all surfaces, and a length of about the room's
// size, a power of two (m). A score is at most 2⁵⁴ units: the squares of 2²⁰ of these stay below 2¹²⁸.
struct ChannelScale {
  explicit ChannelScale(const Room& room);
  static constexpr double largest_score = 0x1p54;

  double unit = 1.0;  // W/m² or lx
  double length_m = 1.0;
};

// Light that a walk from a receiver has found.
struct Arrival {
  std::uint32_t receiver = 0;  // number within the block
  std::uint32_t emitter = 0;   // index into Room::emitters
  std::uint32_t order = 1;     // number of reflections
  double length_m = 0.0;       // of the path, without delay
  double irradiance = 0.0;     // W/m² or lx
};

// The path of a photon to an impact.
struct ImpactPath {
  glm::dvec3 point{0.0};      // m, world
  double length_m = 0.0;      // up to the impact, with the delay of the emitter
  std::uint32_t emitter = 0;  // index into Room::emitters
  std::uint32_t order = 1;    // number of reflections, with that at the impact
};

class ChannelScores {
 public:
  // A bin in the open round and over all rounds.
  struct alignas(32) Cell {
    double open = 0.0;  // W/m² or lx
    std::uint64_t sum = 0;
    uint128 squares = 0;

    void add(std::uint64_t score) {
      sum += score;
      squares += static_cast<uint128>(score) * score;
    }
  };

  // receivers: of the block; order: their numbers in the order of its lanes. The axes must outlive this.
  ChannelScores(const ChannelAxes& axes, const ChannelScale& scale, const ReferencePoint* receivers,
                const std::vector<std::uint32_t>& order);

  // Rounds first_round … first_round + rounds − 1 follow, in turn.
  void begin(std::uint64_t first_round, std::size_t rounds);
  // Light for round first_round + r: in an order that depends on the receiver alone.
  void collect(std::size_t r, const Arrival& arrival) {
    Arrivals& all = arrivals_[r];
    if (all.size == all.list.size()) all.list.resize(2 * all.size + 64);
    all.list[all.size++] = arrival;
  }

  // Opens round first_round + r with the arrivals collected for it.
  void open(std::size_t r);
  // What an impact sends to the receivers at positions begin … end − 1 of the lanes: irradiances in units of `unit`,
  // value[k] for position begin + k.
  void add_impact(const ImpactPath& path, std::size_t begin, std::size_t end, const float* value, double unit);
  void close();

  // Adds the sums to those of all receivers, of which `first` is the first of the block, and clears them. capped:
  // receives the number of scores beyond the largest.
  void hand_over(std::size_t first, ChannelSums& sums, std::uint64_t& capped);

 private:
  struct Touched {
    std::uint32_t row;
    std::uint32_t bin;
  };
  // The bins of a row that are not 0: low … high.
  struct Range {
    std::uint32_t low = 0xFFFFFFFF;
    std::uint32_t high = 0;
  };

  std::uint32_t bin_of(double length_m) const;
  void add(std::size_t position, std::uint32_t group, std::uint32_t column, double length_m, double irradiance);
  void touch(std::size_t row, std::uint32_t bin, double irradiance);
  void add_response(std::size_t pair, double length_m, double irradiance);
  std::uint64_t units(double irradiance);
  uint128 wide_units(double moment);
  void close_moments(std::uint32_t jackknife);
  void close_response(std::uint32_t jackknife);
  void hand_over_row(std::size_t position, std::uint32_t group, std::uint32_t column, std::size_t first,
                     ChannelSums& sums);
  void hand_over_groups(std::size_t from, std::size_t to, ChannelSums& sums);

  // Of a dense array [group][what][position].
  double* dense(std::vector<double>& array, std::size_t group, std::size_t what, std::size_t number_of_whats) const {
    return array.data() + (group * number_of_whats + what) * whole_;
  }

  const ChannelAxes* axes_;
  ChannelScale scale_;
  std::vector<std::uint32_t> number_;    // of the receiver at each position of the lanes
  std::size_t size_;                     // receivers
  std::size_t whole_;                    // the same in whole lanes
  std::vector<std::uint32_t> position_;  // of each receiver in the lanes
  std::vector<double> x_, y_, z_;        // m, world, by position

  std::uint64_t first_round_ = 0;
  std::uint64_t round_ = 0;  // that is open
  struct Arrivals {          // of a round: the first `size` of the list
    std::vector<Arrival> list;
    std::size_t size = 0;
  };
  std::vector<Arrivals> arrivals_;

  // By pair and column, of positions in place of receivers.
  std::vector<Cell, LargePages<Cell>> cells_;
  std::vector<Range> ranges_;
  std::vector<Cell> column_cells_;  // of all times
  std::vector<Touched> touched_;
  // Of the open round: Σ w, Σ w L, Σ w L².
  std::vector<double> moments_;   // [group][which][position]
  std::vector<double> earliest_;  // [group][column][position], of all rounds
  std::vector<double> column_;    // [group][column][position]: Σ w, only if there are several columns
  std::vector<std::uint32_t> bin_;
  std::vector<double> length_;
  // Sums over rounds, as in ChannelSums.
  std::vector<uint128> moment_sums_;
  std::vector<std::uint64_t> coarse_;
  std::vector<double> response_;  // [pair][frequency]: real parts, then imaginary ones
  std::vector<int128> response_sums_;
  std::vector<std::uint32_t> responded_;  // pairs whose response the round has changed
  std::vector<std::uint8_t> has_responded_;
  std::uint64_t capped_ = 0;
};

}  // namespace lichtmc
