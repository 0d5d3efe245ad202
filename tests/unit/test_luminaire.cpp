// Figures, pictures and tables of luminaires.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/message.hpp"
#include "chance/candela_zones.hpp"
#include "lichtmc/lichtmc.hpp"
#include "output/luminaire_schedule.hpp"
#include "output/polar_diagram.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/small_result.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> angles(double from, double to, double step) {
  std::vector<double> list;
  for (int k = 0; from + k * step <= to + 1e-9; ++k) list.push_back(from + k * step);
  return list;
}

// Intensity(horizontal, vertical) in degrees, at the angles of a grid.
template <class Intensity>
std::shared_ptr<const CandelaTable> table_of(CandelaTable::Grid grid, const Intensity& intensity) {
  for (const double h : grid.horizontal_deg) {
    for (const double v : grid.vertical_deg) grid.candela.push_back(intensity(h, v));
  }
  return std::make_shared<const CandelaTable>(std::move(grid));
}

CandelaTable::Grid rotational(double to, double step) {
  return {PhotometricType::c, PhotometricSymmetry::rotational, {0.0}, angles(0.0, to, step), {}, false};
}

double lambert(double vertical) {
  return std::max(0.0, std::cos(vertical * pi / 180.0));
}

Photometry photometry_of_table(std::shared_ptr<const CandelaTable> table) {
  Photometry photometry;
  photometry.source = "folder/lamp.ies";
  photometry.version = "LM-63-2002";
  photometry.manufacturer = "Maker <&> Co";
  photometry.luminaire = "Panel";
  photometry.candela = std::move(table);
  photometry.intensity_unit = "cd";
  photometry.absolute = true;
  photometry.lamp_sets = {LampSet{}};
  photometry.watts = 2.0;
  return photometry;
}

Photometry lambert_photometry() {
  return photometry_of_table(
      table_of(rotational(90.0, 5.0), [](double /*h*/, double v) { return 100.0 * lambert(v); }));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Emitters in a cube: two of a file, one of the same file at half the power, one of another file, and one without.
Room room_with_luminaires() {
  Room room = unit_cube(0.5, paper_emitter());
  const auto panel = std::make_shared<const Photometry>(lambert_photometry());
  Photometry other = photometry_of_table(table_of(rotational(180.0, 10.0), [](double, double) { return 1.0; }));
  other.source = "ball.ldt";
  other.manufacturer.clear();
  other.luminaire = "Ball, \"white\"";
  other.watts = 0.0;
  const auto ball = std::make_shared<const Photometry>(std::move(other));
  // Read a second time: equal content is one file.
  const auto again = std::make_shared<const Photometry>(lambert_photometry());
  const auto add = [&room](const char* name, double power, const std::shared_ptr<const Photometry>& photometry) {
    MeasuredEmitter shape;
    shape.photometry = photometry;
    shape.position = {0.5, 0.9, 0.5};
    room.emitters.push_back({name, power, shape});
  };
  room.quantity = Quantity::photometric;
  add("one", panel->flux(), panel);
  add("two", ball->flux(), ball);
  add("three", panel->flux(), again);
  add("four", 0.5 * panel->flux(), panel);
  return room;
}

}  // namespace

TEST_CASE("beam width: Lambert's law has its half at 60 degrees, on either side, in every plane") {
  // 60° and the angles where the cosine is 0.1 are between the angles of the table: the width is that of the table.
  const auto table = table_of(rotational(90.0, 5.0), [](double, double v) { return 7.0 * lambert(v); });
  for (const double plane : {0.0, 37.0, 90.0}) {
    const IntensityCut cut = intensity_cut(*table, plane);
    CHECK(cut.front().angle_deg == -180.0);
    CHECK(cut.back().angle_deg == 180.0);
    CHECK(highest_of(cut).angle_deg == 0.0);
    CHECK(highest_of(cut).candela == Approx(7.0).epsilon(1e-12));
    const BeamWidth beam = beam_width(cut, 0.5);
    CHECK(beam.from_deg == Approx(-60.0).epsilon(1e-10));
    CHECK(beam.to_deg == Approx(60.0).epsilon(1e-10));
    CHECK(beam.lobes == 1);
    const double low = lambert(80.0), next = lambert(85.0);
    CHECK(beam_width(cut, 0.1).width_deg() == Approx(2.0 * (80.0 + 5.0 * (low - 0.1) / (low - next))).epsilon(1e-10));
  }
}

TEST_CASE("beam width: the same intensity everywhere has no edge; a table that ends above it has one there") {
  const auto ball = table_of(rotational(180.0, 90.0), [](double, double) { return 1.0; });
  CHECK(beam_width(intensity_cut(*ball, 0.0), 0.5).width_deg() == 360.0);
  CHECK(beam_width(intensity_cut(*ball, 0.0), 1.0).lobes == 1);
  const auto half = table_of(rotational(90.0, 90.0), [](double, double) { return 1.0; });
  CHECK(beam_width(intensity_cut(*half, 0.0), 0.5).from_deg == -90.0);
  CHECK(beam_width(intensity_cut(*half, 0.0), 0.5).to_deg == 90.0);
  // Upwards: the beam goes through 180°.
  CandelaTable::Grid grid = rotational(90.0, 10.0);
  for (double& v : grid.vertical_deg) v += 90.0;
  const auto up = table_of(grid, [](double, double v) { return lambert(180.0 - v); });
  const BeamWidth beam = beam_width(intensity_cut(*up, 0.0), 0.5);
  CHECK(beam.width_deg() == Approx(120.0).epsilon(1e-10));
  CHECK(beam.from_deg == Approx(120.0).epsilon(1e-10));
  CHECK(beam.to_deg == Approx(240.0).epsilon(1e-10));
}

TEST_CASE("beam width: two peaks with a dip between are two beams; the width is that of one") {
  const auto wings =
      table_of(rotational(90.0, 5.0), [](double, double v) { return std::max(0.1, 1.0 - std::abs(v - 45.0) / 20.0); });
  const IntensityCut cut = intensity_cut(*wings, 0.0);
  CHECK(highest_of(cut).angle_deg == 45.0);
  const BeamWidth beam = beam_width(cut, 0.5);
  CHECK(beam.lobes == 2);
  CHECK(beam.from_deg == Approx(35.0).epsilon(1e-10));
  CHECK(beam.to_deg == Approx(55.0).epsilon(1e-10));
  // 10 % reaches from edge to edge: one beam.
  CHECK(beam_width(cut, 0.1).lobes == 1);
}

TEST_CASE("cuts of types B and A lie in their coordinate planes, mirrored angles and the other count of H included") {
  CandelaTable::Grid grid{
      PhotometricType::b, PhotometricSymmetry::none, angles(-90.0, 90.0, 10.0), angles(-90.0, 90.0, 15.0), {}, false};
  const auto ramp = [](double h, double v) { return (100.0 + h) * (200.0 + v); };
  for (const bool flip : {false, true}) {
    grid.flip_horizontal = flip;
    const auto b = table_of(grid, ramp);
    for (const IntensityPoint& point : intensity_cut(*b, 0.0)) {  // H = 0, V > 0 towards C0
      if (std::abs(point.angle_deg) < 90.0)
        CHECK(point.candela == Approx(100.0 * (200.0 + point.angle_deg)).epsilon(1e-12));
    }
    for (const IntensityPoint& point : intensity_cut(*b, 90.0)) {  // V = 0, H < 0 towards C90
      if (std::abs(point.angle_deg) < 90.0)
        CHECK(point.candela == Approx((100.0 + (flip ? 1.0 : -1.0) * point.angle_deg) * 200.0).epsilon(1e-12));
    }
    CandelaTable::Grid grid_a = grid;
    grid_a.type = PhotometricType::a;
    const auto a = table_of(grid_a, ramp);
    for (const IntensityPoint& point : intensity_cut(*a, 0.0)) {  // V = 0, H > 0 towards C0
      if (std::abs(point.angle_deg) < 90.0)
        CHECK(point.candela == Approx((100.0 + (flip ? -1.0 : 1.0) * point.angle_deg) * 200.0).epsilon(1e-12));
    }
  }
  // A narrow beam in H, wide in V, of a quarter of a table.
  CandelaTable::Grid quarter{
      PhotometricType::b, PhotometricSymmetry::both, angles(0.0, 10.0, 1.0), angles(0.0, 60.0, 5.0), {}, false};
  const Photometry flood =
      photometry_of_table(table_of(quarter, [](double h, double v) { return (1.0 - 0.1 * h) * (1.0 - v / 60.0); }));
  const LuminaireFigures figures = luminaire_figures(flood);
  REQUIRE(figures.planes.size() == 2);
  CHECK(figures.planes[0].name == "H = 0");
  CHECK(figures.planes[0].beam.width_deg() == Approx(60.0).epsilon(1e-10));
  CHECK(figures.planes[0].field.width_deg() == Approx(108.0).epsilon(1e-10));
  CHECK(figures.planes[1].name == "V = 0");
  CHECK(figures.planes[1].beam.width_deg() == Approx(10.0).epsilon(1e-10));
  CHECK(figures.zones.empty());
  CHECK(figures.share_towards_aim == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("zones: their fluxes are exact, also between the angles of a table, and add up to the flux") {
  // Constant 1 cd: 2π (cos γ1 − cos γ2).
  const auto ball = table_of(rotational(180.0, 90.0), [](double, double) { return 1.0; });
  for (const auto& [from, to] : {std::pair{0.0, 30.0}, {30.0, 60.0}, {17.0, 171.0}, {90.0, 180.0}}) {
    const double exact = 2.0 * pi * (std::cos(from * pi / 180.0) - std::cos(to * pi / 180.0));
    CHECK(flux_between(ball->grid(), from, to) == Approx(exact).epsilon(1e-12));
  }
  const Photometry panel = lambert_photometry();
  const LuminaireFigures figures = luminaire_figures(panel);
  REQUIRE(figures.zones.size() == 4);
  double sum = 0.0;
  for (const FluxZone& zone : figures.zones) sum += zone.flux;
  CHECK(sum == Approx(figures.flux).epsilon(1e-12));
  CHECK(figures.zones[3].flux == 0.0);
  // Lambert's law: sin² of the edge; the chords of 5° steps lie 0.1 % below it.
  CHECK(figures.zones[0].flux / figures.flux == Approx(0.25).epsilon(1e-3));
}

TEST_CASE("figures: stated fluxes, output ratio, units") {
  Photometry panel = lambert_photometry();
  const double flux = panel.flux();
  panel.absolute = false;
  panel.stated_lm = 0.8 * flux;
  panel.lamp_lm = 2.0 * flux;
  const LuminaireFigures figures = luminaire_figures(panel);
  CHECK(figures.flux_unit == "lm");
  CHECK(figures.over_stated.value() == Approx(0.25));
  CHECK(figures.output_ratio.value() == Approx(0.5));
  CHECK(figures.vertical.count == 19);
  CHECK(figures.vertical.is_even());
  panel.intensity_unit = "mW/sr";
  CHECK(luminaire_figures(panel).flux_unit == "mW");
}

TEST_CASE("luminaire_json: keys and values") {
  const Photometry panel = lambert_photometry();
  const Json json = Json::parse(luminaire_json(panel));
  CHECK(json["file"] == "folder/lamp.ies");
  CHECK(json["photometric_type"] == "C");
  CHECK(json["symmetry"] == "rotational");
  CHECK(json["flux"].get<double>() == panel.flux());
  CHECK(json["ballast_lamp_factor"].is_null());
  CHECK(json["conversion_factor"].is_null());
  CHECK(json["planes"][0]["beam_angle"]["width"].get<double>() == Approx(120.0));
  CHECK(json["zones"].size() == 4);
  CHECK(json["maximum"]["intensity"].get<double>() == 100.0);
  CHECK(json["warnings"].empty());
}

TEST_CASE("luminaire_svg: every number is finite and inside the picture; names are escaped") {
  std::vector<Photometry> lamps{lambert_photometry()};
  lamps.push_back(photometry_of_table(table_of(rotational(180.0, 10.0), [](double, double) { return 1.0; })));
  // A beam of 1° of type B, a street light, a luminaire that is dark in both planes.
  lamps.push_back(photometry_of_table(table_of(
      CandelaTable::Grid{
          PhotometricType::b, PhotometricSymmetry::none, angles(-2.0, 2.0, 0.25), angles(-2.0, 2.0, 0.25), {}, true},
      [](double h, double v) { return 1e6 * std::exp(-2.0 * (h * h + v * v)); })));
  lamps.push_back(photometry_of_table(table_of(CandelaTable::Grid{PhotometricType::c,
                                                                  PhotometricSymmetry::c0_c180,
                                                                  angles(0.0, 180.0, 30.0),
                                                                  angles(0.0, 90.0, 10.0),
                                                                  {},
                                                                  false},
                                               [](double h, double v) { return 10.0 + std::abs(h - 60.0) * v; })));
  lamps.push_back(
      photometry_of_table(table_of(CandelaTable::Grid{PhotometricType::c,
                                                      PhotometricSymmetry::quadrants,
                                                      angles(0.0, 90.0, 45.0),
                                                      angles(0.0, 180.0, 10.0),
                                                      {},
                                                      false},
                                   [](double h, double v) { return h == 45.0 && v > 0.0 && v < 180.0 ? 1.0 : 0.0; })));
  for (const Photometry& lamp : lamps) {
    const std::string svg = luminaire_svg(lamp);
    CHECK(svg.starts_with("<svg"));
    CHECK(svg.ends_with("</svg>\n"));
    for (const char* number : {"\"nan", "\"-nan", "\"inf", "\"-inf", ",nan", ",-nan", ",inf", ",-inf"})
      CHECK(svg.find(number) == std::string::npos);
    CHECK(svg.find("Maker &lt;&amp;&gt; Co") != std::string::npos);
    std::istringstream box(svg.substr(svg.find("viewBox=\"0 0 ") + 13));
    double width = 0.0;
    double height = 0.0;
    box >> width >> height;
    std::size_t points = 0;
    const std::string start = " points=\"";
    for (std::size_t at = svg.find(start); at != std::string::npos; at = svg.find(start, at + 1)) {
      const std::size_t first = at + start.size();
      std::istringstream list(svg.substr(first, svg.find('"', first) - first));
      for (std::string point; list >> point; ++points) {
        const double x = std::stod(point);
        const double y = std::stod(point.substr(point.find(',') + 1));
        CHECK((x >= 0.0 && x <= width && y >= 0.0 && y <= height));
      }
    }
    CHECK(points > 2);
    const bool rotational = lamp.candela->grid().symmetry == PhotometricSymmetry::rotational;
    CHECK((svg.find("<image") == std::string::npos) == rotational);
  }
}

TEST_CASE("luminaire schedule: a row for each file and power; equal files are one") {
  const Room room = room_with_luminaires();
  const std::vector<ScheduleRow> rows = luminaire_schedule(room);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].emitters == std::vector<std::size_t>{1, 3});
  CHECK(rows[1].emitters == std::vector<std::size_t>{4});
  CHECK(rows[1].file == rows[0].file);
  CHECK(rows[1].scale(room.quantity).value() == Approx(0.5));
  CHECK(rows[2].emitters == std::vector<std::size_t>{2});
  CHECK(luminaire_schedule(unit_cube(0.5, paper_emitter())).empty());
}

TEST_CASE("luminaire schedule: the scale is that of the new luminaire; other maintenance factors are other rows") {
  Room room = room_with_luminaires();
  room.emitters[3].own_maintenance = true;  // one of two equal ones
  set_maintenance_factor(room, 0.8);
  const std::vector<ScheduleRow> rows = luminaire_schedule(room);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].emitters == std::vector<std::size_t>{1});
  CHECK(rows[0].maintenance_factor == 0.8);
  CHECK(rows[0].scale(room.quantity).value() == Approx(1.0));
  CHECK(rows[0].initial_power() == Approx(rows[0].power / 0.8));
  CHECK(rows[1].emitters == std::vector<std::size_t>{3});
  CHECK(rows[1].maintenance_factor == 1.0);
}

TEST_CASE("emitters.csv: a row for each emitter") {
  std::istringstream table(emitters_csv(room_with_luminaires()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(table, line);) lines.push_back(line);
  REQUIRE(lines.size() == 6);
  CHECK(lines[0] ==
        "emitter,name,kind,file,power,unit,scale,watts,x,y,z,aim_x,aim_y,aim_z,c0_x,c0_y,c0_z,light_from,delay_ns,"
        "maintenance_factor,initial_power");
  CHECK(lines[2].starts_with("1,one,measured,folder/lamp.ies,"));
  CHECK(lines[2].ends_with(",lm,1,2,0.5,0.9,0.5,0,-1,0,1,0,0,point,0,1," +
                           to_text(room_with_luminaires().emitters[1].power)));
  CHECK(lines[5].find(",lm,0.5,2,") != std::string::npos);
  for (const std::string& line : lines) CHECK(count_of(line, ",") == 20);
}

TEST_CASE("report: each luminaire has its polar diagram once, with number and sums; results have emitters.csv") {
  const Room room = room_with_luminaires();
  Settings settings = settings_of(Estimator::collision, Engine::automatic, 5e3, 1, 0.5);
  const Result result = simulate(room, settings);
  const Folder folder;
  write_results(room, result, folder.path());
  CHECK(fs::exists(folder.path() / "emitters.csv"));
  const Json summary = Json::parse(text_of(folder.path() / "summary.json"));
  CHECK(summary["emitters"][1]["kind"] == "measured");
  CHECK(summary["emitters"][1]["file"] == "folder/lamp.ies");
  CHECK(summary["emitters"][0]["file"].is_null());
  REQUIRE(summary["luminaires"].size() == 3);
  CHECK(summary["luminaires"][0]["count"] == 2);
  CHECK(summary["luminaires"][0]["total_watts"] == 4.0);
  CHECK(summary["luminaires"][2]["watts"].is_null());
  write_report(room, result, folder.path());
  const std::string page = text_of(folder.path() / "report.html");
  CHECK(count_of(page, "class=\"diagram\"") == 2);
  CHECK(count_of(page, "rowspan=\"2\"") == 1);
  const std::string diagram = polar_svg(*luminaire_schedule(room)[0].photometry);
  CHECK(count_of(page, diagram) == 1);
  CHECK(page.find("Maker &lt;&amp;&gt; Co, Panel") != std::string::npos);
  CHECK(page.find("Emitters without a photometric file") != std::string::npos);
  CHECK(fs::exists(folder.path() / "pictures" / "luminaire_1.svg"));
  CHECK(fs::exists(folder.path() / "pictures" / "luminaire_2.svg"));
  CHECK_FALSE(fs::exists(folder.path() / "pictures" / "luminaire_3.svg"));
}
