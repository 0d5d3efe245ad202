// Files of calculation areas: plans, tables, drawings, and the comparison of designs.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "base/csv.hpp"
#include "lichtmc/area_drawing.hpp"
#include "lichtmc/compare.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/output.hpp"
#include "output/area_dxf.hpp"
#include "output/area_plan.hpp"
#include "output/area_tables.hpp"
#include "output/area_words.hpp"
#include "support/area_results.hpp"
#include "support/catch.hpp"
#include "support/small_result.hpp"

namespace {

using namespace lichtmc;
using namespace lichtmc::test;

// 100 lx + 50 lx/m · x: its isolux lines are straight, at x = (level − 100)/50.
double rising_along_x(const glm::dvec3& p) {
  return 100.0 + 50.0 * p.x;
}

AreaSketch level_sketch() {
  return {.name = "plane",
          .role = "task",
          .corner = {0.0, 0.5, 1.0},
          .u = {0.5, 0.0, 0.0},
          .v = {0.0, 0.0, 0.4},
          .columns = 8,
          .rows = 5,
          .standard_error = 0.5};
}

Result photometric_result() {
  Result result = make_result();
  result.quantity = Quantity::photometric;
  return result;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::vector<std::string>> rows_of(const std::string& table) {
  std::istringstream in(table);
  CsvReader reader(in, ',');
  std::vector<std::vector<std::string>> rows;
  for (CsvRow row; reader.next(row);) {
    std::vector<std::string>& fields = rows.emplace_back();
    for (const CsvField& field : row.fields) fields.push_back(field.text);
  }
  return rows;
}

}  // namespace

TEST_CASE("isolux lines of a field that rises evenly are exact, at round levels") {
  Result result = photometric_result();
  add_area(result, level_sketch(), rising_along_x);
  const AreaDrawing drawing = draw_area(make_room(), result, 0);
  std::set<double> levels;
  for (const Isoline& line : drawing.isolines) {
    levels.insert(line.level);
    for (const glm::dvec2& p : line.points) CHECK(std::abs(p.x - (line.level - 100.0) / 50.0) < 1e-12);
    // From the first row of points to the last.
    const auto [low, high] = std::minmax_element(line.points.begin(), line.points.end(),
                                                 [](const glm::dvec2& a, const glm::dvec2& b) { return a.y < b.y; });
    CHECK(std::abs(low->y - 1.2) < 1e-12);
    CHECK(std::abs(high->y - 2.8) < 1e-12);
  }
  // The values are 112.5 … 287.5.
  CHECK(levels == std::set<double>{150.0, 200.0, 250.0});
}

TEST_CASE("open pieces of isolux lines shorter than a cell are left out") {
  Result result = photometric_result();
  // Flat but for one corner, whose lines cut off that corner alone.
  const auto value = [](const glm::dvec3& p) { return p.x < 0.3 && p.z < 1.3 ? 300.0 : 100.0; };
  add_area(result, level_sketch(), value);
  const AreaDrawing drawing = draw_area(make_room(), result, 0);
  REQUIRE_FALSE(drawing.isolines.empty());
  for (const Isoline& line : drawing.isolines) CHECK(line.level == 150.0);  // those of 200 and 250 are shorter
}

TEST_CASE("numbers of a plan lie over its lines, with a halo in the colour of their cells") {
  Result result = photometric_result();
  add_area(result, level_sketch(), rising_along_x);
  const std::string svg = area_plan_svg(make_room(), result, 0, choose_area_scale(result, 0));
  CHECK(svg.rfind("<polyline") < svg.find("paint-order=\"stroke\">"));
  CHECK_THAT(svg, ContainsSubstring("stroke-width=\"6.0\" stroke-linejoin=\"round\" paint-order=\"stroke\">"));
}

TEST_CASE("values that differ by their errors alone have no isolux lines") {
  Result result = photometric_result();
  AreaSketch sketch = level_sketch();
  sketch.standard_error = 80.0;
  add_area(result, sketch, rising_along_x);
  const AreaDrawing drawing = draw_area(make_room(), result, 0);
  CHECK(drawing.isolines.empty());
  CHECK(drawing.why_no_isolines == "No isolines: the values differ by no more than their errors.");
}

TEST_CASE("an area lies on its sheet as a plan does, however its grid is stored") {
  Result result = photometric_result();
  const auto value = [](const glm::dvec3& p) { return 10.0 * p.x + p.z; };
  add_area(result, level_sketch(), value);
  // The same cells, counted along −z from the right.
  AreaSketch turned = level_sketch();
  turned.corner = {4.0, 0.5, 3.0};
  turned.u = {0.0, 0.0, -0.4};
  turned.v = {-0.5, 0.0, 0.0};
  std::swap(turned.columns, turned.rows);
  add_area(result, turned, value);
  const AreaDrawing one = draw_area(make_room(), result, 0);
  const AreaDrawing other = draw_area(make_room(), result, 1);
  CHECK(one.right == glm::dvec3(1.0, 0.0, 0.0));
  CHECK(one.down == glm::dvec3(0.0, 0.0, 1.0));
  CHECK(one.arrow == glm::dvec2(0.0, -1.0));
  REQUIRE(other.values.size() == one.values.size());
  for (std::size_t k = 0; k < one.values.size(); ++k) CHECK(std::abs(one.values[k] - other.values[k]) < 1e-9);
  CHECK(one.columns == other.columns);
  CHECK(one.lowest_cell == other.lowest_cell);
  CHECK(glm::length(one.upper_left(result.areas[0].area) - glm::dvec3(0.0, 0.5, 1.0)) < 1e-12);
  CHECK(glm::length(other.upper_left(result.areas[1].area) - glm::dvec3(0.0, 0.5, 1.0)) < 1e-12);
}

TEST_CASE("an area on a wall is drawn from the side of its normal, upright") {
  Result result = photometric_result();
  // A wall that faces −x: whoever looks at it has +z on the right.
  AreaSketch wall{.name = "wall",
                  .role = "wall",
                  .corner = {3.0, 0.0, 0.0},
                  .u = {0.0, 0.0, 0.5},
                  .v = {0.0, 0.5, 0.0},
                  .normal = {-1.0, 0.0, 0.0},
                  .columns = 4,
                  .rows = 3};
  add_area(result, wall, [](const glm::dvec3& p) { return 100.0 * p.y + p.z; });
  const AreaDrawing drawing = draw_area(make_room(), result, 0);
  CHECK_FALSE(drawing.level);
  CHECK(drawing.right == glm::dvec3(0.0, 0.0, 1.0));
  CHECK(drawing.down == glm::dvec3(0.0, -1.0, 0.0));
  CHECK(drawing.arrow == glm::dvec2(0.0, -1.0));
  CHECK(drawing.section.empty());
  CHECK(drawing.values[0] == 125.25);  // upper left: y = 1.25, z = 0.25
}

TEST_CASE("the section of a room at the height of an area is its outline") {
  Result result = photometric_result();
  AreaSketch sketch = level_sketch();
  sketch.corner = {0.0, 0.5, 0.0};
  sketch.u = {0.125, 0.0, 0.0};
  sketch.v = {0.0, 0.0, 0.2};
  add_area(result, sketch, rising_along_x);
  const AreaDrawing drawing = draw_area(make_room(), result, 0);  // a cuboid of 1 m × 1 m × 1 m
  double length = 0.0;
  for (const auto& [a, b] : drawing.section) {
    length += glm::length(b - a);
    const bool on_wall = (a.x == b.x && (a.x == 0.0 || a.x == 1.0)) || (a.y == b.y && (a.y == 0.0 || a.y == 1.0));
    CHECK(on_wall);
  }
  CHECK(std::abs(length - 4.0) < 1e-12);
}

TEST_CASE("the plan of an area has its figures and numbers as text") {
  Result result = photometric_result();
  AreaResult& area = add_area(result, level_sketch(), [](const glm::dvec3& p) { return 301.2 + 50.0 * p.x; });
  set_targets(area, 500.0, 0.6);
  area.area.above_floor_m = 0.75;
  const std::string svg = area_plan_svg(make_room(), result, 0, choose_area_scale(result, 0));
  CHECK_THAT(svg, ContainsSubstring(">plane (task)</text>"));
  CHECK_THAT(svg, ContainsSubstring(">Em 401.2 ± 0.5 lx, U0 0.782 ± 0.002, target 500 lx, 0.60: fail (Em)</text>"));
  CHECK_THAT(svg, ContainsSubstring("horizontal illuminance, 0.75 m above the floor"));
  for (const char* number : {">314</text>", ">339</text>", ">489</text>"}) CHECK_THAT(svg, ContainsSubstring(number));
  CHECK_THAT(svg, ContainsSubstring(">4 m</text>"));
  CHECK_THAT(svg, ContainsSubstring("framed: the lowest and the highest"));
  CHECK(svg.ends_with("</svg>\n"));
}

TEST_CASE("a fine grid has as many numbers as there is space for, and its plan says which") {
  Result result = photometric_result();
  AreaSketch hall = level_sketch();
  hall.u = {1.0, 0.0, 0.0};
  hall.v = {0.0, 0.0, 1.0};
  hall.columns = 50;
  hall.rows = 20;
  hall.has_point = [](std::uint32_t column, std::uint32_t row) { return column != 7 || row != 3; };
  add_area(result, hall, rising_along_x);
  const std::string svg = area_plan_svg(Room{}, result, 0, choose_area_scale(result, 0));
  CHECK_THAT(svg, ContainsSubstring("1 of 1000 cells has no point: 1 inside"));
  CHECK_THAT(svg, ContainsSubstring("of every "));
  const auto texts = static_cast<std::size_t>(std::count(svg.begin(), svg.end(), '\n'));
  CHECK(texts < 1500);
}

TEST_CASE("small values are written with a factor, and radiant ones without the words of lighting") {
  Result result = photometric_result();
  result.quantity = Quantity::radiometric;
  add_area(result, level_sketch(), [](const glm::dvec3& p) { return 1e-5 * (1.0 + p.x); });
  result.areas[0].area.properties.target_uniformity = 0.4;
  const std::string svg = area_plan_svg(make_room(), result, 0, choose_area_scale(result, 0));
  CHECK_THAT(svg, ContainsSubstring("in 0.000001 W/m²"));
  CHECK_THAT(svg, ContainsSubstring(">12.5</text>"));
  CHECK_THAT(area_line(result.areas[0], result.quantity), ContainsSubstring("target uniformity 0.40"));
  CHECK(area_line(result.areas[0], result.quantity).find("Em") == std::string::npos);
}

TEST_CASE("a verdict says which of two targets fails, and which is undecided") {
  using lichtmc::Verdict;
  const auto words = [](Verdict all, Verdict mean, Verdict uniformity, Quantity quantity = Quantity::photometric) {
    return verdict_text(all, mean, uniformity, quantity);
  };
  CHECK(words(Verdict::pass, Verdict::pass, Verdict::pass) == "pass");
  CHECK(words(Verdict::fail, Verdict::fail, Verdict::fail) == "fail");
  CHECK(words(Verdict::fail, Verdict::fail, Verdict::none) == "fail");
  CHECK(words(Verdict::fail, Verdict::fail, Verdict::pass) == "fail (Em)");
  CHECK(words(Verdict::fail, Verdict::pass, Verdict::fail) == "fail (U0)");
  CHECK(words(Verdict::fail, Verdict::fail, Verdict::undecided) == "fail (Em; U0 undecided)");
  CHECK(words(Verdict::fail, Verdict::undecided, Verdict::fail) == "fail (U0; Em undecided)");
  CHECK(words(Verdict::undecided, Verdict::pass, Verdict::undecided) == "undecided (U0)");
  CHECK(words(Verdict::fail, Verdict::fail, Verdict::undecided, Quantity::radiometric) ==
        "fail (mean; uniformity undecided)");
}

TEST_CASE("figures are written to the first digit of their errors, rounded up") {
  CHECK(figure_text({349.24, 1.7}) == "349 ± 2");
  CHECK(figure_text({0.5512, 0.0042}, 3) == "0.551 ± 0.005");
  CHECK(figure_text({0.5512, 0.0421}, 3) == "0.55 ± 0.05");
  CHECK(figure_text({349.24, 0.001}) == "349.2 ± 0.1");
  CHECK(figure_text({12345.0, 120.0}) == "12300 ± 200");
  CHECK(figure_text({349.24, 0.0}) == "349.2");
  CHECK(figure_text({349.24, std::nan("")}) == "349");
  CHECK(figure_text({}) == "–");
}

TEST_CASE("a drawing for CAD programs has isolux lines at their levels, in the coordinates of a plan") {
  Result result = photometric_result();
  add_area(result, level_sketch(), rising_along_x);
  result.areas[0].area.properties.name = "büro ±";
  const std::string dxf = area_dxf(result, 0, draw_area(make_room(), result, 0));
  std::istringstream in(dxf);
  std::map<std::string, std::size_t> entities;
  std::set<std::string> declared;
  std::string section;
  std::string entity;
  std::string layer;
  for (std::string code, value; std::getline(in, code);) {
    REQUIRE(std::getline(in, value));
    REQUIRE_NOTHROW(std::stoi(code));
    for (const char c : value) REQUIRE((c >= 0x20 && c < 0x7F));
    if (code == "0") entity = value;
    if (code == "2" && entity == "SECTION") section = value;
    if (code == "2" && entity == "LAYER") declared.insert(value);
    if (section != "ENTITIES") continue;
    if (code == "0") ++entities[value];
    if (code == "8") {
      layer = value;
      CHECK(declared.contains(layer));
    }
    if (entity == "VERTEX" && code == "10") {
      const double level = std::stod(layer.substr(std::string("ISOLUX_").size()));
      CHECK(std::abs(std::stod(value) - (level - 100.0) / 50.0) < 1e-6);
    }
    if (entity == "VERTEX" && code == "20") CHECK((std::stod(value) <= -1.2 && std::stod(value) >= -2.8));  // −z
  }
  CHECK(declared ==
        std::set<std::string>{"0", "AREA", "ISOLUX_150", "ISOLUX_200", "ISOLUX_250", "NUMBERS", "ROOM", "TITLE"});
  CHECK(entities["POLYLINE"] == 3);
  CHECK(entities["SEQEND"] == 3);
  CHECK(entities["TEXT"] == 40 + 3 + 3);  // numbers, levels, title
  CHECK(entities["LINE"] >= 4 + 4);       // outline, walls
  CHECK(entities["EOF"] == 1);
  CHECK_THAT(dxf, ContainsSubstring("\nb\\U+00FCro %%p (task)\n"));
}

TEST_CASE("areas.csv has the documented columns") {
  Result result = photometric_result();
  set_targets(add_area(result, level_sketch(), rising_along_x), 500.0, 0.4);
  AreaSketch second = level_sketch();
  second.name = "a, \"b\"";
  second.role = "";
  second.has_point = [](std::uint32_t column, std::uint32_t) { return column > 0; };
  add_area(result, second, rising_along_x);
  const auto rows = rows_of(areas_csv(result));
  REQUIRE(rows.size() == 3);
  const std::vector<std::string> first{
      "area",    "role", "quantity", "points", "left_out", "em", "em_se",     "emin",
      "emin_se", "emax", "emax_se",  "u0",     "u0_se",    "ud", "target_lx", "target_uniformity",
      "verdict"};
  REQUIRE(rows[0].size() > first.size());
  CHECK(std::equal(first.begin(), first.end(), rows[0].begin()));
  CHECK(rows[1][0] == "plane");
  CHECK(rows[1][2] == "horizontal");
  CHECK(rows[1][3] == "40");
  CHECK(rows[1][4] == "0");
  CHECK(std::stod(rows[1][5]) == 200.0);
  CHECK(std::stod(rows[1][7]) == 112.5);
  CHECK(rows[1][14] == "500");
  CHECK(rows[1][16] == "fail");
  CHECK(rows[2][0] == "a, \"b\"");
  CHECK(rows[2][4] == "5");
  CHECK(rows[2][14].empty());
  CHECK(rows[2][16].empty());
  CHECK(rows[2].back() == "lx");
}

TEST_CASE("the grid of an area is a table with places, values and errors") {
  Result result = photometric_result();
  AreaSketch sketch = level_sketch();
  sketch.has_point = [](std::uint32_t column, std::uint32_t row) { return column != 1 || row != 2; };
  add_area(result, sketch, [](const glm::dvec3& p) { return 1000.0 * p.x + p.z; });
  const auto rows = rows_of(area_grid_csv(result, 0, draw_area(make_room(), result, 0)));
  const auto block = [&rows](const std::string& heading) {
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row[0] == heading; });
    REQUIRE(at != rows.end());
    return static_cast<std::size_t>(at - rows.begin());
  };
  CHECK(rows[3] == std::vector<std::string>{"upper left corner (x y z in m)", "0", "0.5", "1"});
  const std::size_t values = block("illuminance (lx)");
  CHECK(rows[values + 1][1] == "0.25");
  CHECK(rows[values + 1].size() == 9);
  CHECK(rows[values + 3][0] == "0.6");
  CHECK(std::stod(rows[values + 3][3]) == 1250.0 + 1.6);  // third column, second row
  CHECK(rows[values + 4][2].empty());
  const std::size_t errors = block("standard error (lx)");
  CHECK(std::stod(rows[errors + 2][1]) == 0.5);
  CHECK(rows[errors + 4][2].empty());
}

TEST_CASE("the files of areas are written, listed in the summary, and removed when the areas vanish") {
  const Folder folder;
  Result result = photometric_result();
  set_targets(add_area(result, level_sketch(), rising_along_x), 150.0, 0.4);
  AreaSketch second = level_sketch();
  second.name = "Plane/1";
  add_area(result, second, rising_along_x);
  const Room room = make_room();
  write_results(room, result, folder.path());
  const std::filesystem::path areas = folder.path() / "areas";
  for (const char* name : {"plane", "Plane_1"}) {
    for (const char* ending : {".csv", ".svg", ".dxf"})
      CHECK(std::filesystem::exists(areas / (std::string(name) + ending)));
  }
  const auto summary = nlohmann::json::parse(text_of(folder.path() / "summary.json"));
  REQUIRE(summary["areas"].size() == 2);
  const auto& one = summary["areas"][0];
  CHECK(one["em"] == 200.0);
  CHECK(one["em_se"] == 0.5);
  CHECK(one["verdict"] == "pass");
  CHECK(one["files"][0] == "areas/plane.csv");
  CHECK(one["lowest_at"][0] == 0.25);
  CHECK(summary["areas"][1]["verdict"].is_null());
  CHECK(summary["areas"][1]["files"][1] == "areas/Plane_1.svg");
  CHECK(summary["units"]["em"] == "lx");

  std::ofstream(areas / "mine.txt") << "of the user";
  result.areas.pop_back();
  write_results(room, result, folder.path());
  CHECK(std::filesystem::exists(areas / "plane.dxf"));
  CHECK_FALSE(std::filesystem::exists(areas / "Plane_1.dxf"));
  result.areas.clear();
  write_results(room, result, folder.path());
  CHECK_FALSE(std::filesystem::exists(folder.path() / "areas.csv"));
  CHECK_FALSE(std::filesystem::exists(areas / "plane.csv"));
  CHECK(std::filesystem::exists(areas / "mine.txt"));
  CHECK(nlohmann::json::parse(text_of(folder.path() / "summary.json"))["areas"].empty());
}

TEST_CASE("two designs are shown side by side, with differences and their errors") {
  const Folder a;
  const Folder b;
  const Room room = make_room();
  Result today = photometric_result();
  set_targets(add_area(today, level_sketch(), rising_along_x), 210.0, 0.5);
  AreaSketch old_area = level_sketch();
  old_area.name = "shelf";
  add_area(today, old_area, rising_along_x);
  write_results(room, today, a.path());
  Result proposal = photometric_result();
  set_targets(add_area(proposal, level_sketch(), [](const glm::dvec3& p) { return 20.0 + rising_along_x(p); }), 210.0,
              0.5);
  AreaSketch new_area = level_sketch();
  new_area.name = "corridor";
  add_area(proposal, new_area, rising_along_x);
  write_results(room, proposal, b.path());

  const DesignComparison designs = compare_designs(a.path(), b.path());
  REQUIRE(designs.areas.size() == 3);
  CHECK(designs.areas[0].mean_difference.value == 20.0);
  CHECK(std::abs(designs.areas[0].mean_difference.standard_error - 0.5 * std::sqrt(2.0)) < 1e-12);
  CHECK(designs.areas[0].a->verdict == lichtmc::Verdict::fail);
  CHECK(designs.areas[0].b->verdict == lichtmc::Verdict::pass);
  CHECK_FALSE(designs.areas[1].b.has_value());
  CHECK(designs.areas[2].b->name == "corridor");
  CHECK_FALSE(designs.total_a.watts.has_value());
  const std::string text = designs_text(designs);
  CHECK_THAT(text, ContainsSubstring("plane (task)"));
  CHECK_THAT(text, ContainsSubstring("+20.0 ± 0.8"));
  CHECK_THAT(text, ContainsSubstring("missing"));
  CHECK_THAT(text, ContainsSubstring("target 210 lx, 0.50"));
}

TEST_CASE("two designs tell heights, maintenance factors and which target fails") {
  const Folder a;
  const Folder b;
  Room room = make_room();
  room.quantity = Quantity::photometric;
  Result today = photometric_result();
  AreaResult& plane = add_area(today, level_sketch(), rising_along_x);
  set_targets(plane, 210.0, 0.5);
  plane.area.above_floor_m = 0.75;
  add_area(today, level_sketch(), rising_along_x).area.properties.name = "board";
  write_results(room, today, a.path());
  Result proposal = photometric_result();
  add_area(proposal, level_sketch(), rising_along_x).area.above_floor_m = 0.85;
  AreaResult& board = add_area(proposal, level_sketch(), rising_along_x);
  board.area.properties.name = "board";
  set_targets(board, 100.0, 0.9);
  for (Emitter& emitter : room.emitters) emitter.maintenance_factor = 0.8;
  write_results(room, proposal, b.path());

  const DesignComparison designs = compare_designs(a.path(), b.path());
  CHECK(designs.areas[0].a->mean_verdict == lichtmc::Verdict::fail);
  CHECK(designs.areas[0].a->uniformity_verdict == lichtmc::Verdict::pass);
  CHECK(designs.areas[0].b->above_floor_m == 0.85);
  CHECK(designs.total_b.least_maintenance_factor == 0.8);
  // One line each, without the blanks of columns.
  std::string text = designs_text(designs);
  for (std::size_t at = text.find("  "); at != std::string::npos; at = text.find("  ", at)) text.erase(at, 1);
  CHECK_THAT(text, ContainsSubstring("\n target 210 lx, 0.50: fail (Em) –\n"));
  CHECK_THAT(text, ContainsSubstring("\n target – 100 lx, 0.90: fail (U0)\n"));
  CHECK_THAT(text, ContainsSubstring("\n height, m 0.75 0.85 +0.1\n"));
  CHECK_THAT(text, ContainsSubstring("\nmaintenance factor 1 0.8\n"));
  CHECK_THAT(text, ContainsSubstring("The maintenance factors differ"));
}

TEST_CASE("results without areas cannot be compared as designs") {
  const Folder with;
  const Folder without;
  const Room room = make_room();
  Result result = photometric_result();
  write_results(room, result, without.path());
  add_area(result, level_sketch(), rising_along_x);
  write_results(room, result, with.path());
  CHECK_THROWS_WITH(compare_designs(with.path(), without.path()),
                    ContainsSubstring("has no calculation areas") && ContainsSubstring("--plane"));
  CHECK_THROWS_AS(compare_designs(with.path(), with.path() / "nowhere"), InputError);
}
