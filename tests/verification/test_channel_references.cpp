// Impulse responses against the reference tables of tests/data/channel, bin by bin and order by order, and the figures
// derived from them.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/channel_bins.hpp"
#include "support/channel_rooms.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

using Columns = std::map<std::string, std::vector<double>>;

// The bins of one order (its number, or "all") of the only emitter. Before the first light of the table there is none;
// of the bins after it those whose error is small enough for a normal law are compared: where less light than expected
// was met, the error is that of too few paths.
std::vector<Compared> bins_against(const ImpulseResponses& found, std::size_t receiver, const std::string& order,
                                   const Columns& expected, std::size_t shift = 0) {
  const std::string column = order == "all" ? "total" : order == "6+" ? "k6plus" : "k" + order;
  const bool all = order == "all";
  const std::size_t number = all ? 0 : order == "6+" ? 6 : std::stoul(order);
  const Bins ours = bins_of(found, 0, receiver, all ? std::nullopt : std::optional(number));
  const Bins theirs = bins_of(expected, column);
  const std::vector<double>& sight = expected.at("k0");
  const auto first_light = std::find_if(theirs.gain.begin(), theirs.gain.end(), [](double gain) { return gain > 0.0; });
  std::vector<Compared> figures;
  for (std::size_t bin = 0; bin < std::min(found.bins, theirs.gain.size()); ++bin) {
    const double gain = ours.gain[bin];
    const double own = ours.error[bin];
    // The line of sight is compared apart.
    if (all && (sight[bin] > 0.0 || found.h[found.row(0, receiver, 0) + bin] > 0.0)) continue;
    if (theirs.gain.begin() + static_cast<std::ptrdiff_t>(bin) < first_light && shift == 0) {
      INFO("order " << order << ", bin " << bin);
      CHECK(gain == 0.0);
    }
    if (bin < shift) continue;
    constexpr double small = 0.1;
    const double expectation = theirs.gain[bin - shift];
    const double error = theirs.error[bin - shift];
    if (own > 0.0 && own < small * std::min(gain, expectation) && error < small * expectation)
      figures.push_back({gain, own, expectation, error});
  }
  return figures;
}

void check_orders(const std::string& what, const ImpulseResponses& found, std::size_t receiver,
                  const Columns& expected) {
  REQUIRE(found.orders == 5);
  for (const char* order : {"all", "1", "2", "3", "4", "5", "6+"})
    check(what + ", order " + order, compare(bins_against(found, receiver, order, expected)));
}

// The gain, delays, delay spreads and bandwidths, of all light and of the diffuse part.
void check_derived(const std::string& room, const ImpulseResponses& found, std::size_t receiver) {
  const Channel& channel = found.channels[found.pair(0, receiver)];
  const auto all = derived_reference(room, "all");
  const auto diffuse = derived_reference(room, "nlos");
  constexpr double ns = 1e-9;
  std::vector<Compared> figures;
  const auto add = [&](const Figure& figure, double unit, double expected, double error) {
    figures.push_back({figure.value / unit, figure.standard_error / unit, expected, error});
  };
  add(channel.gain, 1.0, all.at("H0"), all.at("se_H0"));
  add(channel.diffuse, 1.0, diffuse.at("H0"), diffuse.at("se_H0"));
  add(channel.mean_delay_s, ns, all.at("mean_delay_ns"), all.at("se_mean"));
  add(channel.rms_delay_spread_s, ns, all.at("rms_delay_spread_ns"), all.at("se_rms"));
  add(channel.diffuse_mean_delay_s, ns, diffuse.at("mean_delay_ns"), diffuse.at("se_mean"));
  add(channel.diffuse_rms_delay_spread_s, ns, diffuse.at("rms_delay_spread_ns"), diffuse.at("se_rms"));
  if (all.at("K") > 0.0) add(channel.rician_k, 1.0, all.at("K"), all.at("K") * diffuse.at("se_H0") / diffuse.at("H0"));
  for (const auto& [figure, name] :
       {std::pair(channel.bandwidth_electrical_hz, "el"), std::pair(channel.bandwidth_optical_hz, "opt")}) {
    const double expected = all.at("f3dB_" + std::string(name) + "_MHz");
    INFO("bandwidth " << name);
    CHECK(std::isnan(figure.value) == std::isnan(expected));
    if (!std::isnan(expected)) add(figure, 1e6, expected, all.at("se_f3dB_" + std::string(name)));
  }
  check(room + ", derived figures", compare(figures, Deviations::correlated));
}

}  // namespace

TEST_CASE("impulse responses: configuration A of Barry, by order, with both tracers") {
  const Columns expected = channel_table("barry_0.2ns");
  Settings settings = channel_settings(0.2e-9, 120e-9, 1e6, 11);
  SECTION("closed form") {
    settings.engine = Engine::cuboid;
  }
  SECTION("Embree") {
    settings.engine = Engine::embree;
    settings.photons = 400'000;
  }
  const Result result = simulate(barry_room(), settings);
  const ImpulseResponses& found = *result.channels;
  check_orders("Barry", found, 0, expected);

  // The line of sight: (m + 1) A cos φ cos ψ/(2π d²), in the bin of its time, and nowhere else.
  const double squared = 15.25;
  const double gain = 1e-4 * 9.0 / (3.14159265358979323846 * squared * squared);
  for (std::size_t bin = 0; bin < found.bins; ++bin)
    CHECK(found.h[bin] * found.bin_width_s == (bin == 65 ? Approx(gain).epsilon(1e-12) : Approx(0.0)));
  CHECK(found.channels[0].line_of_sight.value == Approx(gain).epsilon(1e-12));
  CHECK(found.channels[0].line_of_sight.standard_error == 0.0);
}

TEST_CASE("impulse responses: all walks and estimators give those of configuration A") {
  const Columns expected = channel_table("barry_1ns");
  for (const ReceiverWalk walk : {ReceiverWalk::backward, ReceiverWalk::next_event, ReceiverWalk::two_way}) {
    for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
      Settings settings = channel_settings(1e-9, 120e-9, 2e5, 12);
      settings.receiver_walk = walk;
      settings.estimator = estimator;
      const ImpulseResponses found = *simulate(barry_room(), settings).channels;
      const std::string what = std::string(to_string(walk)) + ", " + std::string(to_string(estimator));
      for (const char* order : {"all", "2"}) check(what, compare(bins_against(found, 0, order, expected)));
    }
  }
}

TEST_CASE("impulse responses: another speed of light, or times late by a bin, would be noticed") {
  const Columns expected = channel_table("barry_1ns");
  const ImpulseResponses right = *simulate(barry_room(), channel_settings(1e-9, 120e-9, 1e6, 13)).channels;
  CHECK(compare(bins_against(right, 0, "all", expected)).agrees);
  CHECK(!compare(bins_against(right, 0, "all", expected, 1)).agrees);
  // Bins as wide as if light went 300 000 km in a second.
  Settings settings = channel_settings(1e-9 * 3e8 / speed_of_light, 120e-9, 1e6, 13);
  const ImpulseResponses wrong = *simulate(barry_room(), settings).channels;
  CHECK(!compare(bins_against(wrong, 0, "all", expected)).agrees);
}

TEST_CASE("impulse responses: gains by order, and what is later than the time span") {
  const auto shares = read_columns(LICHTMC_TEST_DATA "/channel/truncation.csv").at("share_of_H0");
  const double whole = derived_reference("barry", "all").at("H0");
  Settings settings = channel_settings(1e-9, 120e-9, 1e6, 14);
  settings.channel.orders = 8;
  const ImpulseResponses found = *simulate(barry_room(), settings).channels;
  // Rows 9 … 15 of the table: up to 0, 1, … 6 reflections. Shares have six decimals.
  constexpr std::size_t up_to_0 = 9;
  std::vector<Compared> figures;
  for (std::size_t k = 1; k <= 6; ++k) {
    const Figure& gain = found.order_gain[k];
    figures.push_back({gain.value, gain.standard_error, whole * (shares[up_to_0 + k] - shares[up_to_0 + k - 1]),
                       whole * std::hypot(7e-7, 1e-5 * (shares[up_to_0 + k] - shares[up_to_0 + k - 1]))});
  }
  check("orders", compare(figures));
  // 120 ns: row 5. The figures of all times do not depend on the span.
  const Channel& channel = found.channels[0];
  CHECK(
      compare({{channel.beyond.value, channel.beyond.standard_error, whole * (1.0 - shares[5]), whole * 7e-7}}).agrees);
  double in_bins = 0.0;
  for (std::size_t bin = 0; bin < found.bins; ++bin) in_bins += found.h_all[bin] * found.bin_width_s;
  CHECK(in_bins + channel.beyond.value == Approx(channel.gain.value).epsilon(1e-9));
  double of_orders = 0.0;
  for (const Figure& gain : found.order_gain) of_orders += gain.value;
  CHECK(of_orders == Approx(channel.gain.value).epsilon(1e-9));

  settings.channel.time_span_s = 10e-9;
  const ImpulseResponses cut = *simulate(barry_room(), settings).channels;
  CHECK(std::all_of(cut.h_all.begin(), cut.h_all.end(), [](double h) { return h == 0.0; }));
  CHECK(cut.channels[0].beyond.value == Approx(channel.gain.value).epsilon(1e-9));
  CHECK(cut.channels[0].rms_delay_spread_s.value == channel.rms_delay_spread_s.value);
  CHECK(cut.channels[0].mean_delay_s.value == channel.mean_delay_s.value);
}

TEST_CASE("impulse responses: the cube of the paper at two points of its floor") {
  constexpr double tenth_s = 0.1 / speed_of_light;
  Settings settings = channel_settings(tenth_s, 120 * tenth_s, 1e6, 15);
  settings.channel.frequencies = {0.0, 400e6, 1e6};
  const ImpulseResponses found = *simulate(cube_with_receivers(), settings).channels;
  check_orders("centre", found, 0, channel_table("cube_centre_0.1m"));
  check_orders("corner", found, 1, channel_table("cube_corner_0.1m"));
  check_derived("cube_centre", found, 0);
  check_derived("cube_corner", found, 1);
}

TEST_CASE("impulse responses: a partition that blocks the line of sight") {
  Settings settings = channel_settings(1e-9, 120e-9, 4e5, 16);
  settings.channel.frequencies = {0.0, 50e6, 0.5e6};
  const ImpulseResponses found = *simulate(partitioned_room(), settings).channels;
  check_orders("partition", found, 0, channel_table("partition_1ns"));
  check_derived("partition", found, 0);
  const Channel& channel = found.channels[0];
  CHECK(channel.line_of_sight.value == 0.0);
  CHECK(channel.line_of_sight.standard_error == 0.0);
  CHECK(!channel.first_arrival_is_exact);
  // Over the ceiling: √(4² + 0.8² + 3.1²) m. No earlier light but by rounding; late by less than 0.1 ns.
  const double shortest_s = std::sqrt(26.25) / speed_of_light;
  CHECK(channel.first_arrival_s > shortest_s * (1.0 - 1e-12));
  CHECK(channel.first_arrival_s < shortest_s + 0.1e-9);
  CHECK(channel.first_reflection_s == channel.first_arrival_s);
}

TEST_CASE("impulse responses: figures derived for configuration A, and its frequency response") {
  Settings settings = channel_settings(1e-9, 400e-9, 1e6, 17);
  const Columns expected = channel_table("barry_frequencies");
  settings.channel.frequencies = {0.0, 200e6, 1e6};
  const ImpulseResponses found = *simulate(barry_room(), settings).channels;
  check_derived("barry", found, 0);
  REQUIRE(found.frequencies_hz.size() == expected.at("abs").size());
  std::vector<Compared> magnitudes;
  for (std::size_t f = 0; f < found.frequencies_hz.size(); ++f) {
    CHECK(found.frequencies_hz[f] == Approx(1e6 * expected.at("f_MHz")[f]));
    magnitudes.push_back({std::abs(found.response[f]), found.magnitude_error[f], expected.at("abs")[f],
                          std::hypot(expected.at("se_re")[f], expected.at("se_im")[f])});
  }
  check("|H(f)|", compare(magnitudes, Deviations::correlated));

  // From bins of 1 ns and 400 ns: the same at low frequencies. With the weights h² the reference follows from bins of
  // an error below 5.5e-4; the error of their mean square is smaller.
  settings.channel.frequencies = {};
  settings.channel.squared_weights = true;
  const ImpulseResponses binned = *simulate(barry_room(), settings).channels;
  CHECK(binned.from_bins);
  check_derived("barry", binned, 0);
  const Figure& all = binned.channels[0].squared_rms_delay_spread_s;
  const Figure& diffuse = binned.channels[0].squared_diffuse_rms_delay_spread_s;
  check("weights h²", compare({{all.value, all.standard_error, 3.5284e-9, 3.5284e-9 * 5.5e-4},
                               {diffuse.value, diffuse.standard_error, 12.1103e-9, 12.1103e-9 * 5.5e-4}},
                              Deviations::correlated));
}

TEST_CASE("impulse responses: first arrivals are exact in sight, and never too early by reflections") {
  Settings settings = channel_settings(1e-9, 120e-9, 1e6, 18);
  const ImpulseResponses found = *simulate(barry_room(), settings).channels;
  const Channel& channel = found.channels[0];
  CHECK(channel.first_arrival_is_exact);
  CHECK(channel.first_arrival_s == Approx(std::sqrt(15.25) / speed_of_light).epsilon(1e-12));
  CHECK(channel.mean_excess_delay_s.value ==
        Approx(channel.mean_delay_s.value - channel.first_arrival_s).epsilon(1e-12));
  // One reflection at the wall x = 0, 4.5 m; two, 4.689104 m (to 1e-6 m).
  const double one_s = 4.5 / speed_of_light;
  CHECK(found.order_first_s[1] > one_s * (1.0 - 1e-12));
  CHECK(found.order_first_s[1] < one_s + 1e-12);
  CHECK(channel.first_reflection_s == found.order_first_s[1]);
  CHECK(found.order_first_s[2] > (4.689104 - 2e-6) / speed_of_light);
  CHECK(found.order_first_s[3] > one_s);
}

TEST_CASE("impulse responses: a sphere with an emitter in its centre, in closed form") {
  // Inside a sphere every flight ends everywhere with the same density: orders and their times are independent of the
  // place. A receiver of 1 m² gets 1/4π of what the table has for the wall.
  Room room;
  room.quantity = Quantity::radiometric;
  room.surfaces.push_back(make_sphere(160));
  room.surfaces[0].reflectance = 0.9;
  room.emitters.push_back(isotropic({0.0, 0.0, 0.0}));
  const Surface& wall = room.surfaces[0];
  double volume = 0.0;
  for (const glm::uvec3& t : wall.triangles)
    volume += std::abs(glm::dot(wall.positions[t.x], glm::cross(wall.positions[t.y], wall.positions[t.z]))) / 6.0;
  // Flights in the mesh are shorter by this factor, in the mean (4V/S).
  const double shorter = 3.0 * volume / surface_area(wall);
  CHECK(shorter > 0.9995);
  const glm::uvec3& place = wall.triangles[wall.triangles.size() / 2 + 11];
  const glm::dvec3 middle = (wall.positions[place.x] + wall.positions[place.y] + wall.positions[place.z]) / 3.0;
  room.receivers.push_back({"wall", middle, -middle});

  Settings settings = channel_settings(0.1 / speed_of_light, 20.0 / speed_of_light, 1e5, 19);
  settings.receiver_walk = ReceiverWalk::backward;
  const ImpulseResponses found = *simulate(room, settings).channels;
  Columns expected = channel_table("sphere_0.9");
  for (auto& [name, column] : expected) {
    if (name.front() == 'p') continue;  // path lengths
    for (double& power : column) power /= 4.0 * 3.14159265358979323846;
  }
  for (const char* order : {"all", "1", "2", "3", "5"})
    check("sphere, order " + std::string(order), compare(bins_against(found, 0, order, expected, 0)));
  const Channel& channel = found.channels[0];
  const auto derived = channel_table("sphere_derived");
  const std::size_t row = 5;  // ρ = 0.9
  REQUIRE(derived.at("rho")[row] == 0.9);
  std::vector<Compared> figures;
  const auto add = [&](const Figure& figure, double unit, double value) {
    figures.push_back({figure.value / unit, figure.standard_error / unit, value, (1.0 - shorter) * value});
  };
  add(channel.gain, 1.0, derived.at("H0_per_m2_receiver")[row]);
  add(channel.rician_k, 1.0, derived.at("K_rician")[row]);
  add(channel.mean_delay_s, 1e-9, derived.at("mean_delay_ns")[row]);
  add(channel.rms_delay_spread_s, 1e-9, derived.at("rms_delay_spread_ns")[row]);
  check("sphere, derived figures", compare(figures, Deviations::correlated));
}

TEST_CASE("impulse responses: 200 runs differ from the truth by what their errors say") {
  const auto all = derived_reference("barry", "all");
  const auto diffuse = derived_reference("barry", "nlos");
  // h of all orders in the bin of 20 ns to 21 ns too.
  const double bin = channel_table("barry_1ns").at("total")[20] / 1e-9;
  Settings settings = channel_settings(1e-9, 60e-9, 1e4, 0);
  settings.receiver_walk = ReceiverWalk::backward;
  settings.channel.orders = 0;
  settings.channel.frequencies = {0.0, 20e6, 1e6};
  settings.threads = 1;
  struct Quantity {
    const char* name;
    double expected;
    std::vector<Compared> runs{};
  };
  std::vector<Quantity> quantities{{"gain", all.at("H0")},
                                   {"K", all.at("K")},
                                   {"mean delay", all.at("mean_delay_ns") * 1e-9},
                                   {"delay spread", all.at("rms_delay_spread_ns") * 1e-9},
                                   {"diffuse delay spread", diffuse.at("rms_delay_spread_ns") * 1e-9},
                                   {"electrical bandwidth", all.at("f3dB_el_MHz") * 1e6},
                                   {"optical bandwidth", all.at("f3dB_opt_MHz") * 1e6},
                                   {"bin", bin}};
  const Room room = barry_room();
  for (settings.seed = 1000; settings.seed < 1200; ++settings.seed) {
    const ImpulseResponses found = *simulate(room, settings).channels;
    const Channel& channel = found.channels[0];
    const Figure of_bin{found.h_all[20], found.standard_error_all[20]};
    std::size_t k = 0;
    for (const Figure& figure :
         {channel.gain, channel.rician_k, channel.mean_delay_s, channel.rms_delay_spread_s,
          channel.diffuse_rms_delay_spread_s, channel.bandwidth_electrical_hz, channel.bandwidth_optical_hz, of_bin}) {
      const double expected = quantities[k].expected;
      quantities[k++].runs.push_back({figure.value, figure.standard_error, expected, 0.0});
    }
  }
  for (const Quantity& one : quantities) {
    check(std::string(one.name) + " in 200 runs", compare(one.runs));
    // All runs too high, or too low, by a part of their errors: a bias.
    double mean = 0.0;
    double variance = 0.0;
    for (const Compared& run : one.runs) {
      mean += run.value / 200.0;
      variance += run.standard_error * run.standard_error / (200.0 * 200.0);
    }
    check(std::string(one.name) + ", mean of 200 runs", compare({{mean, std::sqrt(variance), one.expected, 0.0}}));
  }
}
