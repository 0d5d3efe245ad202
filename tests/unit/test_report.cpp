#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/lichtmc.hpp"
#include "output/svg.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/small_result.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

// A cube with names that contain markup, and receivers.
Room difficult_room() {
  Room room = unit_cube(0.5, paper_emitter());
  room.source = "a <b> & \"c\".glb";
  room.surfaces[0].name = "<script>alert(1)</script>";
  room.surfaces[1].name = "room";
  room.receivers.push_back({"here & there", {0.5, 0.2, 0.5}});
  return room;
}

Result simulate_it(const Room& room) {
  Settings settings = settings_of(Estimator::collision, Engine::automatic, 5e4, 1, 0.25);
  settings.measured = Measured::all;
  return simulate(room, settings);
}

}  // namespace

TEST_CASE("report: one page with pictures, tables and the command; names are escaped") {
  const Room room = difficult_room();
  const Folder folder;
  ReportOptions options;
  options.command = "lichtmc run 'a <b>.glb'";
  options.paths = 5;
  options.exr_pictures = true;
  std::vector<std::string> steps;
  options.progress = [&steps](std::string_view what) { steps.emplace_back(what); };
  write_report(room, simulate_it(room), folder.path(), options);
  CHECK(steps.size() >= 3);
  CHECK(files_in(folder.path()) == std::set<std::string>{"pictures", "report.html", "room_lit.glb"});
  const std::set<std::string> pictures = files_in(folder.path() / "pictures");
  // Two of the room and six walls, three forms each; the paths as SVG alone.
  CHECK(pictures.size() == 25);
  for (const char* name : {"room.svg", "room.png", "room.exr", "above.svg", "paths.svg", "room_2.svg"}) {
    INFO(name);
    CHECK(pictures.count(name) == 1);
  }
  const std::string page = text_of(folder.path() / "report.html");
  CHECK(page.starts_with("<!DOCTYPE html>"));
  CHECK(page.find("<script>alert(1)") == std::string::npos);
  CHECK(page.find("&lt;script&gt;alert(1)&lt;/script&gt;") != std::string::npos);
  CHECK(page.find("lichtmc run 'a &lt;b&gt;.glb'") != std::string::npos);
  CHECK(page.find("here &amp; there") != std::string::npos);
  for (const char* id :
       {"id=\"surfaces\"", "id=\"receivers\"", "id=\"view3d\"", "id=\"room-lit\"", "id=\"picture-paths\""})
    CHECK(page.find(id) != std::string::npos);
  // Nothing is loaded: no address except those of XML namespaces.
  for (std::size_t at = page.find("http"); at != std::string::npos; at = page.find("http", at + 1))
    CHECK(page.substr(at, 26) == "http://www.w3.org/2000/svg");
}

TEST_CASE("report: results of receivers alone have grey pictures of the room, with the receivers in false colour") {
  Room room = difficult_room();
  Settings settings = settings_of(Estimator::collision, Engine::automatic, 5e3, 1, 0.25);
  settings.measured = Measured::receivers;
  const Folder folder;
  write_report(room, simulate(room, settings), folder.path());
  CHECK(files_in(folder.path()) == std::set<std::string>{"pictures", "report.html"});
  CHECK(files_in(folder.path() / "pictures") ==
        std::set<std::string>{"above.png", "above.svg", "room.png", "room.svg"});
  const std::string page = text_of(folder.path() / "report.html");
  CHECK(page.find("id=\"receivers\"") != std::string::npos);
  CHECK(page.find("Irradiance at the receivers, ") != std::string::npos);
  CHECK(page.find("here &amp; there: ") != std::string::npos);
  CHECK(page.find("gain, dB") != std::string::npos);
  room.quantity = Quantity::photometric;
  write_report(room, simulate(room, settings), folder.path());
  CHECK(text_of(folder.path() / "report.html").find("gain, dB") == std::string::npos);
}

TEST_CASE("report: an older report is removed, other files in its folder are not") {
  const Room room = unit_cube(0.5, paper_emitter());
  const Result result = simulate_it(room);
  const Folder folder;
  write_report(room, result, folder.path());
  std::ofstream(folder.path() / "pictures" / "mine.png") << "mine";
  std::ofstream(folder.path() / "pictures" / "mine.svg") << "<svg>\n";
  write_results(room, result, folder.path());
  CHECK(files_in(folder.path() / "pictures") == std::set<std::string>{"mine.png", "mine.svg"});
  CHECK_FALSE(fs::exists(folder.path() / "report.html"));
  CHECK_FALSE(fs::exists(folder.path() / "room_lit.glb"));
}

TEST_CASE("report: a thousand times more paths than visible are refused") {
  const Room room = unit_cube(0.5, paper_emitter());
  const Folder folder;
  ReportOptions options;
  options.paths = 10'001;
  CHECK_THROWS_AS(write_report(room, simulate_it(room), folder.path(), options), InputError);
}

TEST_CASE("lit room: it contains every triangle of the room in its position, and the irradiance as numbers") {
  const Room room = read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::automatic, 5e4, 1, 0.25));
  const RoomPainter painter(room, result);
  const Folder folder;
  const fs::path file = folder.path() / "room_lit.glb";
  const std::string bytes = lit_room_glb(room, result, painter.lit_sides(), choose_scale(result));
  std::ofstream(file, std::ios::binary) << bytes;
  const Room lit = read_gltf(file);
  double area = 0.0;
  double lit_area = 0.0;
  for (const Surface& surface : room.surfaces) area += surface_area(surface);
  for (const Surface& surface : lit.surfaces) lit_area += surface_area(surface);
  // Triangles of two-sided surfaces with light on both sides appear once per side.
  CHECK(lit_area >= area * (1.0 - 1e-6));
  CHECK(lit_area <= 1.3 * area);
  CHECK(bytes.find("KHR_materials_unlit") != std::string::npos);
  CHECK(bytes.find("\"standard_error\":") != std::string::npos);
  // The floor's irradiance, row by row, as stored in the file.
  const SurfaceResult& floor = surface_named(result, "floor");
  std::vector<float> values;
  for (std::size_t m = 0; m < result.surfaces.size(); ++m) {
    if (result.surfaces[m].name != "floor") continue;
    for (const std::uint32_t tile : result.tiling.maps[m].tile_of_cell)
      values.push_back(static_cast<float>(result.tiles[tile].irradiance));
  }
  REQUIRE(values.size() == floor.tiles);
  CHECK(bytes.find(std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float))) !=
        std::string::npos);
}

TEST_CASE("lit room: a room far from the origin keeps its shape and place") {
  const glm::dvec3 move(691608.2, 520.0, -5334760.4);
  Room room = unit_cube(0.5, isotropic(move + glm::dvec3(0.5)));
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& p : surface.positions) p += move;
  }
  const Result result = simulate_it(room);
  const RoomPainter painter(room, result);
  const Folder folder;
  const std::string bytes =
      lit_room_glb(room, result, painter.lit_sides(), choose_scale(result), trace_paths(room, result.settings, 3));
  CHECK(bytes.find("\"offset_m\":[691609.0,521.0,-5334760.0]") != std::string::npos);
  std::ofstream(folder.path() / "room_lit.glb", std::ios::binary) << bytes;
  const Room lit = read_gltf(folder.path() / "room_lit.glb");
  for (const Surface& surface : lit.surfaces) {
    CHECK(surface_area(surface) == Approx(1.0).epsilon(1e-6));
    for (const glm::dvec3& p : surface.positions) {
      const glm::dvec3 local = p - move;
      for (int k = 0; k < 3; ++k) CHECK(std::min(std::abs(local[k]), std::abs(local[k] - 1.0)) < 1e-6);
    }
  }
}

TEST_CASE("svg: text is escaped, and control characters that XML does not allow are visible") {
  CHECK(escaped("a<b>&\"c\x01\t\xC3\xBC") == "a&lt;b&gt;&amp;&quot;c\\u0001\t\xC3\xBC");
  CHECK(escaped("\xE2\x80\xAE\xFF") == "\\u202e\\xff");
}
