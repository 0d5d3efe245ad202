// Maintenance factors of emitters: read, set, written; and receivers of other laws in files.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>

#include "lichtmc/cuboid.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/fingerprint.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/inspect.hpp"
#include "lichtmc/overrides.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

constexpr double of_lamp = 40.0 * std::numbers::pi;  // 4π · 10 cd

json& light_extras(json& document) {
  return document["extensions"]["KHR_lights_punctual"]["lights"][0]["extras"];
}

Room two_lamps() {
  Room room = unit_cube(0.5, isotropic({0.5, 0.6, 0.5}, 1000.0));
  room.emitters.push_back(isotropic({0.2, 0.6, 0.5}, 500.0));
  return room;
}

Room written_and_read(const Room& room) {
  const TemporaryFolder folder;
  write_gltf(room, folder.path() / "room.glb");
  return read_gltf(folder.path() / "room.glb");
}

std::string text_of_topic(const Room& room, const std::string& topic) {
  for (const Finding& finding : inspect(room).findings) {
    if (finding.topic == topic) return finding.text + " " + finding.advice;
  }
  return "";
}

}  // namespace

TEST_CASE("maintenance factors of lights: that of the node precedes that of the light") {
  json document = triangle_document();
  CHECK_FALSE(read_document(document).emitters[0].own_maintenance);
  CHECK(read_document(document).emitters[0].power == of_lamp);
  light_extras(document)["maintenance_factor"] = 0.5;
  CHECK(read_document(document).emitters[0].power == 0.5 * of_lamp);
  document["nodes"][1]["extras"] = {{"maintenance_factor", 0.8}, {"power", 1000}};
  const Room room = read_document(document);
  CHECK(room.emitters[0].power == 800.0);
  CHECK(room.emitters[0].maintenance_factor == 0.8);
  CHECK(room.emitters[0].own_maintenance);
  CHECK(room.ignored.empty());
  for (const json& value : {json(0), json(-0.1), json(1.01), json("0.8"), json(true), json(nullptr)}) {
    document["nodes"][1]["extras"]["maintenance_factor"] = value;
    CHECK_THAT(refusal(document), ContainsSubstring("'maintenance_factor' of node 'lamp'"));
  }
}

TEST_CASE("maintenance factors of emissive surfaces: that of the node precedes that of the material") {
  json document = triangle_document();
  document["materials"][0]["emissiveFactor"] = {1.0, 1.0, 1.0};
  document["materials"][0]["extras"]["power"] = 200;
  document["materials"][0]["extras"]["maintenance_factor"] = 0.75;
  CHECK(read_document(document).emitters[0].power == 150.0);
  document["nodes"][0]["extras"] = {{"maintenance_factor", 0.5}};
  const Room room = read_document(document);
  CHECK(room.emitters[0].power == 100.0);
  CHECK(room.emitters[1].power == of_lamp);  // the lamp
}

TEST_CASE("maintenance factors where no light is emitted, or by another name, are noted") {
  json document = triangle_document();
  document["nodes"][0]["extras"] = {{"maintenance_factor", 0.8}};
  CHECK(ignores(read_document(document), "'maintenance_factor' of node 'floor': nothing of this node emits light"));
  document = triangle_document();
  document["materials"][0]["extras"]["maintenance_factor"] = 0.8;
  CHECK(ignores(read_document(document), "'maintenance_factor' of material 'paint'"));
  for (const char* name :
       {"MF", "maintenance", "Maintenance Factor", "maintenancefactor", "Wartungsfaktor", "maintenace_factor", "llf"}) {
    document = triangle_document();
    document["nodes"][1]["extras"] = {{name, 0.8}};
    INFO(name);
    CHECK(ignores(read_document(document), "the name is 'maintenance_factor'"));
  }
}

TEST_CASE("the factor of all emitters leaves those with one of their own, and replaces itself") {
  Room room = two_lamps();
  room.emitters[1].own_maintenance = true;  // 1: it loses nothing
  set_maintenance_factor(room, 0.8);
  CHECK(room.emitters[0].power == 800.0);
  CHECK(room.emitters[1].power == 500.0);
  CHECK(room.overrides.back() ==
        "Maintenance factor 0.8: 1 emitter has this share of the new power; 1 emitter has a factor of the file.");
  CHECK_FALSE(common_maintenance_factor(room));
  CHECK(maintained_text(room) ==
        "Maintained values: maintenance factors 0.8 to 1, the part of the radiant flux when new that remains");
  set_maintenance_factor(room, 0.5);
  CHECK(room.emitters[0].power == Approx(500.0).epsilon(1e-15));
  room.emitters[1].power = 0.0;  // its factor has no influence
  CHECK(common_maintenance_factor(room).value() == 0.5);
  CHECK(maintained_text(room) ==
        "Maintained values: maintenance factor 0.5, the part of the radiant flux when new that remains; initial values "
        "are 2 times as high");
  CHECK(maintained_text(two_lamps()).empty());
  CHECK(common_maintenance_factor(two_lamps()).value() == 1.0);
  for (const double factor : {0.0, -1.0, 1.5, std::nan("")})
    CHECK_THROWS_WITH(set_maintenance_factor(room, factor), ContainsSubstring("above 0 and up to 1"));
  room.emitters[0].maintenance_factor = 1.2;
  CHECK_THROWS_WITH(check_room(room), ContainsSubstring("maintenance factor of emitter"));
}

TEST_CASE("a file has the new power and the factor: read back, the room is the same") {
  Room room = two_lamps();
  room.emitters.push_back(surface_emitter(0, 300.0));
  room.emitters[1].maintenance_factor = 0.7;
  set_maintenance_factor(room, 0.8);
  const Room same = written_and_read(room);
  REQUIRE(same.emitters.size() == 3);
  for (const Emitter& emitter : room.emitters) {
    const auto read = std::find_if(same.emitters.begin(), same.emitters.end(), [&](const Emitter& other) {
      return std::abs(other.power - emitter.power) < 1e-12 * emitter.power;
    });
    REQUIRE(read != same.emitters.end());
    CHECK(read->maintenance_factor == 0.8);
    CHECK(read->own_maintenance);
  }
}

TEST_CASE("the factor is part of the fingerprint, unless it is 1") {
  Room room = two_lamps();
  const Fingerprint plain = fingerprint(room);
  room.emitters[0].own_maintenance = true;
  CHECK(fingerprint(room) == plain);
  room.emitters[0].maintenance_factor = 0.8;
  CHECK(fingerprint(room) != plain);
}

TEST_CASE("check: emitters with and without a maintenance factor") {
  Room room = two_lamps();
  CHECK(text_of_topic(room, "maintenance").empty());
  room.emitters[0].own_maintenance = true;
  room.emitters[0].maintenance_factor = 0.8;
  CHECK_THAT(text_of_topic(room, "maintenance"),
             ContainsSubstring("1 emitter has a maintenance factor, 1 emitter has none") &&
                 ContainsSubstring("--maintenance-factor"));
  set_maintenance_factor(room, 0.9);
  CHECK(text_of_topic(room, "maintenance").empty());
}

TEST_CASE("receivers of other laws are read and written: upright, facing the way the node looks") {
  json document = triangle_document();
  document["nodes"][1]["extras"] = {{"receiver", {{"quantity", "cylindrical"}}}};
  Receiver receiver = read_document(document).receivers.at(0);
  CHECK(receiver.law == ReceiverLaw::cylindrical);
  CHECK(read_document(document).ignored.empty());
  CHECK(receiver.normal == glm::dvec3(0, 1, 0));
  document["nodes"][1]["extras"]["receiver"]["quantity"] = "semicylindrical";
  // Turned by 90° about y: −Z becomes −X.
  document["nodes"][1]["rotation"] = {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)};
  const Room room = read_document(document);
  receiver = room.receivers.at(0);
  CHECK(receiver.law == ReceiverLaw::semicylindrical);
  CHECK(glm::length(receiver.facing - glm::dvec3(-1, 0, 0)) < 1e-7);
  const Receiver same = written_and_read(room).receivers.at(0);
  CHECK(same.law == receiver.law);
  CHECK(glm::length(same.facing - receiver.facing) < 1e-6);
  CHECK(same.normal == receiver.normal);

  Room tilted = room;
  tilted.receivers[0].normal = {0.1, 1.0, 0.0};
  CHECK_THROWS_WITH(written_and_read(tilted), ContainsSubstring("not vertical"));
  document["nodes"][1]["rotation"] = {std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
  CHECK_THAT(refusal(document), ContainsSubstring("straight up or down"));
  document["nodes"][1].erase("rotation");
  document["nodes"][1]["extras"]["receiver"]["fov"] = 40;
  CHECK_THAT(refusal(document), ContainsSubstring("'fov' of the receiver node 'lamp' is 40"));
  document["nodes"][1]["extras"]["receiver"] = {{"quantity", "cylinder"}};
  CHECK_THAT(refusal(document), ContainsSubstring("'quantity' of the receiver node 'lamp' is 'cylinder'"));
}
