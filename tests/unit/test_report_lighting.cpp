// The pages of a lighting report, of artificial results of calculation areas.
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "lichtmc/lichtmc.hpp"
#include "output/lit_side_words.hpp"
#include "output/tile_extremes.hpp"
#include "support/area_results.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/small_result.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
namespace fs = std::filesystem;

namespace {

std::string page_in(const fs::path& folder) {
  std::ifstream in(folder / "report.html", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The body of a page up to the technical details, without the pixels of pictures.
std::string client_part(const std::string& page) {
  const std::size_t begin = page.find("<main>");
  std::string text = page.substr(begin, page.find("class=\"appendix\"") - begin);
  for (std::size_t at = text.find("base64,"); at != std::string::npos; at = text.find("base64,", at + 1))
    text.erase(at, text.find('"', at) - at);
  return text;
}

Room lit_room(Quantity quantity = Quantity::photometric) {
  Room room = make_cuboid({4.0, 2.5, 3.0}, uniform_reflectance(0.5));
  room.source = "some/folder/office <1>.glb";
  room.quantity = quantity;
  room.emitters = {isotropic({1.0, 2.0, 1.5}, 1000.0), isotropic({3.0, 2.0, 1.5}, 1000.0),
                   lambert({2.0, 2.4, 1.5}, {0.0, -1.0, 0.0}, 1.0, 500.0)};
  return room;
}

AreaSketch sketch_of(const std::string& name) {
  AreaSketch sketch;
  sketch.name = name;
  sketch.role = "task";
  sketch.corner = {0.5, 0.75, 0.5};
  sketch.u = {0.5, 0.0, 0.0};
  sketch.v = {0.0, 0.0, 0.5};
  sketch.columns = 6;
  sketch.rows = 4;
  sketch.standard_error = 1.7;
  return sketch;
}

// Three areas: one passes, one fails, one is undecided.
Result result_with_areas(const Room& room, Measured measured) {
  Settings settings = settings_of(Estimator::collision, Engine::automatic, 2e4, 1, 0.25);
  settings.measured = measured;
  Room with_receiver = room;
  if (measured == Measured::receivers) with_receiver.receivers.push_back({"door <knob>", {0.1, 1.0, 0.1}});
  Result result = simulate(with_receiver, settings);
  result.room = room.source;
  const auto value = [](const glm::dvec3& point) { return 300.0 + 40.0 * point.x; };
  set_targets(add_area(result, sketch_of("desk & chair"), value), 300.0, 0.6);
  set_targets(add_area(result, sketch_of("board"), value), 500.0, 0.7);
  AreaResult& table = add_area(result, sketch_of("table"), value);
  set_targets(table, 380.0, 0.6);
  table.mean_verdict = table.verdict = lichtmc::Verdict::undecided;
  return result;
}

std::string page_of(const Room& room, const Result& result, const ReportOptions& options = {}) {
  const Folder folder;
  write_report(room, result, folder.path(), options);
  return page_in(folder.path());
}

}  // namespace

TEST_CASE("lighting report: the first page has title, verdicts, figures with errors, targets and plans") {
  const Room room = lit_room();
  ReportOptions options;
  options.project = "School <A> & B";
  options.author = "Jane \"Doe\"";
  options.date = "27 November 2026";
  const std::string page = page_of(room, result_with_areas(room, Measured::tiles), options);
  const std::string first = client_part(page);
  CHECK(has(page, "<title>School &lt;A&gt; &amp; B</title>"));
  for (const char* text : {"<dd>School &lt;A&gt; &amp; B</dd>", "<dd>office &lt;1&gt;.glb</dd>",
                           "<dd>Jane &quot;Doe&quot;</dd>", "<dd>27 November 2026</dd>"}) {
    INFO(text);
    CHECK(has(first, text));
  }
  CHECK(has(first, "Not all targets are reached."));
  CHECK(has(first, "Fails: board (Em)."));
  CHECK(has(first, "Undecided within its error: table (Em)."));
  CHECK(has(first, "Passes: desk &amp; chair."));
  CHECK(count_of(first, "✓ pass") == 1);
  CHECK(count_of(first, "✗ fail") == 1);
  CHECK(count_of(first, "? undecided") == 1);
  CHECK(has(first, "380 ± 2"));  // Em: 300 + 40 · 2
  CHECK(has(first, "≥ 500"));
  CHECK(has(first, "≥ 0.60"));
  CHECK(count_of(first, "class=\"area-plan\"") == 3);
  CHECK(has(first, "Maintenance factor 1"));
  // In this order: areas, luminaires, pictures, surfaces, method; then the technical report.
  std::size_t at = 0;
  for (const char* part : {"id=\"areas\"", "class=\"area-plan\"", "id=\"sources\"", "id=\"picture-room\"",
                           "id=\"lit-surfaces\"", "How this was calculated", "Technical details", "id=\"area-details\"",
                           "id=\"surfaces\"", "Balance of the luminous flux", "Convergence", "To reproduce this"}) {
    INFO(part);
    const std::size_t found = page.find(part, at);
    REQUIRE(found != std::string::npos);
    at = found;
  }
}

TEST_CASE("lighting report: what only concerns the run is not on the pages for a client") {
  Room room = lit_room();
  Result result = result_with_areas(room, Measured::tiles);
  result.warnings = {"15916 tiles got no light."};
  const std::string page = page_of(room, result);
  const std::string first = client_part(page);
  for (const char* word : {"gain", "dB", "on the back", "tiles got no light", "irradiance", "W/m²", "photons in"}) {
    INFO(word);
    CHECK_FALSE(has(first, word));
  }
  CHECK(has(page, "15916 tiles got no light."));
  CHECK(has(first, "<a href=\"#remarks\">"));
  CHECK(has(page, "id=\"remarks\""));
  CHECK_FALSE(has(page, "gain, dB"));
  CHECK_FALSE(has(page, "on the back, %"));
  CHECK(has(first, "facing up"));
  CHECK(has(first, "facing down"));
}

TEST_CASE("lighting report: maintained values have the initial ones beside them") {
  Room room = lit_room();
  for (Emitter& emitter : room.emitters) emitter.maintenance_factor = 0.8;
  Result result = result_with_areas(room, Measured::tiles);
  result.areas[0].initial_mean = {result.areas[0].mean.value / 0.8, 2.0};
  const std::string first = client_part(page_of(room, result));
  CHECK(has(first, "initially 475 ± 2 lx"));
  CHECK(has(first,
            "Maintained values: maintenance factor 0.8, the part of the luminous flux when new that remains; initial"));
  room.emitters[0].maintenance_factor = 0.67;
  CHECK(
      has(client_part(page_of(room, result)),
          "Maintained values: maintenance factors 0.67 to 0.8, the part of the luminous flux when new that remains."));
}

TEST_CASE("lighting report: areas alone have pictures too, and other receivers a table without gains") {
  const Room room = lit_room();
  Room with_receiver = room;
  with_receiver.receivers.push_back({"door <knob>", {0.1, 1.0, 0.1}});
  const Result result = result_with_areas(room, Measured::receivers);
  REQUIRE(result.tiles.empty());
  const Folder folder;
  write_report(with_receiver, result, folder.path());
  const std::string page = page_in(folder.path());
  CHECK(has(page, "id=\"picture-room\""));
  CHECK(has(page, "Illuminance on the calculation areas, "));
  CHECK(count_of(page, "<polygon") >= 2 * 3 * 24);  // each cell in both pictures
  CHECK(has(page, "id=\"materials\""));
  CHECK(has(page, "door &lt;knob&gt;"));
  CHECK(count_of(page, "<td class=\"text\">desk &amp; chair</td>") == 0);  // its points are in its plan
  CHECK_FALSE(has(page, "gain, dB"));
  CHECK(fs::exists(folder.path() / "pictures" / "room.svg"));
  CHECK_FALSE(fs::exists(folder.path() / "room_lit.glb"));
}

TEST_CASE("lighting report: the mean of receivers is without the points of areas") {
  const Room room = lit_room();
  const Result with = result_with_areas(room, Measured::receivers);
  CHECK(has(page_of(room, with), "mean of 1 receiver, standard error of each"));
  CHECK_FALSE(has(page_of(room, result_with_areas(room, Measured::tiles)), "mean of "));
}

TEST_CASE("pictures from above: areas that look down do not hide others") {
  const Room room = lit_room();
  Result result = result_with_areas(room, Measured::receivers);
  AreaSketch ceiling = sketch_of("under the ceiling");
  ceiling.corner.y = 2.5;
  ceiling.normal = {0.0, -1.0, 0.0};
  add_area(result, ceiling, [](const glm::dvec3&) { return 50.0; });
  const Folder folder;
  write_report(room, result, folder.path(), {});
  const auto picture = [&folder](const char* name) {
    std::ifstream in(folder.path() / "pictures" / name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string above = picture("above.svg");
  CHECK(count_of(above, "<polygon points") == 3 * 24);
  CHECK(has(above, ">board</text>"));
  CHECK_FALSE(has(above, "under the ceiling"));
  CHECK(has(above, "areas that face down are left out"));
  CHECK(has(picture("room.svg"), "under the ceiling"));
}

TEST_CASE("report style: by the areas, unless it is chosen") {
  const Room room = lit_room();
  const Result with_areas = result_with_areas(room, Measured::tiles);
  Result without = with_areas;
  without.areas.clear();
  ReportOptions options;
  CHECK(has(page_of(room, with_areas), "class=\"appendix\""));
  CHECK_FALSE(has(page_of(room, without), "class=\"appendix\""));
  options.style = ReportStyle::technical;
  const std::string technical = page_of(room, with_areas, options);
  CHECK_FALSE(has(technical, "class=\"appendix\""));
  CHECK(has(technical, "id=\"areas\""));
  CHECK(has(technical, "on the back, %"));
  options.style = ReportStyle::lighting;
  const std::string lighting = page_of(room, without, options);
  CHECK(has(lighting, "class=\"appendix\""));
  CHECK(has(lighting, "No calculation area was defined"));
}

TEST_CASE("lighting report: radiant quantities have their own words") {
  const Room room = lit_room(Quantity::radiometric);
  const std::string page = page_of(room, result_with_areas(room, Measured::tiles));
  const std::string first = client_part(page);
  CHECK(has(first, "<h1>Irradiance calculation</h1>"));
  CHECK(has(first, "target, W/m²"));
  for (const char* word : {"lluminance", "Em", "U0", " lx"}) {
    INFO(word);
    CHECK_FALSE(has(first, word));
  }
}

TEST_CASE("report: a page's foot is a string of CSS, whatever the project is called") {
  const Room room = lit_room();
  ReportOptions options;
  options.project = "a\"; } </style> \\ ü";
  const std::string page = page_of(room, result_with_areas(room, Measured::tiles), options);
  CHECK(count_of(page, "</style>") == count_of(page, "<svg xmlns") + 1);  // the page and each picture
  CHECK(has(page, R"(content: "a\22 \3b  \7d  \3c \2f style\3e  \5c  ü")"));
}

TEST_CASE("tile extremes: tiles with few hits do not determine them, but their limits do") {
  Result result = make_result();  // tile 2 of the first map has irradiance 0
  const auto tile = [&result](std::size_t k, double irradiance, double error) {
    result.tiles[k].irradiance = irradiance;
    result.tiles[k].standard_error = error;
  };
  tile(0, 100.0, 10.0);
  tile(1, 120.0, 10.0);
  tile(2, 0.0, 80.0);     // may be as bright as the others
  tile(3, 500.0, 400.0);  // one hit
  tile(4, 90.0, 5.0);
  TileExtremes extremes = tile_extremes(result).front();
  CHECK(extremes.minimum == 90.0);
  CHECK(extremes.maximum == 120.0);
  CHECK_FALSE((extremes.below || extremes.above));
  tile(2, 0.0, 20.0);     // certainly below 40
  tile(3, 500.0, 150.0);  // certainly above 200
  extremes = tile_extremes(result).front();
  CHECK(extremes.minimum == 40.0);
  CHECK(extremes.maximum == 200.0);
  CHECK((extremes.below && extremes.above));
  result.unreached.assign(result.tiles.size(), false);
  result.unreached[2] = true;
  CHECK(tile_extremes(result).front().minimum == 90.0);
}

TEST_CASE("lit sides: in words, by the triangles that get light") {
  const Room room = lit_room();
  Result result;
  result.tiling = make_tiling(room, 0.5);
  LitSides lit;
  for (const Surface& surface : room.surfaces) lit.emplace_back(surface.triangles.size(), SideLight{true, false});
  const std::vector<std::string> words = lit_side_words(room, result, lit);
  for (std::size_t m = 0; m < words.size(); ++m) {
    const std::string& name = result.tiling.maps[m].name;
    INFO(name << ": " << words[m]);
    if (name == "floor") CHECK(words[m] == "facing up");
    if (name == "ceiling") CHECK(words[m] == "facing down");
    if (name != "floor" && name != "ceiling")
      CHECK((words[m].ends_with("+x") || words[m].ends_with("−x") || words[m].ends_with("+z") ||
             words[m].ends_with("−z")));
  }
  for (auto& surface : lit) surface.assign(surface.size(), {true, true});
  CHECK(lit_side_words(room, result, lit).front() == "both sides");
  for (auto& surface : lit) surface.assign(surface.size(), {false, false});
  CHECK(lit_side_words(room, result, lit).front() == "none");
}
