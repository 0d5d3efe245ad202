// Things left out on request, names told apart by parents, reflectances of chosen surfaces.
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/overrides.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

// The floor and the lamp of triangle_document(), and desks: two with a 'top' and a 'lamp' each, one of them deeper.
json desks() {
  json document = triangle_document();
  json& nodes = document["nodes"];
  const auto add = [&](const json& node) {
    nodes.push_back(node);
    return nodes.size() - 1;
  };
  const json light = {{"KHR_lights_punctual", {{"light", 0}}}};
  document["materials"].push_back({{"name", "wood"}, {"extras", {{"reflectance", 0.3}}}});
  json mesh = document["meshes"][0];
  mesh["name"] = "plate";
  mesh["primitives"][0]["material"] = 1;
  document["meshes"].push_back(mesh);
  const auto desk = [&](const char* name, bool deeper) {
    const std::size_t top = add({{"name", "top"}, {"mesh", 1}});
    const std::size_t lamp = add({{"name", "spot"}, {"extensions", light}});
    std::vector<std::size_t> children{top, lamp};
    if (deeper) children = {add({{"children", children}})};  // without a name
    return add({{"name", name}, {"children", children}});
  };
  const std::size_t one = desk("desk_1", false);
  const std::size_t two = desk("desk_2", true);
  document["scenes"][0]["nodes"].push_back(one);
  document["scenes"][0]["nodes"].push_back(two);
  return document;
}

Room read_with(const json& document, const ReadOptions& options) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "room.gltf") << document.dump();
  return read_gltf(folder.path() / "room.gltf", options);
}

Room without(const json& document, const std::vector<std::string>& patterns) {
  ReadOptions options;
  options.without = patterns;
  return read_with(document, options);
}

std::set<std::string> names_of(const Room& room) {
  std::set<std::string> names;
  for (const Surface& surface : room.surfaces) names.insert(surface.name);
  for (const Emitter& emitter : room.emitters) names.insert(emitter.name);
  return names;
}

}  // namespace

TEST_CASE("equal names are told apart by parents; other names stay as they are") {
  CHECK(names_of(read_document(desks())) ==
        std::set<std::string>{"floor", "lamp", "desk_1/top", "desk_2/top", "desk_1/spot", "desk_2/spot"});
  CHECK(names_of(read_document(triangle_document())) == std::set<std::string>{"floor", "lamp"});
}

TEST_CASE("names that parents do not tell apart get numbers, the others only the parents that are needed") {
  json document = triangle_document();
  json& nodes = document["nodes"];
  const auto add = [&](const json& node) {
    nodes.push_back(node);
    return nodes.size() - 1;
  };
  // a/frame/top, a/frame/top, b/frame/top, and top at the root.
  std::vector<std::size_t> tops;
  for (int k = 0; k < 4; ++k) tops.push_back(add({{"name", "top"}, {"mesh", 0}}));
  const std::size_t frame_a = add({{"name", "frame"}, {"children", {tops[0], tops[1]}}});
  const std::size_t frame_b = add({{"name", "frame"}, {"children", {tops[2]}}});
  for (const std::size_t root :
       {add({{"name", "a"}, {"children", {frame_a}}}), add({{"name", "b"}, {"children", {frame_b}}}), tops[3]})
    document["scenes"][0]["nodes"].push_back(root);
  CHECK(names_of(read_document(document)) ==
        std::set<std::string>{"floor", "lamp", "top", "a/frame/top", "a/frame/top_2", "b/frame/top"});
}

TEST_CASE("nodes with all below them, meshes, materials and surfaces are left out by name or pattern") {
  const std::set<std::string> all = names_of(read_document(desks()));
  const auto minus = [&](std::set<std::string> less) {
    std::set<std::string> rest = all;
    for (const std::string& name : less) rest.erase(name);
    return rest;
  };
  CHECK(names_of(without(desks(), {"desk_2"})) == minus({"desk_2/top", "desk_2/spot"}));
  CHECK(names_of(without(desks(), {"desk_*"})) == minus({"desk_1/top", "desk_2/top", "desk_1/spot", "desk_2/spot"}));
  CHECK(names_of(without(desks(), {"top"})) == minus({"desk_1/top", "desk_2/top"}));
  CHECK(names_of(without(desks(), {"plate"})) == minus({"desk_1/top", "desk_2/top"}));
  CHECK(names_of(without(desks(), {"wood"})) == minus({"desk_1/top", "desk_2/top"}));
  CHECK(names_of(without(desks(), {"desk_1/top"})) == minus({"desk_1/top"}));
  CHECK(names_of(without(desks(), {"spot", "wo?d"})) == std::set<std::string>{"floor", "lamp"});
  // A pattern for what another pattern leaves out as well fits something.
  CHECK(names_of(without(desks(), {"desk_*", "wood"})) == std::set<std::string>{"floor", "lamp"});
}

TEST_CASE("what is left out is listed, and area lights keep their surfaces") {
  json document = desks();
  document["materials"][1]["emissiveFactor"] = {1.0, 1.0, 1.0};
  const Room room = without(document, {"desk_1/top", "floor"});
  REQUIRE(room.surfaces.size() == 1);
  CHECK(room.surfaces[0].name == "desk_2/top");
  for (const Emitter& emitter : room.emitters) {
    if (const auto* area = std::get_if<SurfaceEmitter>(&emitter.shape)) {
      CHECK(area->surface == 0);
      CHECK(emitter.name == "desk_2/top");
    }
  }
  REQUIRE(room.overrides.size() == 1);
  CHECK(room.overrides[0] == "Left out (--without 'desk_1/top', 'floor'): 2 surfaces.");
}

TEST_CASE("a texture is not needed for what is left out") {
  json document = desks();
  document["materials"][1].erase("extras");
  document["textures"] = {json::object()};
  document["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  document["meshes"][1]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      add_accessor(document, std::vector<float>{0, 0, 0, 1, 1, 0}, "VEC2", 5126, 2);
  CHECK_THAT(refusal(document), ContainsSubstring("material 'wood'"));
  CHECK(without(document, {"wood"}).surfaces.size() == 1);
  CHECK(without(document, {"desk_1/top", "desk_2/top"}).surfaces.size() == 1);
  // Nor for a surface or material whose reflectance will be set.
  for (const char* name : {"w*d", "desk_*", "material:wood", "surface:*top"}) {
    INFO(name);
    ReadOptions options;
    options.numbered = {name};
    Room room = read_with(document, options);
    set_reflectance(room, name, 0.6);
    CHECK(room.surfaces.back().reflectance == 0.6);
    CHECK(room.surfaces.back().reflectance_source == ReflectanceSource::given);
    CHECK(room.reflectance_maps.empty());
  }
}

TEST_CASE("a pattern that fits nothing is refused with similar names") {
  CHECK_THROWS_WITH(without(desks(), {"desk_3"}),
                    ContainsSubstring("'desk_3' of --without") && ContainsSubstring("'desk_1', 'desk_2'"));
  // A hidden node cannot be left out once more.
  json document = desks();
  document["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
  CHECK_THROWS_WITH(without(document, {"floor"}), ContainsSubstring("nothing in it has the name 'floor'"));
}

TEST_CASE("a reflectance is set by material, surface or pattern") {
  const auto reflectances = [](const std::string& name) {
    Room room = read_document(desks());  // floor: paint, 0.5; tops: wood, 0.3
    set_reflectance(room, name, 0.9);
    std::vector<double> values;
    for (const Surface& surface : room.surfaces) values.push_back(surface.reflectance);
    return values;
  };
  CHECK(reflectances("wood") == std::vector<double>{0.5, 0.9, 0.9});
  CHECK(reflectances("desk_2/top") == std::vector<double>{0.5, 0.3, 0.9});
  CHECK(reflectances("desk_*") == std::vector<double>{0.5, 0.9, 0.9});
  CHECK(reflectances("*") == std::vector<double>{0.9, 0.9, 0.9});
  CHECK(reflectances("surface:floor") == std::vector<double>{0.9, 0.5 - 0.2, 0.3});
}

TEST_CASE("a name that means a material and another surface is refused; a prefix tells which") {
  json document = desks();
  document["nodes"][0]["name"] = "wood";  // the floor, of the material 'paint'
  Room room = read_document(document);
  CHECK_THROWS_WITH(set_reflectance(room, "wood", 0.9), ContainsSubstring("material 'wood'") &&
                                                            ContainsSubstring("surface 'wood'") &&
                                                            ContainsSubstring("'material:wood=R'"));
  set_reflectance(room, "material:wood", 0.9);
  CHECK(room.surfaces[0].reflectance == 0.5);
  CHECK(room.surfaces[1].reflectance == 0.9);
  set_reflectance(room, "surface:wood", 0.1);
  CHECK(room.surfaces[0].reflectance == 0.1);
  CHECK(room.surfaces[1].reflectance == 0.9);
  CHECK_THROWS_WITH(set_reflectance(room, "woud", 0.9),
                    ContainsSubstring("no material or surface 'woud'") && ContainsSubstring("'wood'"));
}
