// The line of sight of luminous surfaces: its time law against quadrature in a black room, its errors, and first
// arrivals where a part of the surface is hidden.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "support/channel_bins.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// A panel that shines down, in a black room: no light but the line of sight.
Room black_room(double exponent) {
  Room room = make_cuboid({3.0, 2.5, 3.0}, uniform_reflectance(0.0));
  room.quantity = Quantity::radiometric;
  Surface panel = make_floor(1.2, 0.8);
  for (glm::dvec3& p : panel.positions) p += glm::dvec3(1.1, 2.4, 0.7);
  panel.name = "panel";
  panel.reflectance = 0.0;
  room.surfaces.push_back(panel);
  room.emitters = {surface_emitter(room.surfaces.size() - 1, 1.0, exponent)};
  room.receivers = {{"eye", {0.8, 0.9, 0.6}, {0.3, 1.0, 0.2}, 50.0, 1e-4}};
  return room;
}

Settings channel_settings(std::uint64_t seed) {
  Settings settings = settings_of(Estimator::weight, Engine::automatic, 2048, seed);
  settings.measured = Measured::receivers;
  settings.receiver_walk = ReceiverWalk::backward;
  settings.channel.bin_width_s = 0.2e-9;
  settings.channel.time_span_s = 12e-9;
  settings.channel.frequencies = {0.0, 500e6, 250e6};
  return settings;
}

// By midpoints on the panel: the power of each is 1 W over their number, with the intensity (m + 1)/(2π) cos^m θ of it.
struct Expected {
  double gain = 0.0;
  double mean_s = 0.0;
  double rms_s = 0.0;
  double magnitude = 0.0;
  std::vector<double> bins;
};

Expected quadrature(const Room& room, double exponent, const Settings& settings) {
  constexpr int n = 1500;
  const Receiver& receiver = room.receivers[0];
  const glm::dvec3 normal = glm::normalize(receiver.normal);
  const double least_cosine = std::cos(receiver.half_angle_deg * std::numbers::pi / 180.0);
  Expected sum;
  sum.bins.resize(60);
  double first = 0.0;
  double second = 0.0;
  std::complex<double> response = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const glm::dvec3 point(1.1 + 1.2 * (i + 0.5) / n, 2.4, 0.7 + 0.8 * (j + 0.5) / n);
      const glm::dvec3 way = point - receiver.position;
      const double d = glm::length(way);
      const double cosine = glm::dot(way, normal) / d;
      if (cosine < least_cosine) continue;
      const double w = 1e-4 * (exponent + 1.0) / (2.0 * std::numbers::pi) * std::pow(way.y / d, exponent) * cosine /
                       (d * d) / (double{n} * n);
      const double t = d / speed_of_light + room.emitters[0].delay_s;
      sum.gain += w;
      first += w * t;
      second += w * t * t;
      response += std::polar(w, -2.0 * std::numbers::pi * 500e6 * t);
      sum.bins[static_cast<std::size_t>(t / *settings.channel.bin_width_s)] += w;
    }
  }
  sum.mean_s = first / sum.gain;
  sum.rms_s = std::sqrt(second / sum.gain - sum.mean_s * sum.mean_s);
  sum.magnitude = std::abs(response);
  return sum;
}

}  // namespace

TEST_CASE("channels: the line of sight of a panel has the time law of its points, and its errors cover the truth") {
  for (const double exponent : {1.0, 4.0}) {
    Room room = black_room(exponent);
    room.emitters[0].delay_s = 1.7e-9;
    Settings settings = channel_settings(0);
    const Expected expected = quadrature(room, exponent, settings);
    // Midpoints: 1e-4 in bins, which end within cells; far less in integrals, but for the edge of the field of view.
    constexpr double of_bins = 1e-3;
    constexpr double of_integrals = 2e-5;
    for (const bool per_emitter : {false, true}) {
      settings.channel.per_emitter = per_emitter;
      // Errors come from 32 groups of rounds, or from as many as there are: here 10.
      settings.photons = per_emitter == (exponent == 1.0) ? 320 : 2048;
      if (per_emitter && room.emitters.size() == 1) {
        // Another channel, which changes the way to sample.
        room.emitters.push_back(lambert({0.5, 2.0, 2.0}, {0, -1, 0}, 1.0));
        room.emitters.back().name = "lamp";
      }
      std::vector<Compared> gains;
      std::vector<Compared> means;
      std::vector<Compared> spreads;
      std::vector<Compared> magnitudes;
      for (settings.seed = 1; settings.seed <= 24; ++settings.seed) {
        const Result result = simulate(room, settings);
        const ImpulseResponses& found = *result.channels;
        const Channel& channel = found.channels[0];
        const auto add = [&](std::vector<Compared>& to, double value, double error, double truth) {
          to.push_back({value, error, truth, of_integrals * truth});
        };
        add(gains, channel.line_of_sight.value, channel.line_of_sight.standard_error, expected.gain);
        add(means, channel.mean_delay_s.value, channel.mean_delay_s.standard_error, expected.mean_s);
        add(spreads, channel.rms_delay_spread_s.value, channel.rms_delay_spread_s.standard_error, expected.rms_s);
        add(magnitudes, std::abs(found.response[2]), found.magnitude_error[2], expected.magnitude);
        CHECK(channel.gain.value == channel.line_of_sight.value);
        CHECK(channel.diffuse.value == 0.0);
        if (!per_emitter) CHECK(channel.gain.value == result.receiver_results[0].gain);
        std::vector<Compared> bins;
        for (std::size_t k = 0; k < found.bins; ++k) {
          const double gain = found.h[k] * found.bin_width_s;
          if (expected.bins[k] == 0.0) CHECK(gain == 0.0);
          if (expected.bins[k] > 0.01 * expected.gain)
            bins.push_back(
                {gain, found.standard_error[k] * found.bin_width_s, expected.bins[k], of_bins * expected.bins[k]});
        }
        // They add up to the gain.
        const Judgement verdict = compare(bins, Deviations::correlated);
        INFO("bins: " << verdict.text);
        CHECK(bins.size() > 3);
        CHECK(verdict.agrees);
      }
      for (const auto& [name, figures] : {std::pair("gain", &gains), std::pair("mean delay", &means),
                                          std::pair("delay spread", &spreads), std::pair("|H|", &magnitudes)}) {
        const Judgement verdict = compare(*figures);
        INFO(name << ", exponent " << exponent << (per_emitter ? ", each: " : ", all: ") << verdict.text);
        WARN(name << ", exponent " << exponent << (per_emitter ? ", each: " : ", all: ") << verdict.text);
        CHECK(verdict.agrees);
        std::vector<Compared> halved = *figures;
        for (Compared& one : halved) {
          one.standard_error *= 0.4;
          one.expected_error *= 0.4;
        }
        CHECK_FALSE(compare(halved).agrees);
      }
    }
  }
}

TEST_CASE("channels: the first arrival from a panel is exact if its nearest point is in sight, else a bound") {
  Room room = black_room(1.0);
  Settings settings = channel_settings(9);
  // Below the panel, 1.4 m above the receiver; the nearest point is inside.
  room.receivers = {{"eye", {1.5, 1.0, 1.0}, {0, 1, 0}, 80.0, 1e-4}};
  const ImpulseResponses open = *simulate(room, settings).channels;
  CHECK(open.channels[0].first_arrival_is_exact);
  CHECK(open.channels[0].first_arrival_s == Approx(1.4 / speed_of_light).epsilon(1e-12));
  CHECK(open.order_first_s[0] == open.channels[0].first_arrival_s);

  // A board 0.4 m above the receiver hides all of the panel with x < 1.8 m: the nearest point left is at x = 1.8 m.
  Surface board = make_floor(2.0, 2.0);
  const double edge = 1.5 + 0.3 * 0.4 / 1.4;
  for (glm::dvec3& p : board.positions) p += glm::dvec3(edge - 2.0, 1.4, 0.0);
  board.name = "board";
  board.reflectance = 0.0;
  board.sides = Sides::both;
  room.surfaces.push_back(board);
  const Result result = simulate(room, settings);
  const ImpulseResponses& hidden = *result.channels;
  const double nearest_s = std::hypot(1.4, 0.3) / speed_of_light;
  const Channel& channel = hidden.channels[0];
  CHECK(!channel.first_arrival_is_exact);
  CHECK(channel.first_arrival_s >= nearest_s * (1.0 - 1e-6));
  CHECK(channel.first_arrival_s < nearest_s * 1.01);
  CHECK(channel.line_of_sight.value == result.receiver_results[0].direct * 1e-4);
  for (std::size_t k = 0; k < static_cast<std::size_t>(nearest_s / hidden.bin_width_s); ++k) CHECK(hidden.h[k] == 0.0);

  // All of it hidden.
  for (glm::dvec3& p : room.surfaces.back().positions) p.x += 1.0;
  const ImpulseResponses dark = *simulate(room, settings).channels;
  CHECK(std::isnan(dark.channels[0].first_arrival_s));
  CHECK(dark.channels[0].gain.value == 0.0);
  CHECK(std::isnan(dark.channels[0].mean_delay_s.value));
  CHECK(std::isnan(dark.channels[0].bandwidth_electrical_hz.value));
}

TEST_CASE("channels: a first arrival is not called exact if light may come earlier") {
  Settings settings = channel_settings(9);
  // A panel that is dark where it is nearest.
  Room room = black_room(1.0);
  room.receivers = {{"eye", {1.2, 1.0, 1.1}, {0, 1, 0}, 80.0, 1e-4}};
  room.emission_maps.push_back({"right half", 2, 1, {0.0F, 1.0F}, Wrap::clamp, Wrap::clamp});
  auto& panel = std::get<SurfaceEmitter>(room.emitters[0].shape);
  panel.emission_map = 0;
  panel.emission_uvs = room.surfaces[panel.surface].uvs;
  const Channel half = simulate(room, settings).channels->channels[0];
  CHECK(!half.first_arrival_is_exact);
  // Between the centres of the two pixels, at 1.4 m and 2.0 m, the luminance rises from 0.
  CHECK(half.first_arrival_s >= std::hypot(1.4, 0.2) / speed_of_light * (1.0 - 1e-6));
  CHECK(half.first_arrival_s < std::hypot(1.4, 0.5) / speed_of_light);

  // Two lamps on one channel; the nearer one behind a board: its light may come by the walls before that of the other.
  room = make_cuboid({3.0, 2.5, 3.0}, uniform_reflectance(0.5));
  Surface board = make_floor(0.4, 0.4);
  for (glm::dvec3& p : board.positions) p += glm::dvec3(0.8, 1.2, 0.8);
  board.name = "board";
  room.surfaces.push_back(board);
  room.emitters = {isotropic({1.0, 1.4, 1.0}), isotropic({2.9, 2.4, 2.9})};
  room.emitters[1].name = "far";
  room.receivers = {{"eye", {1.0, 0.9, 1.0}, {0, 1, 0}, 90.0, 1e-4}};
  const double far_s = std::sqrt(1.9 * 1.9 + 1.5 * 1.5 + 1.9 * 1.9) / speed_of_light;
  settings.channel.per_emitter = true;
  const Result each = simulate(room, settings);
  CHECK(!each.channels->channels[0].first_arrival_is_exact);
  CHECK(each.channels->channels[1].first_arrival_is_exact);
  CHECK(each.channels->channels[1].first_arrival_s == Approx(far_s).epsilon(1e-12));
  settings.channel.per_emitter = false;
  CHECK(!simulate(room, settings).channels->channels[0].first_arrival_is_exact);
  // Late enough it does not come before.
  room.emitters[0].delay_s = far_s;
  const Channel late = simulate(room, settings).channels->channels[0];
  CHECK(late.first_arrival_is_exact);
  CHECK(late.first_arrival_s == Approx(far_s).epsilon(1e-12));
}

TEST_CASE("channels: two panels in one channel keep their shares and their times") {
  // The second is late by more than the first takes.
  Room room = black_room(1.0);
  Surface second = make_floor(0.6, 0.6);
  for (glm::dvec3& p : second.positions) p += glm::dvec3(0.2, 2.3, 0.2);
  second.name = "second";
  second.reflectance = 0.0;
  room.surfaces.push_back(second);
  room.emitters.push_back(surface_emitter(room.surfaces.size() - 1, 3.0));
  room.emitters[0].name = "first";
  room.emitters[1].name = "second";
  room.emitters[1].delay_s = 30e-9;
  Settings settings = channel_settings(3);
  settings.channel.time_span_s = 60e-9;
  const Result all = simulate(room, settings);
  settings.channel.per_emitter = true;
  const Result each = simulate(room, settings);
  const Channel& one = each.channels->channels[0];
  const Channel& other = each.channels->channels[1];
  const Figure sum{(one.gain.value + 3.0 * other.gain.value) / 4.0, 0.0};
  CHECK(sum.value == Approx(all.channels->channels[0].gain.value).epsilon(1e-9));
  const Bins bins = bins_of(*all.channels, 0, 0);
  double early = 0.0;
  double late = 0.0;
  double early_variance = 0.0;
  double late_variance = 0.0;
  for (std::size_t k = 0; k < bins.gain.size(); ++k) {
    (k < 150 ? early : late) += bins.gain[k];
    (k < 150 ? early_variance : late_variance) += bins.error[k] * bins.error[k];
  }
  // Errors of bins, whose sum is not an error of a sum, but 0.1 % is that of the direct light.
  CHECK(early == Approx(one.gain.value / 4.0).epsilon(0.01));
  CHECK(late == Approx(3.0 * other.gain.value / 4.0).epsilon(0.01));
  CHECK(all.channels->channels[0].first_arrival_s == one.first_arrival_s);
  CHECK(other.first_arrival_s > 30e-9);
}
