#include <cmath>
#include <cstddef>
#include <regex>
#include <string>
#include <vector>

#include "lichtmc/lichtmc.hpp"
#include "output/picture_svg.hpp"
#include "output/svg.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

struct Box {
  std::string text;
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

// The boxes of the texts and lines of an SVG picture of this program. Lines count without those of classes other than
// "frame": marks and isolines may lie under labels.
std::vector<Box> boxes_of(const std::string& svg) {
  std::vector<Box> boxes;
  const std::regex text(R"re(<text x="([-\d.]+)" y="([-\d.]+)"([^>]*)>([^<]*)</text>)re");
  for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end; ++at) {
    const std::string attributes = (*at)[3];
    std::smatch found;
    const double size =
        std::regex_search(attributes, found, std::regex(R"re(font-size="([\d.]+)")re")) ? std::stod(found[1]) : 13.0;
    CHECK(attributes.find("text-anchor") == std::string::npos);
    const double x = std::stod((*at)[1]);
    const double y = std::stod((*at)[2]);
    boxes.push_back({(*at)[4], x, y - 0.75 * size, x + text_width((*at)[4].str(), size), y + 0.22 * size});
  }
  const std::regex line(R"re(<line x1="([-\d.]+)" y1="([-\d.]+)" x2="([-\d.]+)" y2="([-\d.]+)" class="frame")re");
  for (std::sregex_iterator at(svg.begin(), svg.end(), line), end; at != end; ++at)
    boxes.push_back({"line", std::stod((*at)[1]), std::stod((*at)[2]), std::stod((*at)[3]), std::stod((*at)[4])});
  return boxes;
}

// All texts are on the canvas, and no text lies on another or on a line of the legend or the scale bar.
void check_texts(const std::string& svg) {
  std::smatch size;
  REQUIRE(std::regex_search(svg, size, std::regex(R"re(viewBox="0 0 ([\d.]+) ([\d.]+)")re")));
  const std::vector<Box> boxes = boxes_of(svg);
  REQUIRE(boxes.size() > 4);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const Box& a = boxes[k];
    INFO(a.text);
    CHECK(a.left >= 0.0);
    CHECK(a.top >= 0.0);
    CHECK(a.right <= std::stod(size[1]));
    CHECK(a.bottom <= std::stod(size[2]));
    for (std::size_t other = k + 1; other < boxes.size(); ++other) {
      const Box& b = boxes[other];
      if (a.text == "line" && b.text == "line") continue;
      INFO(b.text);
      const bool overlap = a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
      CHECK_FALSE(overlap);
    }
  }
}

const std::string long_name =
    "Building of the faculty/Storey 2/Room 2.14, west/Furniture/Shelf with a name that is longer than its picture";

}  // namespace

TEST_CASE("pictures: no text leaves the canvas or lies on another, on any scale and for any shape of plan") {
  // 0.2 m wide and 6 m high, with lamps at one place and at a wall.
  Room room = make_cuboid({0.2, 6.0, 3.0}, uniform_reflectance(0.5));
  for (Surface& surface : room.surfaces) surface.name = long_name + surface.name;
  for (const double x : {0.1, 0.1, 0.1, 0.199}) room.emitters.push_back(isotropic({x, 5.0, 1.5}, 1234.5));
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::automatic, 2e4, 3, 0.1));
  const RoomPainter painter(room, result, 1);
  for (const ColourScale& scale : {choose_scale(result), ColourScale{ColourMap::viridis, true, 1.5e-7, 1.5e-4},
                                   ColourScale{ColourMap::inferno, false, 0.0, 123456.0}}) {
    for (const View view : {View::corner, View::above}) {
      Picture picture = painter.draw(view, scale, 300, 205);
      check_texts(room_svg(room, result, picture, png_of(picture), scale, view));
      picture.cut_y_m = -1234.56;
      check_texts(room_svg(room, result, picture, png_of(picture), scale, view));
    }
    const std::vector<SurfacePlan> plans = draw_plans(room, result, painter.lit_sides(), scale, 6, 200).plans;
    for (const SurfacePlan& plan : plans)
      check_texts(plan_svg(result, plan, png_of(plan.picture), scale, result.tiling.maps[plan.map].name));
  }
}

TEST_CASE("pictures: texts that are too long are shortened in their middle or broken at blanks") {
  CHECK(shortened("floor", 13.0, 60.0) == "floor");
  const std::string name = shortened(long_name, 13.0, 200.0);
  CHECK(text_width(name, 13.0) <= 200.0);
  CHECK(name.starts_with("Building"));
  CHECK(name.ends_with("picture"));
  const std::string accents = shortened("äöüäöüäöüäöüäöüäöü", 10.0, 60.0);
  CHECK(accents == "äöü…öü");
  const std::vector<std::string> lines = text_lines("one two three four five six", 10.0, 70.0);
  CHECK(lines.size() > 1);
  std::string all;
  for (const std::string& line : lines) {
    CHECK(text_width(line, 10.0) <= 70.0);
    all += (all.empty() ? "" : " ") + line;
  }
  CHECK(all == "one two three four five six");
  CHECK(text_lines("", 10.0, 70.0) == std::vector<std::string>{""});
}
