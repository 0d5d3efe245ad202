// Whether the standard errors of channels are correct: 60 short runs against the truth, figure by figure, for walks
// from the emitters and both walks combined, and with a luminous surface.
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/channel_bins.hpp"
#include "support/channel_rooms.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// A figure in many runs.
struct Tested {
  std::string name;
  double expected = 0.0;
  double expected_error = 0.0;  // common to all runs: small beside theirs
  std::vector<Figure> runs{};
};

std::vector<Compared> with_errors(const Tested& one, double factor) {
  std::vector<Compared> figures;
  for (const Figure& run : one.runs)
    figures.push_back({run.value, factor * run.standard_error, one.expected, one.expected_error});
  return figures;
}

// The probability of at least `count` of n, with the probability p each.
double binomial_tail(double count, double n, double p) {
  double term = std::pow(1.0 - p, n);
  double below = 0.0;
  for (double k = 0.0; k < count; k += 1.0) {
    below += term;
    term *= (n - k) / (k + 1.0) * p / (1.0 - p);
  }
  return 1.0 - below;
}

// The law of z = (value − truth)/error: Σ z², the largest z, and the numbers beyond 2 and 3. Errors 0.4 times
// or 2.5 times as large would be found.
void check_law(const Tested& one) {
  const auto n = static_cast<double>(one.runs.size());
  const Judgement verdict = compare(with_errors(one, 1.0));
  double beyond_2 = 0.0;
  double beyond_3 = 0.0;
  double mean = 0.0;
  double variance = 0.0;
  for (const Figure& run : one.runs) {
    const double z = std::abs(run.value - one.expected) / std::hypot(run.standard_error, one.expected_error);
    if (z > 2.0) beyond_2 += 1.0;
    if (z > 3.0) beyond_3 += 1.0;
    mean += run.value / n;
    variance += run.standard_error * run.standard_error / (n * n);
  }
  const Judgement of_mean = compare({{mean, std::sqrt(variance), one.expected, one.expected_error}});
  INFO(one.name << ": " << verdict.text << "; beyond 2: " << beyond_2 << ", beyond 3: " << beyond_3
                << "; the mean: " << of_mean.text);
  WARN(one.name << ": " << verdict.text << "; beyond 2: " << beyond_2 << ", beyond 3: " << beyond_3
                << "; the mean: " << of_mean.text);
  CHECK(verdict.agrees);
  CHECK(of_mean.agrees);
  // Of the normal law: 4.55 % and 0.27 %.
  CHECK(binomial_tail(beyond_2, n, 0.0455) > false_alarm);
  CHECK(binomial_tail(beyond_3, n, 0.0027) > false_alarm);
  CHECK_FALSE(compare(with_errors(one, 0.4)).agrees);
  CHECK_FALSE(compare(with_errors(one, 2.5)).agrees);
}

Settings channel_settings(ReceiverWalk walk, double histories, std::uint64_t seed) {
  Settings settings = settings_of(Estimator::weight, Engine::automatic, histories, seed);
  settings.measured = Measured::receivers;
  settings.receiver_walk = walk;
  settings.threads = 1;
  return settings;
}

using Reader = std::function<Figure(const ImpulseResponses&)>;

Reader of_channel(Figure Channel::*figure, std::size_t emitter = 0) {
  return [=](const ImpulseResponses& found) { return found.channels[found.pair(emitter, 0)].*figure; };
}

Reader of_response(std::size_t frequency, std::size_t emitter = 0) {
  return [=](const ImpulseResponses& found) {
    const std::size_t k = found.pair(emitter, 0) * found.frequencies_hz.size() + frequency;
    return Figure{std::abs(found.response[k]), found.magnitude_error[k]};
  };
}

Reader of_bin(std::size_t bin, std::size_t emitter = 0) {
  return [=](const ImpulseResponses& found) {
    const Bins bins = bins_of(found, emitter, 0);
    return Figure{bins.gain[bin], bins.error[bin]};
  };
}

constexpr std::uint64_t runs = 60;

void run_all(const Room& room, Settings settings, std::vector<Tested>& quantities, const std::vector<Reader>& readers) {
  const std::uint64_t first = settings.seed;
  for (settings.seed = first; settings.seed < first + runs; ++settings.seed) {
    const ImpulseResponses found = *simulate(room, settings).channels;
    for (std::size_t k = 0; k < quantities.size(); ++k) quantities[k].runs.push_back(readers[k](found));
  }
}

// The tables' gain, K, delays, delay spreads, |H| at 5 MHz and 20 MHz, bandwidths, later light and a bin.
void check_barry(ReceiverWalk walk, std::uint64_t seed) {
  const auto all = derived_reference("barry", "all");
  const auto diffuse = derived_reference("barry", "nlos");
  const auto response = read_columns(LICHTMC_TEST_DATA "/channel/barry_frequencies.csv");
  const auto table = read_columns(LICHTMC_TEST_DATA "/channel/barry_1ns.csv");
  double beyond = all.at("H0");
  for (std::size_t bin = 0; bin < 60; ++bin) beyond -= table.at("total")[bin];
  std::vector<Tested> quantities{
      {"gain", all.at("H0"), all.at("se_H0")},
      {"Rician K", all.at("K"), all.at("K") * diffuse.at("se_H0") / diffuse.at("H0")},
      {"mean delay", all.at("mean_delay_ns") * 1e-9, all.at("se_mean") * 1e-9},
      {"diffuse mean delay", diffuse.at("mean_delay_ns") * 1e-9, diffuse.at("se_mean") * 1e-9},
      {"delay spread", all.at("rms_delay_spread_ns") * 1e-9, all.at("se_rms") * 1e-9},
      {"diffuse delay spread", diffuse.at("rms_delay_spread_ns") * 1e-9, diffuse.at("se_rms") * 1e-9},
      {"|H| at 5 MHz", response.at("abs")[5], response.at("se_re")[5]},
      {"|H| at 20 MHz", response.at("abs")[20], response.at("se_re")[20]},
      {"electrical bandwidth", all.at("f3dB_el_MHz") * 1e6, all.at("se_f3dB_el") * 1e6},
      {"optical bandwidth", all.at("f3dB_opt_MHz") * 1e6, all.at("se_f3dB_opt") * 1e6},
      {"later than 60 ns", beyond, all.at("se_H0")},
      {"bin of 20 ns", table.at("total")[20], table.at("se_total")[20]}};
  const std::vector<Reader> readers{of_channel(&Channel::gain),
                                    of_channel(&Channel::rician_k),
                                    of_channel(&Channel::mean_delay_s),
                                    of_channel(&Channel::diffuse_mean_delay_s),
                                    of_channel(&Channel::rms_delay_spread_s),
                                    of_channel(&Channel::diffuse_rms_delay_spread_s),
                                    of_response(2),
                                    of_response(8),
                                    of_channel(&Channel::bandwidth_electrical_hz),
                                    of_channel(&Channel::bandwidth_optical_hz),
                                    of_channel(&Channel::beyond),
                                    of_bin(20)};
  Settings settings = channel_settings(walk, 1e4, seed);
  settings.channel.bin_width_s = 1e-9;
  settings.channel.time_span_s = 60e-9;
  settings.channel.frequencies = {0.0, 25e6, 2.5e6};
  run_all(barry_room(), settings, quantities, readers);
  for (const Tested& one : quantities) check_law(one);
}

}  // namespace

TEST_CASE("errors of channels: 60 runs by photons from the emitter") {
  check_barry(ReceiverWalk::next_event, 2000);
}

TEST_CASE("errors of channels: 60 runs by both walks combined") {
  check_barry(ReceiverWalk::two_way, 3000);
}

TEST_CASE("errors of channels: 60 runs with a luminous surface, for each emitter") {
  // A panel of 0.6 m × 0.6 m below the ceiling, and a lamp; the truth is that of a run 300 times as long.
  Room room = make_cuboid({2.0, 1.5, 2.0}, {0.3, 0.7, 0.5, 0.5, 0.5, 0.5});
  room.quantity = Quantity::radiometric;
  Surface panel = make_floor(0.6, 0.6);
  for (glm::dvec3& p : panel.positions) p += glm::dvec3(1.3, 1.45, 0.2);
  panel.name = "panel";
  room.surfaces.push_back(panel);
  room.emitters = {surface_emitter(room.surfaces.size() - 1, 1.0), lambert({0.5, 1.4, 1.5}, {0, -1, 0}, 1.0, 1.0)};
  room.receivers.push_back({"eye", {1.0, 0.4, 0.9}, {0, 1, 0}, 80.0, 1e-4});
  Settings settings = channel_settings(ReceiverWalk::backward, 1e6, 4);
  settings.channel.bin_width_s = 0.5e-9;
  settings.channel.time_span_s = 10e-9;
  settings.channel.frequencies = {0.0, 80e6, 20e6};
  settings.channel.per_emitter = true;
  std::vector<Tested> quantities;
  std::vector<Reader> readers;
  const auto add = [&](const std::string& name, const Reader& reader) {
    quantities.push_back({name});
    readers.push_back(reader);
  };
  for (std::size_t emitter = 0; emitter < 2; ++emitter) {
    const std::string from = emitter == 0 ? "panel, " : "lamp, ";
    add(from + "gain", of_channel(&Channel::gain, emitter));
    add(from + "diffuse", of_channel(&Channel::diffuse, emitter));
    add(from + "Rician K", of_channel(&Channel::rician_k, emitter));
    add(from + "mean delay", of_channel(&Channel::mean_delay_s, emitter));
    add(from + "delay spread", of_channel(&Channel::rms_delay_spread_s, emitter));
    add(from + "|H| at 80 MHz", of_response(4, emitter));
    add(from + "later than 10 ns", of_channel(&Channel::beyond, emitter));
    add(from + "bin of 7 ns", of_bin(14, emitter));
  }
  const ImpulseResponses truth = *simulate(room, settings).channels;
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    quantities[k].expected = readers[k](truth).value;
    quantities[k].expected_error = readers[k](truth).standard_error;
  }
  settings.photons = 3000;
  settings.seed = 5000;
  run_all(room, settings, quantities, readers);
  for (const Tested& one : quantities) check_law(one);
}
