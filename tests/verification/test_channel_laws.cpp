// Laws that impulse responses obey in every room: superposition, delays, reciprocity, scale, both directions, and the
// same digits however a run is divided.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/channel_rooms.hpp"
#include "support/rooms.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Settings channel_settings(double histories, std::uint64_t seed) {
  Settings settings = test::channel_settings(1e-9, 100e-9, histories, seed);
  settings.channel.orders = 2;
  return settings;
}

// Bins of all orders, and derived figures, of independent runs. The same photons may serve several receivers: each is
// compared by itself.
void check_same(const std::string& what, const ImpulseResponses& a, const ImpulseResponses& b) {
  REQUIRE(a.h_all.size() == b.h_all.size());
  const double width = a.bin_width_s;
  for (std::size_t r = 0; r < a.receivers.size(); ++r) {
    std::vector<Compared> bins;
    for (std::size_t e = 0; e < a.emitters.size(); ++e) {
      for (std::size_t k = a.row(e, r); k < a.row(e, r) + a.bins; ++k) {
        constexpr double small = 0.1;  // so that the errors follow a normal law
        if (a.standard_error_all[k] > 0.0 && b.standard_error_all[k] > 0.0 &&
            a.standard_error_all[k] < small * a.h_all[k] && b.standard_error_all[k] < small * b.h_all[k])
          bins.push_back({width * a.h_all[k], width * a.standard_error_all[k], width * b.h_all[k],
                          width * b.standard_error_all[k]});
      }
    }
    CHECK(bins.size() > 10);
    check(what + ", bins of receiver " + std::to_string(r), compare(bins));
  }
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < a.channels.size(); ++k) {
    const auto add = [&](const Figure& one, const Figure& other) {
      figures.push_back({one.value, one.standard_error, other.value, other.standard_error});
    };
    add(a.channels[k].diffuse, b.channels[k].diffuse);
    add(a.channels[k].diffuse_mean_delay_s, b.channels[k].diffuse_mean_delay_s);
    add(a.channels[k].diffuse_rms_delay_spread_s, b.channels[k].diffuse_rms_delay_spread_s);
  }
  check(what + ", figures", compare(figures, Deviations::correlated));
}

// Two lamps and two receivers in a room with a partition.
Room two_by_two() {
  Room room = partitioned_room();
  room.emitters.front().name = "first";
  Emitter second = isotropic({4.5, 2.4, 4.0}, 2.5);
  second.name = "second";
  room.emitters.push_back(second);
  room.receivers.front().name = "near";
  room.receivers.push_back({"far", {1.0, 0.5, 1.0}, {0.0, 1.0, 0.0}, 90.0, 2e-4});
  return room;
}

}  // namespace

TEST_CASE("channels: responses of emitters add up to that of all together") {
  const Room room = two_by_two();
  Settings settings = channel_settings(1e5, 21);
  settings.channel.frequencies = {0.0, 20e6, 10e6};
  const ImpulseResponses all = channels_of(room, settings);
  settings.channel.per_emitter = true;
  const ImpulseResponses each = channels_of(room, settings);
  CHECK(all.emitters == std::vector<std::string>{"all"});
  CHECK(each.emitters == std::vector<std::string>{"first", "second"});
  CHECK(each.powers == std::vector<double>{1.0, 2.5});
  CHECK(all.powers == std::vector<double>{3.5});
  // The same paths; the sums differ by the rounding of every round to an integer.
  const auto sum = [&](double first, double second) { return (1.0 * first + 2.5 * second) / 3.5; };
  const double largest = *std::max_element(all.h_all.begin(), all.h_all.end());
  for (std::size_t r = 0; r < 2; ++r) {
    for (std::size_t order = 0; order < all.columns(); ++order) {
      for (std::size_t bin = 0; bin < all.bins; ++bin)
        CHECK(sum(each.h[each.row(0, r, order) + bin], each.h[each.row(1, r, order) + bin]) ==
              Approx(all.h[all.row(0, r, order) + bin]).epsilon(1e-9).margin(1e-12 * largest));
    }
    const Channel& whole = all.channels[r];
    const Channel& one = each.channels[each.pair(0, r)];
    const Channel& other = each.channels[each.pair(1, r)];
    CHECK(sum(one.gain.value, other.gain.value) == Approx(whole.gain.value).epsilon(1e-9));
    CHECK(sum(one.gain.value * one.mean_delay_s.value, other.gain.value * other.mean_delay_s.value) ==
          Approx(whole.gain.value * whole.mean_delay_s.value).epsilon(1e-9));
    CHECK(std::min(one.first_arrival_s, other.first_arrival_s) == whole.first_arrival_s);
    for (std::size_t f = 0; f < 3; ++f) {
      const std::complex<double> added =
          (each.response[each.pair(0, r) * 3 + f] * 1.0 + each.response[each.pair(1, r) * 3 + f] * 2.5) / 3.5;
      CHECK(std::abs(added - all.response[r * 3 + f]) < 1e-9 * whole.gain.value);
    }
  }
}

TEST_CASE("channels: emitters of one name share a channel") {
  Room room = two_by_two();
  room.emitters[1].name = "first";
  Settings settings = channel_settings(2e4, 22);
  const ImpulseResponses all = channels_of(room, settings);
  settings.channel.per_emitter = true;
  const ImpulseResponses shared = channels_of(room, settings);
  CHECK(shared.emitters == std::vector<std::string>{"first"});
  CHECK(shared.h == all.h);
  CHECK(shared.standard_error == all.standard_error);
}

TEST_CASE("channels: a delay of whole bins shifts bins and times, and changes nothing else") {
  Room room = two_by_two();
  Settings settings = channel_settings(5e4, 23);
  settings.channel.per_emitter = true;
  const ImpulseResponses before = channels_of(room, settings);
  room.emitters[1].delay_s = 7e-9;
  const ImpulseResponses after = channels_of(room, settings);
  CHECK(after.delays_s == std::vector<double>{0.0, 7e-9});
  for (std::size_t r = 0; r < 2; ++r) {
    for (std::size_t order = 0; order < before.columns(); ++order) {
      for (std::size_t bin = 0; bin < before.bins; ++bin) {
        INFO("receiver " << r << ", order " << order << ", bin " << bin);
        CHECK(after.h[after.row(0, r, order) + bin] == before.h[before.row(0, r, order) + bin]);
        const double shifted = bin < 7 ? 0.0 : before.h[before.row(1, r, order) + bin - 7];
        CHECK(after.h[after.row(1, r, order) + bin] == Approx(shifted).epsilon(1e-9));
      }
    }
    const Channel& late = after.channels[after.pair(1, r)];
    const Channel& prompt = before.channels[before.pair(1, r)];
    CHECK(late.gain.value == Approx(prompt.gain.value).epsilon(1e-12));
    CHECK(late.first_arrival_s == Approx(prompt.first_arrival_s + 7e-9).epsilon(1e-9));
    CHECK(late.mean_delay_s.value == Approx(prompt.mean_delay_s.value + 7e-9).epsilon(1e-9));
    CHECK(late.mean_excess_delay_s.value == Approx(prompt.mean_excess_delay_s.value).epsilon(1e-8));
    CHECK(late.rms_delay_spread_s.value == Approx(prompt.rms_delay_spread_s.value).epsilon(1e-6));
  }
}

TEST_CASE("channels: photons from the emitters and walks from the receivers agree bin by bin") {
  const Room room = two_by_two();
  Settings settings = channel_settings(6e5, 24);
  settings.receiver_walk = ReceiverWalk::backward;
  const ImpulseResponses backward = channels_of(room, settings);
  settings.seed = 25;
  settings.receiver_walk = ReceiverWalk::next_event;
  check_same("next-event against backward", channels_of(room, settings), backward);
  settings.seed = 26;
  settings.receiver_walk = ReceiverWalk::two_way;
  check_same("two-way against backward", channels_of(room, settings), backward);
}

TEST_CASE("channels: emitter and receiver may be exchanged") {
  // Both of Lambert's law: an emitter of exponent 1, a receiver of 90°.
  Room room = partitioned_room();
  const glm::dvec3 a{1.0, 1.5, 2.5};
  const glm::dvec3 b{5.0, 0.8, 3.3};
  const glm::dvec3 along{1.0, 0.0, 0.0};
  const glm::dvec3 up{0.0, 1.0, 0.0};
  room.emitters = {lambert(a, along, 1.0)};
  room.receivers = {{"eye", b, up, 90.0, 1e-4}};
  Settings settings = channel_settings(6e5, 27);
  settings.receiver_walk = ReceiverWalk::backward;
  const ImpulseResponses there = channels_of(room, settings);
  room.emitters = {lambert(b, up, 1.0)};
  room.receivers = {{"eye", a, along, 90.0, 1e-4}};
  settings.seed = 28;
  check_same("exchanged", channels_of(room, settings), there);
}

TEST_CASE("channels: a room twice as large has responses twice as long, to the last bit") {
  Room room = two_by_two();
  Settings settings = channel_settings(2e4, 29);
  settings.receiver_walk = ReceiverWalk::backward;
  const ImpulseResponses small = channels_of(room, settings);
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& p : surface.positions) p *= 2.0;
  }
  std::get<LambertEmitter>(room.emitters[0].shape).position *= 2.0;
  std::get<IsotropicEmitter>(room.emitters[1].shape).position *= 2.0;
  for (Receiver& receiver : room.receivers) {
    receiver.position *= 2.0;
    receiver.area_m2 *= 4.0;
  }
  *settings.channel.bin_width_s *= 2.0;
  *settings.channel.time_span_s *= 2.0;
  const ImpulseResponses large = channels_of(room, settings);
  REQUIRE(large.bins == small.bins);
  bool same = true;
  for (std::size_t k = 0; k < small.h.size(); ++k) same = same && 2.0 * large.h[k] == small.h[k];
  CHECK(same);
  for (std::size_t k = 0; k < small.channels.size(); ++k) {
    CHECK(large.channels[k].gain.value == small.channels[k].gain.value);
    CHECK(large.channels[k].mean_delay_s.value == 2.0 * small.channels[k].mean_delay_s.value);
    CHECK(large.channels[k].rms_delay_spread_s.value == 2.0 * small.channels[k].rms_delay_spread_s.value);
    CHECK(large.channels[k].first_reflection_s == 2.0 * small.channels[k].first_reflection_s);
  }
}

TEST_CASE("channels: concentrator and filter multiply all of h, the field of view ends at its half angle") {
  Room room = barry_room(60.0);
  room.receivers.push_back(room.receivers[0]);
  room.receivers[1].concentrator_index = 1.5;
  room.receivers[1].filter_gain = 0.8;
  Settings settings = channel_settings(2e5, 30);
  settings.receiver_walk = ReceiverWalk::backward;
  const Result result = simulate(room, settings);
  const ImpulseResponses& found = *result.channels;
  const double factor = 1.5 * 1.5 / 0.75 * 0.8;
  const Channel& bare = found.channels[0];
  const Channel& with = found.channels[1];
  CHECK(with.line_of_sight.value == Approx(factor * bare.line_of_sight.value).epsilon(1e-12));
  check("diffuse", compare({{with.diffuse.value, with.diffuse.standard_error, factor * bare.diffuse.value,
                             factor * bare.diffuse.standard_error}}));
  for (std::size_t r = 0; r < 2; ++r)
    CHECK(result.receiver_results[r].gain == Approx(found.channels[r].gain.value).epsilon(1e-9));
  // The lamp is at 39.8° of the receiver's normal.
  room.receivers = {{"in", {0.5, 0.0, 1.0}, {0, 1, 0}, 39.9, 1e-4}, {"out", {0.5, 0.0, 1.0}, {0, 1, 0}, 39.7, 1e-4}};
  const ImpulseResponses narrow = channels_of(room, settings);
  CHECK(narrow.channels[0].line_of_sight.value == Approx(bare.line_of_sight.value).epsilon(1e-12));
  CHECK(narrow.channels[1].line_of_sight.value == 0.0);
}

TEST_CASE("channels: the same digits for any number of threads") {
  const Room room = two_by_two();
  Settings settings = channel_settings(5e4, 31);
  settings.channel.per_emitter = true;
  settings.channel.frequencies = {0.0, 20e6, 10e6};
  settings.threads = 1;
  const ImpulseResponses one = channels_of(room, settings);
  settings.threads = 3;
  const ImpulseResponses three = channels_of(room, settings);
  CHECK(one.h == three.h);
  CHECK(one.standard_error == three.standard_error);
  CHECK(one.response == three.response);
  CHECK(one.magnitude_error == three.magnitude_error);
  for (std::size_t k = 0; k < one.channels.size(); ++k) {
    CHECK(one.channels[k].rms_delay_spread_s.value == three.channels[k].rms_delay_spread_s.value);
    CHECK(one.channels[k].rms_delay_spread_s.standard_error == three.channels[k].rms_delay_spread_s.standard_error);
  }
}

TEST_CASE("channels: an area light's line of sight is spread over the distances to its points") {
  // A luminous ceiling of 4 m × 4 m, 2 m above the receiver in the middle of the floor: from 2 m to √12 m.
  Room room = make_cuboid({4.0, 2.0, 4.0}, uniform_reflectance(0.5));
  room.emitters.push_back(surface_emitter(surface_number(room, "ceiling"), 1.0));
  room.receivers.push_back({"eye", {2.0, 0.0, 2.0}, {0, 1, 0}, 90.0, 1e-4});
  Settings settings = channel_settings(1e5, 32);
  settings.channel.bin_width_s = 1.0 / speed_of_light;  // 1 m
  const Result result = simulate(room, settings);
  const ImpulseResponses& found = *result.channels;
  CHECK(found.channels[0].line_of_sight.value == Approx(result.receiver_results[0].direct * 1e-4).epsilon(1e-6));
  CHECK(found.channels[0].first_arrival_is_exact);
  CHECK(found.channels[0].first_arrival_s == Approx(2.0 / speed_of_light).epsilon(1e-12));
  // Within r of the point below, E/M = r²/(r² + h²); up to a distance of 3 m: r² = 5, a circle beyond the ceiling's
  // edges, cut by them: bin 2 has more than the inscribed circle, r = 2, 1/2 of M, and bin 3 the rest.
  const double exitance = 1.0 / 16.0;
  const double width = found.bin_width_s;
  CHECK(found.h[0] == 0.0);
  CHECK(found.h[1] == 0.0);
  CHECK(found.h[2] * width > 0.5 * exitance * 1e-4);
  CHECK(found.h[2] * width < 5.0 / 9.0 * exitance * 1e-4);
  CHECK(found.h[3] * width > 0.0);
  CHECK(found.h[4] == 0.0);
  CHECK((found.h[2] + found.h[3]) * width == Approx(found.channels[0].line_of_sight.value).epsilon(1e-9));
}

TEST_CASE("channels: a furnished room with four lamps and eight receivers, by both walks") {
  Room room = read_gltf(LICHTMC_SCENES "/living_room.glb");
  room.receivers.clear();
  for (int k = 0; k < 8; ++k)
    room.receivers.push_back(
        {"eye_" + std::to_string(k), {0.9 + 1.1 * (k % 4), 1.2, 1.1 + 1.9 * (k / 4)}, {0, 1, 0}, 80.0, 1e-4});
  REQUIRE(room.emitters.size() == 4);
  Settings settings = channel_settings(4e5, 33);
  settings.channel.per_emitter = true;
  settings.channel.orders = 0;
  settings.channel.bin_width_s = 2e-9;
  settings.channel.time_span_s = 60e-9;
  settings.receiver_walk = ReceiverWalk::backward;
  const ImpulseResponses backward = channels_of(room, settings);
  CHECK(backward.channels.size() == 32);
  settings.seed = 34;
  settings.photons = 1'000'000;
  settings.receiver_walk = ReceiverWalk::next_event;
  check_same("living room", channels_of(room, settings), backward);
}
