// Impulse responses by photons from the emitters and by walks from the receivers, in a room with everything: an
// opening, a wall with two sides, a reflectance that varies, a luminous surface, a spot, delays.
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/channel_bins.hpp"
#include "support/channel_rooms.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "support/two_sided_wall.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Settings channel_settings(ReceiverWalk walk, double histories, std::uint64_t seed) {
  Settings settings = test::channel_settings(0.5e-9, 60e-9, histories, seed);
  settings.receiver_walk = walk;
  settings.channel.orders = 2;
  return settings;
}

// Bins of the orders 1, 2, of those above and of all of each channel, and the figures of all channels. Order 0 of the
// same room has the same digits: no walk takes part.
void check_same(const std::string& what, const ImpulseResponses& a, const ImpulseResponses& b, std::size_t least_bins) {
  REQUIRE(a.channels.size() == b.channels.size());
  constexpr std::size_t enough = 5;  // bins for chi-square
  std::size_t compared = 0;
  std::vector<Compared> figures;
  const auto add = [&](const Figure& one, const Figure& other) {
    figures.push_back({one.value, one.standard_error, other.value, other.standard_error});
  };
  for (std::size_t e = 0; e < a.emitters.size(); ++e) {
    for (std::size_t r = 0; r < a.receivers.size(); ++r) {
      const std::string pair = what + ", " + a.emitters[e] + " to " + a.receivers[r];
      for (std::size_t order = 1; order < a.columns(); ++order) {
        const std::vector<Compared> bins = against(bins_of(a, e, r, order), bins_of(b, e, r, order));
        if (bins.size() >= enough) check(pair + ", order " + a.order_name(order), compare(bins));
        add(a.order_gain[a.pair(e, r) * a.columns() + order], b.order_gain[b.pair(e, r) * b.columns() + order]);
      }
      // Where there is a line of sight its bin has the error of the rest, which is far below a tenth of it.
      const std::vector<Compared> all = against(bins_of(a, e, r), bins_of(b, e, r));
      if (all.size() >= enough) check(pair, compare(all));
      compared += all.size();
      const Channel& one = a.channels[a.pair(e, r)];
      const Channel& other = b.channels[b.pair(e, r)];
      for (const auto figure :
           {&Channel::diffuse, &Channel::diffuse_mean_delay_s, &Channel::diffuse_rms_delay_spread_s, &Channel::beyond})
        add(one.*figure, other.*figure);
    }
  }
  const Judgement verdict = compare(figures, Deviations::correlated);
  WARN(what << ": " << compared << " bins; " << verdict.text);
  check(what + ", figures", verdict);
  CHECK(compared >= least_bins);
}

// 4 m × 3 m × 5 m without one wall, with a chequered partition, a panel that shines down, a spot, and a lamp behind
// the partition whose light is late.
Room room_with_everything() {
  Room room = room_with_two_sided_wall();
  room.quantity = Quantity::radiometric;
  Surface& partition = room.surfaces[room.surfaces.size() - 2];
  partition.reflectance_map = 0;
  partition.reflectance_uvs = partition.uvs;
  room.reflectance_maps.push_back({"chequers", 2, 2, {0.9F, 0.2F, 0.3F, 0.8F}});
  partition.reflectance = mean_reflectance(room, partition);
  room.emitters = {surface_emitter(room.surfaces.size() - 1, 2.0),
                   {"spot", 1.0, SpotEmitter{{2.0, 2.5, 3.0}, {0.2, -1, 0.1}, 0.2, 0.6}},
                   lambert({1.0, 2.8, 1.0}, {0, -1, 0}, 3.0, 1.0)};
  room.emitters[2].delay_s = 3.3e-9;
  room.receivers = {{"desk", {1.5, 0.7, 3.0}, {0, 1, 0}, 75.0, 1e-4},
                    {"wall", {3.9, 1.5, 1.0}, {-1, 0.2, 0.3}, 90.0, 1e-4}};
  return room;
}

}  // namespace

TEST_CASE("channels: both walks and all estimators agree in an open room with everything") {
  const Room room = room_with_everything();
  Settings settings = channel_settings(ReceiverWalk::backward, 1.2e6, 61);
  settings.channel.per_emitter = true;
  const ImpulseResponses backward = channels_of(room, settings);
  settings.receiver_walk = ReceiverWalk::next_event;
  settings.seed = 62;
  const ImpulseResponses forward = channels_of(room, settings);
  check_same("photons", forward, backward, 500);
  // Times late by half a bin would be found.
  std::size_t found = 0;
  for (std::size_t k = 0; k < forward.channels.size(); ++k) {
    const std::size_t e = k / 2;
    const std::size_t r = k % 2;
    const Bins late = with_times(bins_of(forward, e, r), 1.0, 0.5);
    if (!compare(against(late, bins_of(backward, e, r))).agrees) ++found;
  }
  CHECK(found == forward.channels.size());
  settings.photons = 3e5;
  for (const ReceiverWalk walk : {ReceiverWalk::backward, ReceiverWalk::two_way}) {
    for (const Estimator estimator : {Estimator::collision, Estimator::absorption}) {
      settings.receiver_walk = walk;
      settings.estimator = estimator;
      ++settings.seed;
      check_same(std::string(to_string(walk)) + ", " + std::string(to_string(estimator)), channels_of(room, settings),
                 backward, 100);
    }
  }
}

TEST_CASE("channels: emitter and receiver may be exchanged, by walks from either") {
  // Both of Lambert's law: an emitter of exponent 1, a receiver of 90°. Without a partition there is a line of sight.
  Room room = room_with_everything();
  const glm::dvec3 a{3.4, 2.5, 1.0};
  const glm::dvec3 along{0.3, -1.0, 0.5};
  const glm::dvec3 b{3.2, 0.6, 3.6};
  const glm::dvec3 up{-0.2, 1.0, 0.0};
  for (const ReceiverWalk walk : {ReceiverWalk::next_event, ReceiverWalk::backward}) {
    room.emitters = {lambert(a, along, 1.0)};
    room.receivers = {{"b", b, up, 90.0, 1e-4}};
    const ImpulseResponses there = channels_of(room, channel_settings(walk, 4e5, 71));
    room.emitters = {lambert(b, up, 1.0)};
    room.receivers = {{"a", a, along, 90.0, 1e-4}};
    const ImpulseResponses back = channels_of(room, channel_settings(walk, 4e5, 72));
    CHECK(there.channels[0].line_of_sight.value > 0.0);
    CHECK(there.channels[0].line_of_sight.value == Approx(back.channels[0].line_of_sight.value).epsilon(1e-12));
    CHECK(there.channels[0].first_arrival_s == Approx(back.channels[0].first_arrival_s).epsilon(1e-12));
    check_same("exchanged, " + std::string(to_string(walk)), there, back, 80);
  }
}
