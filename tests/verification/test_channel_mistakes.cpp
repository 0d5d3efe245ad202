// Mistakes that programs for impulse responses make, and that these comparisons would find; light is never too early;
// delay spreads with the weights h² for several widths of bins.
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/channel_bins.hpp"
#include "support/channel_rooms.hpp"
#include "support/rooms.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

using Table = std::map<std::string, std::vector<double>>;

Bins with_errors(Bins bins, double factor) {
  for (double& error : bins.error) error *= factor;
  return bins;
}

Bins with_gains(Bins bins, double factor) {
  for (double& gain : bins.gain) gain *= factor;
  return bins;
}

// A program that adds up flights in whole bins: after k reflections light is early by the mean of k remainders, half a
// bin each; here in whole bins.
Bins with_floors(const Bins& bins, std::size_t reflections) {
  Bins early = bins;
  const std::size_t shift = reflections / 2;
  for (std::size_t k = 0; k < bins.gain.size(); ++k) {
    const std::size_t from = k + shift;
    early.gain[k] = from < bins.gain.size() ? bins.gain[from] : 0.0;
    early.error[k] = from < bins.gain.size() ? bins.error[from] : 0.0;
  }
  return early;
}

}  // namespace

TEST_CASE("mistakes in times, orders, gains and errors of impulse responses would be noticed") {
  const Table expected = channel_table("barry_0.2ns");
  const ImpulseResponses found = *simulate(barry_room(), channel_settings(0.2e-9, 120e-9, 1e6, 81)).channels;
  const auto diffuse = [](Bins bins, const Bins& sight) {
    for (std::size_t k = 0; k < bins.gain.size() && k < sight.gain.size(); ++k) {
      if (sight.gain[k] > 0.0) bins.gain[k] = bins.error[k] = 0.0;
    }
    return bins;
  };
  const Bins sight = bins_of(found, 0, 0, 0);
  const Bins right = diffuse(bins_of(found, 0, 0), sight);
  const Bins truth = diffuse(bins_of(expected, "total"), sight);
  const auto test = [&](const std::string& what, const Bins& mutated, const Bins& against_these, bool agrees) {
    const std::vector<Compared> figures = against(mutated, against_these);
    CHECK(figures.size() > 50);
    check(what, compare(figures), agrees);
  };
  test("right", right, truth, true);
  test("c = 3e8 m/s", with_times(right, speed_of_light / 3e8, 0.0), truth, false);
  test("late by half a bin", with_times(right, 1.0, 0.5), truth, false);
  test("late by a bin", with_times(right, 1.0, 1.0), truth, false);
  test("times from the first arrival", with_times(right, 1.0, 13.0260943 / 0.2), truth, false);
  test("twice as bright", with_gains(right, 2.0), truth, false);
  test("1 % too bright", with_gains(right, 1.01), truth, false);
  test("errors of half the size", with_errors(right, 0.5), truth, false);
  test("errors of twice the size", with_errors(right, 2.0), truth, false);
  for (std::size_t order = 2; order <= 5; ++order) {
    const std::string name = "k" + std::to_string(order);
    const Bins own = bins_of(found, 0, 0, order);
    test(name, own, bins_of(expected, name), true);
    test(name + " taken for the next", bins_of(found, 0, 0, order - 1), bins_of(expected, name), false);
    test(name + ", floors of parts", with_floors(own, order), bins_of(expected, name), false);
  }
  // Walls that are a little darker: 0.79 in place of 0.80.
  Room darker = barry_room();
  for (Surface& surface : darker.surfaces) {
    if (surface.name.rfind("wall", 0) == 0) surface.reflectance = 0.79;
  }
  const ImpulseResponses dark = *simulate(darker, channel_settings(0.2e-9, 120e-9, 1e6, 82)).channels;
  test("walls of 0.79", diffuse(bins_of(dark, 0, 0), sight), truth, false);
  // The gain finds smaller ones than the bins do.
  const double exact = derived_reference("barry", "nlos").at("H0_radiosity");
  const Figure& gain = found.channels[0].diffuse;
  check("diffuse gain", compare({{gain.value, gain.standard_error, exact, 0.0}}));
  check("diffuse gain, 0.2 % too large", compare({{1.002 * gain.value, gain.standard_error, exact, 0.0}}), false);
}

TEST_CASE("impulse responses: no light before the shortest paths, by any walk and estimator") {
  const Table arrivals = channel_table("first_arrivals");
  struct Place {
    Room room;
    std::size_t receiver;
    std::size_t row;  // of first_arrivals.csv
  };
  std::vector<Place> places{{barry_room(), 0, 0}, {cube_with_receivers(), 0, 1}, {cube_with_receivers(), 1, 2}};
  places.push_back({partitioned_room(), 0, 3});
  for (const ReceiverWalk walk : {ReceiverWalk::backward, ReceiverWalk::next_event, ReceiverWalk::two_way}) {
    for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
      for (const Place& place : places) {
        INFO(to_string(walk) << ", " << to_string(estimator) << ", row " << place.row);
        Settings settings = channel_settings(0.05e-9, 40e-9, 2e4, 83);
        settings.receiver_walk = walk;
        settings.estimator = estimator;
        const ImpulseResponses found = *simulate(place.room, settings).channels;
        // Of orders 1 and 2; higher ones cannot be shorter than order 1. Two reflections are known to 1e-6 m. Flights
        // are traced in float, whose rounding is some 1e-7 of the room's size.
        const double size_m = 6.0;
        const double one_m = arrivals.at("k1_m")[place.row];
        const double two_m = place.row == 3 ? 5.197999 : arrivals.at("k2_m")[place.row];
        for (std::size_t order = 1; order < found.columns(); ++order) {
          const double least_s = ((order == 2 ? two_m - 1e-6 : one_m) - 1e-6 * size_m) / speed_of_light;
          const double first_s = found.order_first_s[found.pair(0, place.receiver) * found.columns() + order];
          CHECK(first_s >= least_s);
          CHECK(first_s < 3.0 * least_s);
          const Bins bins = bins_of(found, 0, place.receiver, order);
          const auto dark = static_cast<std::size_t>(least_s / found.bin_width_s);
          for (std::size_t bin = 0; bin < dark; ++bin) CHECK(bins.gain[bin] == 0.0);
          // The bin of the first one has light.
          const auto first = static_cast<std::size_t>(first_s / found.bin_width_s);
          if (first < found.bins) CHECK(bins.gain[first] > 0.0);
        }
      }
    }
  }
}

TEST_CASE("impulse responses: delay spreads with the weights h², for bins of 0.2 ns, 1 ns and 5 ns") {
  const Table expected = channel_table("squared_weights");
  const auto reference = [&](std::size_t first_row, double width_ns) {
    for (std::size_t row = first_row; row < first_row + 6; ++row) {
      if (expected.at("bin_ns")[row] == width_ns) return expected.at("rms_h2_ns")[row] * 1e-9;
    }
    throw std::logic_error("no such width");
  };
  for (const double width_ns : {0.2, 1.0, 5.0}) {
    Settings settings = channel_settings(width_ns * 1e-9, 400e-9, 2e5, 84);
    settings.channel.squared_weights = true;
    settings.channel.orders = 0;
    const Channel barry = simulate(barry_room(), settings).channels->channels[0];
    const Channel partition = simulate(partitioned_room(), settings).channels->channels[0];
    // Rows 0 … 5: all light of the first room; 6 … 11: its diffuse part; 12 … 17: the other room, without a line of
    // sight. They follow from bins whose errors are below 1e-3, and are rounded to 1e-4 ns.
    std::vector<Compared> figures;
    const auto add = [&](const Figure& figure, double value) {
      figures.push_back({figure.value, figure.standard_error, value, 5e-4 * value});
    };
    add(barry.squared_rms_delay_spread_s, reference(0, width_ns));
    add(barry.squared_diffuse_rms_delay_spread_s, reference(6, width_ns));
    add(partition.squared_rms_delay_spread_s, reference(12, width_ns));
    check("bins of " + std::to_string(width_ns) + " ns", compare(figures, Deviations::correlated));
    CHECK(partition.squared_rms_delay_spread_s.value == partition.squared_diffuse_rms_delay_spread_s.value);
    // Those with the weights h are 2 to 14 times as large.
    figures[0].value = barry.rms_delay_spread_s.value;
    CHECK_FALSE(compare(figures, Deviations::correlated).agrees);
  }
}
