// Custom properties with another name or in another place than those that are read, and empty nodes named like lights.
#include <algorithm>
#include <string>
#include <vector>

#include "gltf/custom_properties.hpp"
#include "lichtmc/inspect.hpp"
#include "room/surface_pieces.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

// The notes of a document, each "what advice".
std::vector<std::string> notes(const json& document) {
  std::vector<std::string> texts;
  for (const Ignored& thing : read_document(document).ignored) texts.push_back(thing.what + " " + thing.advice);
  return texts;
}

std::string only_note(const json& document) {
  const std::vector<std::string> texts = notes(document);
  REQUIRE(texts.size() == 1);
  return texts[0];
}

}  // namespace

TEST_CASE("a name means a property in any case, with slips, and by other words") {
  for (const char* name : {"reflectance", "Reflectance", "REFLECTANCE", "reflectence", "reflektance", "refl ectance",
                           "reflectance.001", "albedo", "Reflectivity", "rho", "ρ"})
    CHECK(meant_property(name) == "reflectance");
  for (const char* name : {"Power", "powr", "pwoer", "lumens", "Lumen", "luminous flux", "Watt"})
    CHECK(meant_property(name) == "power");
  for (const char* name : {"lambertExponent", "Lambert-Exponent", "lambert_exponant"})
    CHECK(meant_property(name) == "lambert_exponent");
  CHECK(meant_property("Unit") == "unit");
  CHECK(meant_property("Receiver") == "receiver");
  // What other programs write.
  for (const char* name : {"cycles",
                           "cycles_visibility",
                           "name",
                           "tower",
                           "lower",
                           "uuid",
                           "targetNames",
                           "roughness",
                           "refraction",
                           "ior",
                           "color",
                           "opacity",
                           "emission",
                           "layer",
                           "receive_shadow",
                           "sensor_width",
                           "ifc_definition_id",
                           "Tag",
                           "GlobalId",
                           "pose",
                           "init",
                           "flow"}) {
    INFO(name);
    CHECK(meant_property(name).empty());
  }
}

TEST_CASE("properties with another name are named with the right one, and change figures") {
  json document = triangle_document();
  document["materials"][0]["extras"] = {{"Reflectance", 0.2}};
  CHECK(only_note(document) ==
        "The custom property 'Reflectance' of material 'paint' is not read: the name is 'reflectance'. Set "
        "'reflectance' there instead.");
  CHECK(read_document(document).ignored[0].effect == Effect::figures);
  document["materials"][0]["extras"] = {{"Reflectance", 0.2}, {"reflectance", 0.3}};
  CHECK(notes(document).empty());  // the right one is there as well

  document = triangle_document();
  document["nodes"][1]["extras"] = {{"Lumens", 500}};
  CHECK_THAT(only_note(document), ContainsSubstring("'Lumens' of node 'lamp'") && ContainsSubstring("'power'"));
  document["nodes"][1].erase("extras");
  document["extensions"]["KHR_lights_punctual"]["lights"][0]["extras"] = {{"lambertExponent", 3}};
  CHECK_THAT(only_note(document), ContainsSubstring("of light 0") && ContainsSubstring("'lambert_exponent'"));
}

TEST_CASE("properties at the wrong object are named with the right one") {
  struct Case {
    const char* list;
    std::size_t index;
    json extras;
    const char* says;
  };
  for (const Case& one : std::vector<Case>{
           {"nodes",
            0,
            {{"reflectance", 0.2}},
            "'reflectance' of node 'floor' is not read: it does not belong there. Set "
            "it on the material instead."},
           {"meshes", 0, {{"reflectance", 0.2}}, "Set it on the material"},
           {"meshes", 0, {{"Albedo", 0.2}}, "the name is 'reflectance'. Set 'reflectance' on the material"},
           {"nodes", 0, {{"power", 100.0}}, "Set it on the emissive material of the surface, or the node of a light"},
           {"nodes", 0, {{"unit", "W"}}, "Set it on the emissive material of the surface, or the node of a light"},
           {"materials", 0, {{"reflectance", 0.5}, {"lambert_exponent", 2}}, "Set it on an emissive material"},
           {"materials", 0, {{"reflectance", 0.5}, {"receiver", {{"area", 1.0}}}}, "Set it on a node"},
           {"scenes", 0, {{"unit", "W"}}, "Set it on the emissive material"}}) {
    INFO(one.list << ' ' << one.extras.dump());
    json document = triangle_document();
    document[one.list][one.index]["extras"] = one.extras;
    CHECK_THAT(only_note(document), ContainsSubstring(one.says));
  }
}

TEST_CASE("properties of other programs with other values raise no alarm") {
  json document = triangle_document();
  document["nodes"][0]["extras"] = {
      {"unit", "mm"}, {"Power", "high"}, {"cycles", {{"visible", true}}}, {"albedo", "a.png"}};
  document["scenes"][0]["extras"] = {{"units", "meters"}, {"power", json::object()}};
  CHECK(notes(document).empty());
}

TEST_CASE("values of the wrong type are refused") {
  json document = triangle_document();
  for (const json& value : {json("0.5"), json(nullptr), json::array({0.5}), json(true)}) {
    INFO(value.dump());
    document["materials"][0]["extras"]["reflectance"] = value;
    CHECK_THAT(refusal(document), ContainsSubstring("'reflectance' of material 'paint'"));
  }
}

TEST_CASE("an empty receiver has its default area; parts that are not read are named") {
  json document = triangle_document();
  document["nodes"].push_back({{"name", "meter"}, {"extras", {{"receiver", json::object()}}}});
  document["scenes"][0]["nodes"].push_back(2);
  const Room room = read_document(document);
  REQUIRE(room.receivers.size() == 1);
  CHECK(room.receivers[0].area_m2 == 1.0);
  CHECK(room.receivers[0].half_angle_deg == 90.0);
  document["nodes"][2]["extras"]["receiver"] = {{"Area", 2.0}, {"fov", 60}};
  CHECK_THAT(only_note(document), ContainsSubstring("'Area' in the custom property 'receiver' of node 'meter'"));
}

TEST_CASE("empty nodes named like a light are noted, other nodes are not") {
  json document = triangle_document();
  for (const char* name : {"Area", "Area.001", "Ceiling_Lamp", "AreaLight2", "Deckenleuchte links", "Leuchte_3", "灯",
                           "Camera", "Highlight", "Empty", "lightning"}) {
    document["nodes"].push_back({{"name", name}});
    document["scenes"][0]["nodes"].push_back(document["nodes"].size() - 1);
  }
  document["nodes"][0]["name"] = "light_floor";  // has a mesh
  CHECK_THAT(only_note(document), ContainsSubstring("6 empty nodes have names of lights: 'Area', 'Area.001', "
                                                    "'Ceiling_Lamp', 'AreaLight2', 'Leuchte_3' and 1 more"));
  CHECK(read_document(document).ignored[0].effect == Effect::none);
}

TEST_CASE("pieces of a surface, and whether it is a body") {
  const auto joined = [](const std::vector<Surface>& walls) {
    Surface all;
    for (const Surface& wall : walls) {
      const auto first = static_cast<unsigned>(all.positions.size());
      all.positions.insert(all.positions.end(), wall.positions.begin(), wall.positions.end());
      for (const glm::uvec3& t : wall.triangles) all.triangles.push_back(t + first);
    }
    return all;
  };
  std::vector<Surface> walls = make_cuboid({2.0, 1.0, 3.0}, uniform_reflectance(0.5)).surfaces;
  CHECK(pieces_of(walls[0]).count == 1);
  CHECK(!pieces_of(walls[0]).closed);
  CHECK(pieces_of(joined(walls)).count == 1);
  CHECK(pieces_of(joined(walls)).closed);
  CHECK(pieces_of(joined(walls)).facing_down == Approx(6.0 / 22.0));
  std::vector<Surface> two{walls[0], walls[0]};
  for (glm::dvec3& p : two[1].positions) p += glm::dvec3(10.0);
  CHECK(pieces_of(joined(two)).count == 2);
}

TEST_CASE("an area light of several pieces with one power, and one that is a body, are noted") {
  json document = triangle_document();
  // A second triangle apart from the first, in one mesh.
  document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      add_accessor(document, std::vector<float>{0, 0, 0, 0, 0, 1, 1, 0, 0, 5, 0, 0, 5, 0, 1, 6, 0, 0}, "VEC3", 5126, 3);
  document["materials"][0]["emissiveFactor"] = {1.0, 1.0, 1.0};
  CHECK(notes(document).empty());  // its luminance holds for every piece
  document["materials"][0]["extras"]["power"] = 3200.0;
  CHECK_THAT(only_note(document),
             ContainsSubstring("'floor' has 2 separate pieces, which together have the power 3200 lm") &&
                 ContainsSubstring("set 'power' to 6400"));

  Room room = unit_cube(0.5, isotropic({0.1, 0.1, 0.1}));
  Surface box;
  for (const Surface& wall : make_cuboid({0.1, 0.1, 0.1}, uniform_reflectance(0.5)).surfaces) {
    const auto first = static_cast<unsigned>(box.positions.size());
    for (const glm::dvec3& p : wall.positions) box.positions.push_back(p + glm::dvec3(0.45));
    for (const glm::uvec3& t : wall.triangles) box.triangles.push_back(t + first);
  }
  box.name = "box";
  room.surfaces.push_back(box);
  room.emitters = {{"box", 100.0, SurfaceEmitter{room.surfaces.size() - 1, 1.0}}};
  const Inspection facts = inspect(room);
  const bool noted = std::any_of(facts.findings.begin(), facts.findings.end(), [](const Finding& finding) {
    return finding.severity == Severity::note && finding.text.find("1 area light is a closed body") == 0;
  });
  CHECK(noted);
}
