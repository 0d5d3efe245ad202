// What a user gives for impulse responses: delays of emitters, the optics of receivers, ranges of settings.
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/decimal_shift.hpp"
#include "lichtmc/cuboid.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/overrides.hpp"
#include "lichtmc/receiver_table.hpp"
#include "run/settings_check.hpp"
#include "support/catch.hpp"
#include "support/channel_rooms.hpp"
#include "support/gltf_text.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();

std::string only_note(const json& document) {
  const Room room = read_document(document);
  REQUIRE(room.ignored.size() == 1);
  CHECK(room.ignored[0].effect == Effect::figures);
  return room.ignored[0].what + " " + room.ignored[0].advice;
}

ChannelSettings channel(double width, std::optional<double> span = {}, std::uint32_t orders = 0,
                        const FrequencyRange& frequencies = {}) {
  ChannelSettings settings;
  settings.bin_width_s = width;
  settings.time_span_s = span;
  settings.orders = orders;
  settings.frequencies = frequencies;
  return settings;
}

std::string refusal_of(const ChannelSettings& channel) {
  Settings settings;
  settings.channel = channel;
  try {
    check_settings(settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Receiver table_row(const std::string& heading, const std::string& values) {
  return parse_receiver_table("x,y,z,nx,ny,nz," + heading + "\n1,2,3,0,1,0," + values + "\n", "f.csv").receivers.at(0);
}

}  // namespace

TEST_CASE("powers of ten are rounded once, and shift back to the same number") {
  CHECK(shift_decimals(0.2, -9) == 2e-10);
  CHECK(shift_decimals(17.3, -9) == 1.73e-8);
  CHECK(shift_decimals(-0.0, 3) == 0.0);
  CHECK(shift_decimals(5e-324, -3) == 0.0);
  CHECK(shift_decimals(1e300, 20) == infinite);
  CHECK(shift_decimals(-infinite, 2) == -infinite);
  CHECK(std::isnan(shift_decimals(not_a_number, 2)));
  // Numbers of up to 15 digits.
  for (int k = 1; k < 20'000; ++k) {
    const double ns = k / 1000.0;
    if (shift_decimals(shift_decimals(ns, -9), 9) != ns) FAIL(ns);
  }
}

TEST_CASE("delays of lights: that of the node precedes that of the light") {
  json document = triangle_document();
  CHECK(read_document(document).emitters[0].delay_s == 0.0);
  document["extensions"]["KHR_lights_punctual"]["lights"][0]["extras"] = {{"delay_ns", 7.3}};
  CHECK(read_document(document).emitters[0].delay_s == 7.3e-9);
  document["nodes"][1]["extras"] = {{"delay_ns", 5}};
  const Room room = read_document(document);
  CHECK(room.emitters[0].delay_s == 5e-9);
  CHECK(room.ignored.empty());
  for (const json& value : {json(-1), json("5"), json(nullptr), json(true)}) {
    document["nodes"][1]["extras"]["delay_ns"] = value;
    CHECK_THAT(refusal(document), ContainsSubstring("'delay_ns' of node 'lamp'"));
  }
}

TEST_CASE("delays of emissive surfaces: that of the node precedes that of the material") {
  json document = triangle_document();
  document["materials"][0]["emissiveFactor"] = {1.0, 1.0, 1.0};
  document["materials"][0]["extras"]["delay_ns"] = 2.5;
  CHECK(read_document(document).emitters[0].delay_s == 2.5e-9);
  document["nodes"][0]["extras"] = {{"delay_ns", 4}};
  const Room room = read_document(document);
  CHECK(room.emitters[0].delay_s == 4e-9);
  CHECK(room.emitters[1].delay_s == 0.0);  // the lamp
  CHECK(room.ignored.empty());
}

TEST_CASE("delays where no light is emitted, or by another name, are noted") {
  json document = triangle_document();
  document["nodes"][0]["extras"] = {{"delay_ns", 4}};
  CHECK_THAT(only_note(document), ContainsSubstring("'delay_ns' of node 'floor': nothing of this node emits light"));
  document = triangle_document();
  document["materials"][0]["extras"]["delay_ns"] = 4;
  CHECK_THAT(only_note(document), ContainsSubstring("'delay_ns' of material 'paint'") &&
                                      ContainsSubstring("Set it on an emissive material, or the node of a light"));
  document = triangle_document();
  document["meshes"][0]["extras"] = {{"delay_ns", 4}};
  CHECK_THAT(only_note(document), ContainsSubstring("'delay_ns' of mesh 'triangle'"));
  document = triangle_document();
  for (const char* name : {"delay", "Delay_ns", "delayNs", "latency"}) {
    document["nodes"][1]["extras"] = {{name, 4}};
    CHECK_THAT(only_note(document), ContainsSubstring("the name is 'delay_ns'"));
  }
  // Of an animation, perhaps.
  document = triangle_document();
  document["nodes"][0]["extras"] = {{"delay", 0.5}};
  CHECK(read_document(document).ignored.empty());
}

TEST_CASE("concentrators and filters of receivers") {
  json document = triangle_document();
  document["nodes"].push_back(
      {{"name", "eye"},
       {"extras", {{"receiver", {{"area", 1e-4}, {"fov", 30}, {"concentrator_index", 1.5}, {"filter_gain", 0.9}}}}}});
  document["scenes"][0]["nodes"].push_back(2);
  const Room room = read_document(document);
  CHECK(room.ignored.empty());
  CHECK(room.receivers[0].concentrator_index == 1.5);
  CHECK(room.receivers[0].filter_gain == 0.9);
  CHECK(room.receivers[0].optical_gain() == Approx(9.0 * 0.9).epsilon(1e-14));  // n²/sin² 30° = 9
  json& extras = document["nodes"][2]["extras"]["receiver"];
  for (const double index : {0.9, -1.0}) {
    extras["concentrator_index"] = index;
    CHECK_THAT(refusal(document), ContainsSubstring("'concentrator_index' of the receiver node 'eye'"));
  }
  extras["concentrator_index"] = 1.0;
  for (const json& gain : {json(-0.1), json("1")}) {
    extras["filter_gain"] = gain;
    CHECK_THAT(refusal(document), ContainsSubstring("'filter_gain'") && ContainsSubstring("node 'eye'"));
  }
  extras = {{"area", 1e-4}, {"concentrator", 1.5}};
  CHECK_THAT(only_note(document),
             ContainsSubstring("'concentrator' in the custom property") && ContainsSubstring("'concentrator_index'"));
}

TEST_CASE("delays, concentrators and filters are written and read again") {
  const TemporaryFolder folder;
  Room room = make_cuboid({2.0, 1.5, 4.0}, uniform_reflectance(0.5));
  room.emitters.push_back({"bulb", 3.0, IsotropicEmitter{{0.5, 1, 2}}, 7.3e-9});
  room.emitters.push_back({"other", 3.0, IsotropicEmitter{{0.5, 1, 2}}});
  room.emitters.push_back({"ceiling", 6.0, SurfaceEmitter{1, 1.0}, 1.0 / 3e8});
  room.receivers.push_back({"eye", {1, 0.75, 1}, {0, 1, 0}, 45.0, 0.01, 1.5, 0.8});
  room.receivers.push_back({"bare", {1, 0.75, 1}, {0, 1, 0}, 45.0, 0.01});
  const auto file = folder.path() / "room.glb";
  write_gltf(room, file);
  const Room again = read_gltf(file);
  REQUIRE(again.emitters.size() == 3);
  CHECK(again.emitters[0].delay_s == Approx(1.0 / 3e8).epsilon(0x1p-51));  // the surface comes first
  CHECK(again.emitters[1].delay_s == 7.3e-9);
  CHECK(again.emitters[2].delay_s == 0.0);
  REQUIRE(again.receivers.size() == 2);
  CHECK(again.receivers[0].concentrator_index == 1.5);
  CHECK(again.receivers[0].filter_gain == 0.8);
  CHECK(!again.receivers[1].concentrator_index);
  CHECK(again.receivers[1].filter_gain == 1.0);
  CHECK(again.ignored.empty());
}

TEST_CASE("receiver tables: area, field of view, concentrator and filter") {
  const Receiver full = table_row("area (m²),FOV/deg,concentrator_index,filter_gain", "1e-4,60,1.5,0.9");
  CHECK(full.area_m2 == 1e-4);
  CHECK(full.half_angle_deg == 60.0);
  CHECK(full.concentrator_index == 1.5);
  CHECK(full.filter_gain == 0.9);
  const Receiver empty = table_row("concentrator_index,area,filter_gain,fov", ", ,,");
  CHECK(empty.area_m2 == 1.0);
  CHECK(empty.half_angle_deg == 90.0);
  CHECK(!empty.concentrator_index);
  CHECK(empty.filter_gain == 1.0);
  struct Case {
    const char* heading;
    const char* value;
    const char* says;
  };
  for (const Case& one : {Case{"area", "-1", "m²"},
                          {"area", "desk", "not a number"},
                          {"area (cm2)", "1", "square"},
                          {"fov", "90.5", "0 to 90"},
                          {"fov/rad", "1", "degrees"},
                          {"concentrator_index", "0.9", "below 1"},
                          {"filter_gain", "-0.1", "negative"},
                          {"filter_gain (%)", "90", "without a unit"},
                          {"area,area", "1,1", "twice"}}) {
    INFO(one.heading);
    CHECK_THROWS_WITH(table_row(one.heading, one.value),
                      ContainsSubstring("f.csv, row ") && ContainsSubstring(one.says));
  }
}

TEST_CASE("delays are set by name and pattern, and recorded") {
  Room room = unit_cube(0.5, isotropic({0.1, 0.1, 0.1}));
  room.emitters[0].name = "lamp_1";
  room.emitters.push_back(room.emitters[0]);
  room.emitters[1].name = "lamp_2";
  set_delay(room, "lamp_?", 5e-9);
  set_delay(room, "lamp_2", 7.3e-9);
  CHECK(room.emitters[0].delay_s == 5e-9);
  CHECK(room.emitters[1].delay_s == 7.3e-9);
  CHECK(room.overrides ==
        std::vector<std::string>{"2 emitters 'lamp_?': delay set to 5 ns.", "Emitter 'lamp_2': delay set to 7.3 ns."});
  CHECK_THROWS_WITH(set_delay(room, "lamp_3", 0.0),
                    ContainsSubstring("no emitter 'lamp_3'") && ContainsSubstring("'lamp_1', 'lamp_2'"));
  for (const double delay : {-1e-9, not_a_number, infinite})
    CHECK_THROWS_WITH(set_delay(room, "lamp_1", delay), ContainsSubstring("0 or more"));
}

TEST_CASE("powers are set and emitters removed by name and pattern, and recorded") {
  Room room = unit_cube(0.5, isotropic({0.1, 0.1, 0.1}));
  room.emitters[0].name = "lamp_1";
  room.emitters.push_back(room.emitters[0]);
  room.emitters[1].name = "lamp_2";
  room.emitters[1].maintenance_factor = 0.5;
  set_power(room, "lamp_?", 30.0);
  CHECK(room.emitters[0].power == 30.0);
  CHECK(room.emitters[1].power == 15.0);
  CHECK_THROWS_WITH(remove_emitters(room, "lamp_3"),
                    ContainsSubstring("no emitter 'lamp_3'") && ContainsSubstring("'lamp_1', 'lamp_2'"));
  CHECK_THROWS_WITH(set_power(room, "lamp_3", 1.0), ContainsSubstring("no emitter 'lamp_3'"));
  for (const double power : {-1.0, not_a_number, infinite})
    CHECK_THROWS_WITH(set_power(room, "lamp_1", power), ContainsSubstring("0 or more"));
  CHECK(remove_emitters(room, "lamp_1") == 1);
  REQUIRE(room.emitters.size() == 1);
  CHECK(room.emitters[0].name == "lamp_2");
  CHECK(remove_emitters(room, "*") == 1);
  CHECK(room.emitters.empty());
  CHECK_THROWS_WITH(remove_emitters(room, "*"), ContainsSubstring("no emitters"));
  CHECK(room.overrides == std::vector<std::string>{"2 emitters 'lamp_?': power set to 30 W each.",
                                                   "Emitter 'lamp_1' removed.", "Emitter '*' removed."});
}

TEST_CASE("settings of channels: ranges, with the option to change") {
  CHECK(refusal_of({}).empty());
  CHECK(refusal_of(channel(1e-9)).empty());
  CHECK(refusal_of(channel(1e-9, 1e-9, 64)).empty());
  CHECK(refusal_of(channel(1.0, 0x1p24)).empty());
  CHECK(refusal_of(channel(1e-9, {}, 0, {0.0, 99'999e6, 1e6})).empty());
  CHECK(refusal_of(channel(1e-9, {}, 0, {5e6, 5e6, 1.0})).empty());
  for (const double width : {0.0, -1e-9, not_a_number, infinite})
    CHECK_THAT(refusal_of(channel(width)), ContainsSubstring("--impulse-response"));
  for (const double span : {0.0, 0.5e-9, not_a_number, infinite})
    CHECK_THAT(refusal_of(channel(1e-9, span)), ContainsSubstring("--time-span"));
  CHECK_THAT(refusal_of(channel(1.0, 0x1.000001p24)), ContainsSubstring("2^24 bins"));
  CHECK_THAT(refusal_of(channel(1e-9, {}, 65)), ContainsSubstring("--orders"));
  for (const FrequencyRange& range : {FrequencyRange{-1.0, 1.0, 1.0},
                                      {2.0, 1.0, 1.0},
                                      {0.0, 1.0, -1.0},
                                      {not_a_number, 1.0, 1.0},
                                      {0.0, infinite, 1.0},
                                      {0.0, 1.0, not_a_number},
                                      {0.0, 1.0, infinite},
                                      {0.0, 1e11, 1e6},
                                      {0.0, 1e300, 1e-300}})
    CHECK_THAT(refusal_of(channel(1e-9, {}, 0, range)), ContainsSubstring("--frequencies"));
}

TEST_CASE("settings of channels without a bin width would do nothing: refused") {
  const auto refused = [](const char* option, auto set) {
    ChannelSettings settings;
    set(settings);
    CHECK_THAT(refusal_of(settings), ContainsSubstring(std::string(option) + " is given without --impulse-response"));
  };
  refused("--time-span", [](ChannelSettings& c) { c.time_span_s = 1e-7; });
  refused("--orders", [](ChannelSettings& c) { c.orders = 1; });
  refused("--per-emitter", [](ChannelSettings& c) { c.per_emitter = true; });
  refused("--frequencies", [](ChannelSettings& c) { c.frequencies = {0.0, 1e6, 1e6}; });
  refused("--squared-weights", [](ChannelSettings& c) { c.squared_weights = true; });
}

TEST_CASE("impulse responses need receivers") {
  Room room = unit_cube(0.5, isotropic({0.1, 0.1, 0.1}));
  Settings settings;
  settings.channel.bin_width_s = 1e-9;
  CHECK_THROWS_WITH(check_settings_for(room, settings),
                    ContainsSubstring("no receiver") && ContainsSubstring("--grid"));
  room.receivers.push_back({"eye", {0.5, 0.5, 0.5}, {0, 1, 0}});
  CHECK_NOTHROW(check_settings_for(room, settings));
  room.receivers[0].cell_u = {0.1, 0.0, 0.0};
  room.receivers[0].cell_v = {0.0, 0.0, 0.1};
  CHECK_THROWS_WITH(check_settings_for(room, settings), ContainsSubstring("'eye'") && ContainsSubstring("a cell"));
  room.receivers[0].cell_u = room.receivers[0].cell_v = glm::dvec3(0.0);
  settings.measured = Measured::tiles;
  CHECK_THROWS_WITH(check_settings_for(room, settings), ContainsSubstring("--only tiles"));
}

TEST_CASE("the rooms of the reference tables can be simulated, and their receivers have the tables' gains in sight") {
  for (const Room& room : {barry_room(), cube_with_receivers(), partitioned_room()}) CHECK_NOTHROW(check_room(room));
  // (m + 1) A cos^m φ cos ψ/(2π d²) of the ceiling's lamp, d² = 3² + 2² + 1.5².
  const double squared = 15.25;
  const double sight = 1e-4 * 9.0 / (pi * squared * squared);
  const auto table = read_columns(LICHTMC_TEST_DATA "/channel/barry_1ns.csv");
  CHECK(table.at("total").size() == 120);
  CHECK(table.at("k0")[13] == Approx(sight).epsilon(1e-8));
  const auto all = derived_reference("barry", "all");
  const auto diffuse = derived_reference("barry", "nlos");
  CHECK(all.at("H0") - diffuse.at("H0") == Approx(sight).epsilon(1e-7));
  CHECK(all.at("K") == Approx(sight / diffuse.at("H0")).epsilon(1e-5));
  CHECK(std::isnan(derived_reference("cube_centre", "all").at("f3dB_el_MHz")));
}
