// Calculation areas of glTF files: nodes with extras.calculation_area.
#include <string>

#include "lichtmc/lichtmc.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

// The triangle's document with a second node "task" of the same mesh, 0.5 m above it, moved by 1 m along x.
json document_with_area(const json& extras) {
  json document = triangle_document();
  const json mesh = document["nodes"][0]["mesh"];
  document["scenes"][0]["nodes"].push_back(document["nodes"].size());
  document["nodes"].push_back({{"name", "task"}, {"mesh", mesh}, {"translation", {1, 0.5, 0}}, {"extras", extras}});
  return document;
}

json task() {
  return {{"calculation_area", "task"}};
}

std::string refusal_with(const char* name, const json& value) {
  json extras = task();
  extras[name] = value;
  return refusal(document_with_area(extras));
}

bool notes_with(const json& extras, const std::string& text) {
  return ignores(read_document(document_with_area(extras)), text);
}

}  // namespace

TEST_CASE("glTF: a node with calculation_area measures, and is no part of the room") {
  const Room room = read_document(document_with_area({{"calculation_area", "surrounding"},
                                                      {"spacing", 0.25},
                                                      {"margin", 0},
                                                      {"target_lx", 300},
                                                      {"target_uniformity", 0.4},
                                                      {"quantity", "semicylindrical"},
                                                      {"direction", {0, 0, -1}},
                                                      {"cells", 1}}));
  CHECK(room.surfaces.size() == 1);
  REQUIRE(room.area_requests.size() == 1);
  const AreaRequest& request = room.area_requests[0];
  CHECK(request.properties.name == "task");
  CHECK(request.properties.role == "surrounding");
  CHECK(request.properties.spacing_m == 0.25);
  CHECK(request.properties.margin_m == 0.0);
  CHECK(request.properties.target_lx == 300.0);
  CHECK(request.properties.target_uniformity == 0.4);
  CHECK(request.properties.quantity == AreaQuantity::semicylindrical);
  CHECK(request.properties.direction == glm::dvec3(0.0, 0.0, -1.0));
  CHECK(request.properties.cells);
  REQUIRE(request.triangles.size() == 1);
  CHECK(request.triangles[0][0] == glm::dvec3(1.0, 0.5, 0.0));
  CHECK(room.ignored.empty());
  CHECK_FALSE(read_document(document_with_area(task())).area_requests[0].properties.spacing_m);
}

TEST_CASE("glTF: areas without a grid are written and read back") {
  const Room room = read_document(document_with_area(
      {{"calculation_area", "wall"}, {"spacing", 0.25}, {"quantity", "semicylindrical"}, {"direction", {0, 0, -1}}}));
  const TemporaryFolder folder;
  write_gltf(room, folder.path() / "room.glb");
  const Room again = read_gltf(folder.path() / "room.glb");
  REQUIRE(again.area_requests.size() == 1);
  const AreaRequest& request = again.area_requests[0];
  CHECK(request.triangles == room.area_requests[0].triangles);
  CHECK(request.properties.name == "task");
  CHECK(request.properties.role == "wall");
  CHECK(request.properties.spacing_m == 0.25);
  CHECK(request.properties.quantity == AreaQuantity::semicylindrical);
  CHECK(request.properties.direction == glm::dvec3(0.0, 0.0, -1.0));
  CHECK_FALSE(request.properties.margin_m);
}

TEST_CASE("glTF: nodes below a calculation area, its names and its emissive material") {
  json document = document_with_area(task());
  document["materials"][0]["extras"]["power"] = 100;
  document["materials"][0]["emissiveFactor"] = {1, 1, 1};
  const std::size_t area = document["nodes"].size() - 1;
  document["nodes"][area]["children"] = {area + 1, area + 2};
  document["nodes"].push_back({{"name", "pen"}, {"mesh", 0}});
  document["nodes"].push_back({{"name", "task"}, {"mesh", 0}, {"extras", task()}});
  const Room room = read_document(document);
  CHECK(room.surfaces.size() == 2);
  CHECK(room.emitters.size() == 3);  // the lamp, the floor and the pen
  REQUIRE(room.area_requests.size() == 2);
  CHECK(room.area_requests[0].properties.name != room.area_requests[1].properties.name);
}

TEST_CASE("glTF: properties of areas of a wrong type or out of their range are refused with the node") {
  for (const auto& [name, value] : std::vector<std::pair<const char*, json>>{{"calculation_area", 1},
                                                                             {"spacing", 0},
                                                                             {"spacing", "wide"},
                                                                             {"margin", -0.5},
                                                                             {"target_lx", 0},
                                                                             {"target_uniformity", 1.2},
                                                                             {"quantity", "vertical"},
                                                                             {"direction", {1, 0}},
                                                                             {"direction", "north"},
                                                                             {"cells", 2}}) {
    INFO(name);
    const std::string message = refusal_with(name, value);
    CHECK_THAT(message, ContainsSubstring(name) && ContainsSubstring("node 'task'"));
  }
  json document = triangle_document();
  document["nodes"][1]["extras"]["calculation_area"] = "task";
  CHECK_THAT(refusal(document), ContainsSubstring("node 'lamp'") && ContainsSubstring("no mesh"));
}

TEST_CASE("glTF: properties of areas with a slip in their name, or on another object, are told") {
  CHECK(notes_with({{"Calculation_Area", "task"}}, "the name is 'calculation_area'"));
  CHECK(notes_with({{"calculation_area", "task"}, {"Spacing", 0.5}}, "the name is 'spacing'"));
  CHECK(notes_with({{"calculation_area", "task"}, {"target_lux", 500}}, "the name is 'target_lx'"));
  CHECK(notes_with({{"target_lx", 500}}, "does not belong there"));
  CHECK_FALSE(notes_with({{"margins", 0.5}}, "margin"));  // of another program
  json document = triangle_document();
  document["meshes"][0]["extras"]["calculation_area"] = "task";
  CHECK(ignores(read_document(document), "does not belong there"));
}
