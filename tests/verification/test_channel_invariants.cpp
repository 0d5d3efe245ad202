// What must not change impulse responses, and what they must not change: the place and the size of the room, the
// measurement of tiles, the irradiance of receivers, a limit of flights.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/channel_bins.hpp"
#include "support/channel_rooms.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Settings channel_settings(ReceiverWalk walk, double histories, std::uint64_t seed) {
  Settings settings = test::channel_settings(1e-9, 80e-9, histories, seed);
  settings.receiver_walk = walk;
  settings.channel.orders = 2;
  return settings;
}

void place(Room& room, double factor, const glm::dvec3& shift) {
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& p : surface.positions) p = factor * p + shift;
  }
  for (Emitter& emitter : room.emitters) {
    auto& point = std::get<LambertEmitter>(emitter.shape).position;
    point = factor * point + shift;
    emitter.delay_s *= factor;
  }
  for (Receiver& receiver : room.receivers) {
    receiver.position = factor * receiver.position + shift;
    receiver.area_m2 *= factor * factor;
  }
}

constexpr ReceiverWalk walks[] = {ReceiverWalk::backward, ReceiverWalk::next_event, ReceiverWalk::two_way};

}  // namespace

TEST_CASE("channels: rooms of a millionth and of a million times the size have the same bits, by all walks") {
  for (const ReceiverWalk walk : walks) {
    for (const bool partition : {false, true}) {
      Room room = partition ? partitioned_room() : barry_room();
      room.emitters[0].delay_s = 2.5e-9;
      Settings settings = channel_settings(walk, 2e4, 91);
      const ImpulseResponses own = *simulate(room, settings).channels;
      for (const double factor : {0x1p-20, 0x1p20}) {
        INFO(to_string(walk) << ", partition " << partition << ", factor " << factor);
        Room other = room;
        place(other, factor, glm::dvec3(0.0));
        Settings scaled = settings;
        *scaled.channel.bin_width_s *= factor;
        *scaled.channel.time_span_s *= factor;
        scaled.tile_edge_m *= factor;
        const ImpulseResponses found = *simulate(other, scaled).channels;
        REQUIRE(found.bins == own.bins);
        for (std::size_t order = 1; order < own.columns(); ++order) {
          const Bins a = bins_of(own, 0, 0, order);
          const Bins b = bins_of(found, 0, 0, order);
          CHECK(a.gain == b.gain);
          CHECK(a.error == b.error);
        }
        CHECK(found.channels[0].mean_delay_s.value ==
              Approx(factor * own.channels[0].mean_delay_s.value).epsilon(1e-14));
        CHECK(found.channels[0].first_arrival_s == Approx(factor * own.channels[0].first_arrival_s).epsilon(1e-14));
      }
    }
  }
}

TEST_CASE("channels: a room far from the origin has the same responses") {
  for (const ReceiverWalk walk : walks) {
    Room room = partitioned_room();
    const ImpulseResponses here = *simulate(room, channel_settings(walk, 2e5, 92)).channels;
    // Float coordinates resolve 0.5 mm there.
    place(room, 1.0, {5000.0, -300.0, 2000.0});
    const ImpulseResponses there = *simulate(room, channel_settings(walk, 2e5, 93)).channels;
    const Judgement bins = compare(against(bins_of(there, 0, 0), bins_of(here, 0, 0)));
    INFO(to_string(walk) << ": " << bins.text);
    WARN(to_string(walk) << ": " << bins.text);
    CHECK(bins.figures > 30);
    CHECK(bins.agrees);
    const Channel& a = there.channels[0];
    const Channel& b = here.channels[0];
    std::vector<Compared> figures;
    for (const auto figure : {&Channel::gain, &Channel::mean_delay_s, &Channel::rms_delay_spread_s, &Channel::beyond})
      figures.push_back({(a.*figure).value, (a.*figure).standard_error, (b.*figure).value, (b.*figure).standard_error});
    CHECK(compare(figures, Deviations::correlated).agrees);
    CHECK(a.first_arrival_s >= std::sqrt(26.25) / speed_of_light * (1.0 - 1e-6));
  }
}

TEST_CASE("channels: the irradiance of receivers and tiles is the same with and without them") {
  for (const ReceiverWalk walk : walks) {
    INFO(to_string(walk));
    Room room = partitioned_room();
    room.receivers.push_back({"other", {1.5, 0.7, 4.0}, {0.1, 1.0, 0.2}, 60.0, 1e-4});
    Settings settings = channel_settings(walk, 3e4, 94);
    const Result with = simulate(room, settings);
    settings.measured = Measured::all;
    settings.tile_edge_m = 0.5;
    const Result with_tiles = simulate(room, settings);
    CHECK(same_channels(with, with_tiles));
    settings.channel = {};
    const Result without = simulate(room, settings);
    CHECK_FALSE(without.channels);
    REQUIRE(without.tiles.size() == with_tiles.tiles.size());
    for (std::size_t k = 0; k < without.tiles.size(); ++k)
      CHECK(without.tiles[k].irradiance == with_tiles.tiles[k].irradiance);
    for (std::size_t r = 0; r < room.receivers.size(); ++r) {
      const ReceiverResult& one = without.receiver_results[r];
      const ReceiverResult& other = with.receiver_results[r];
      CHECK(one.irradiance == other.irradiance);
      CHECK(one.standard_error == other.standard_error);
      // The channel has the same digits.
      CHECK(with.channels->channels[r].gain.value == other.gain);
    }
  }
}

TEST_CASE("channels: with a limit of flights, orders above it are dark and those below it are not changed") {
  for (const ReceiverWalk walk : {ReceiverWalk::backward, ReceiverWalk::next_event}) {
    INFO(to_string(walk));
    Settings settings = channel_settings(walk, 2e5, 95);
    settings.channel.orders = 5;
    const ImpulseResponses all = *simulate(barry_room(), settings).channels;
    settings.max_bounces = 3;  // the third flight ends at the receiver, after two reflections
    const ImpulseResponses some = *simulate(barry_room(), settings).channels;
    for (std::size_t order = 1; order <= 2; ++order) {
      const Figure& a = some.order_gain[order];
      const Figure& b = all.order_gain[order];
      const Judgement verdict = compare({{a.value, a.standard_error, b.value, b.standard_error}});
      INFO("order " << order << ": " << verdict.text);
      CHECK(verdict.agrees);
      CHECK(a.value > 0.0);
    }
    for (std::size_t order = 3; order < some.columns(); ++order) {
      INFO("order " << order);
      CHECK(some.order_gain[order].value == 0.0);
      CHECK(std::isnan(some.order_first_s[order]));
    }
  }
}

TEST_CASE("channels: narrow bins add up to wide ones, for so many receivers that they are treated in blocks") {
  Room room = barry_room();
  room.emitters.push_back(lambert({1.0, 2.9, 4.0}, {0.0, -1.0, 0.0}, 3.0, 2.0));
  room.receivers.clear();
  for (int k = 0; k < 70; ++k)
    room.receivers.push_back(
        {"r" + std::to_string(k), {0.3 + 0.06 * k, 0.7, 0.4 + 0.6 * (k % 7)}, {0, 1, 0}, 70.0, 1e-4});
  for (const ReceiverWalk walk : walks) {
    INFO(to_string(walk));
    Settings settings = channel_settings(walk, 7e4, 96);
    settings.channel.per_emitter = true;
    settings.channel.orders = 3;
    settings.channel.bin_width_s = 1.6e-9;
    const ImpulseResponses wide = *simulate(room, settings).channels;
    settings.channel.bin_width_s = 1.6e-9 / 32.0;
    const ImpulseResponses narrow = *simulate(room, settings).channels;
    REQUIRE(narrow.bins == 32 * wide.bins);
    double largest = 0.0;
    double largest_difference = 0.0;
    for (std::size_t row = 0; row < narrow.h.size() / narrow.bins; ++row) {
      for (std::size_t bin = 0; bin < wide.bins; ++bin) {
        double sum = 0.0;
        for (std::size_t part = 0; part < 32; ++part) sum += narrow.h[row * narrow.bins + 32 * bin + part];
        const double other = wide.h[row * wide.bins + bin];
        largest = std::max(largest, other);
        largest_difference = std::max(largest_difference, std::abs(sum / 32.0 - other));
      }
    }
    // Scores of a round are rounded to 2⁻³² of the emitters' power over the area of all surfaces.
    CHECK(largest_difference < 1e-9 * largest);
    for (std::size_t k = 0; k < wide.channels.size(); ++k) {
      CHECK(narrow.channels[k].gain.value == wide.channels[k].gain.value);
      CHECK(narrow.channels[k].mean_delay_s.value == wide.channels[k].mean_delay_s.value);
      CHECK(narrow.channels[k].rms_delay_spread_s.standard_error == wide.channels[k].rms_delay_spread_s.standard_error);
      CHECK(narrow.channels[k].first_reflection_s == wide.channels[k].first_reflection_s);
    }
    for (std::size_t k = 0; k < wide.order_gain.size(); ++k)
      CHECK(narrow.order_gain[k].value == wide.order_gain[k].value);
  }
}
