// Pictures of impulse responses, and their section of the report.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "lichtmc/lichtmc.hpp"
#include "output/channel_pictures.hpp"
#include "output/chart.hpp"
#include "output/readable.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/small_channels.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// Whether all points of lines and areas are numbers inside the axes of a chart (80 … 600, 50 … 500).
bool is_inside_axes(const std::string& svg) {
  std::size_t count = 0;
  const std::string start = " points=\"";
  for (std::size_t at = svg.find(start); at != std::string::npos; at = svg.find(start, at + 1)) {
    const std::size_t first = at + start.size();
    std::istringstream points(svg.substr(first, svg.find('"', first) - first));
    for (std::string point; points >> point; ++count) {
      const double x = std::stod(point);
      const double y = std::stod(point.substr(point.find(',') + 1));
      if (!(x >= 80.0 && x <= 600.0 && y >= 50.0 && y <= 500.0)) return false;
    }
  }
  return count > 0;
}

Room room_with_receivers() {
  Room room = unit_cube(0.5, paper_emitter());
  room.surfaces[1].name = "impulse_response";
  for (const char* name : {"first", "second, half", "dark"}) room.receivers.push_back({name, {0.5, 0.2, 0.5}});
  return room;
}

Result simulate_it(const Room& room) {
  Settings settings = settings_of(Estimator::collision, Engine::automatic, 5e4, 1, 0.25);
  settings.measured = Measured::all;
  Result result = simulate(room, settings);
  result.settings.channel.bin_width_s = 1e-9;
  result.channels = make_small_responses();
  return result;
}

}  // namespace

TEST_CASE("a figure is written with its error to two digits") {
  CHECK(with_error(23.2018, 0.0412) == "23.202 ± 0.041");
  CHECK(with_error(-55.28, 0.1) == "-55.28 ± 0.10");
  CHECK(with_error(12345.6, 321.0) == "12346 ± 321");
  CHECK(with_error(1.23e15, 4.56e14) == "1.23·10¹⁵ ± 4.6·10¹⁴");
  CHECK(with_error(0.5, 3.0) == "0.5 ± 3.0");
  CHECK(with_error(13.0260943, 0.0) == "13.0261");
  CHECK(with_error(13.0260943, unknown) == "13");
  CHECK(with_error(unknown, 0.1) == "–");
  CHECK(with_error(2.0, 1e-300) == "2");
}

TEST_CASE("pictures of channels show the strongest and the weakest channel with light") {
  const ImpulseResponses responses = make_small_responses();
  CHECK(shown_channels(responses) == std::vector<std::size_t>{5, 0});
  CHECK(channel_name(responses, 5) == "from 'Leuchte Ø 𝄞' to 'dark'");
  ImpulseResponses one = responses;
  one.channels.resize(1);
  one.emitters = {"all"};
  one.receivers = {"first"};
  CHECK(shown_channels(one) == std::vector<std::size_t>{0});
  CHECK(channel_name(one, 0) == "to 'first'");
  one.channels[0].gain = {0.0, 0.0};
  CHECK(shown_channels(one).empty());
}

TEST_CASE("pictures of channels have marks, names and notes, and nothing outside of the axes") {
  const Result result = make_channel_result();
  const ChannelPictures pictures = channel_pictures(result, 0);
  for (const std::string& svg : {pictures.response, pictures.by_order, pictures.frequency}) {
    CHECK(svg.starts_with("<svg xmlns"));
    CHECK(svg.ends_with("</svg>\n"));
    CHECK_THAT(svg, ContainsSubstring("from 'a &quot;b&quot;, c' to 'first'"));
    CHECK(is_inside_axes(svg));
  }
  CHECK_THAT(pictures.response, ContainsSubstring(">line of sight</text>"));
  CHECK_THAT(pictures.response, ContainsSubstring("rms delay"));
  CHECK_THAT(pictures.response, ContainsSubstring("fill-opacity=\"0.3\""));
  CHECK_THAT(pictures.by_order, ContainsSubstring(">2 reflections</text>"));
  CHECK_THAT(pictures.by_order, ContainsSubstring(">3 reflections and more</text>"));
  CHECK_THAT(pictures.frequency, ContainsSubstring("−3 dB electrical"));
  CHECK_THAT(pictures.frequency, ContainsSubstring("−3 dB optical"));
  CHECK_THAT(pictures.frequency, ContainsSubstring("8.300 ± 0.020 MHz"));
  CHECK_THAT(pictures.frequency, ContainsSubstring("none up"));
}

TEST_CASE("many orders and bins share areas and columns, errors may be unknown") {
  Result result = make_channel_result();
  ImpulseResponses& r = *result.channels;
  r.orders = 20;
  r.bins = 5000;
  r.h.assign(6 * 22 * r.bins, 2.0);
  r.standard_error.assign(r.h.size(), unknown);
  r.h_all.assign(6 * r.bins, 44.0);
  r.standard_error_all.assign(r.h_all.size(), unknown);
  r.magnitude_error.clear();
  for (Channel& channel : r.channels) channel.mean_excess_delay_s.standard_error = unknown;
  const ChannelPictures pictures = channel_pictures(result, 5);
  CHECK(count_of(pictures.by_order, "<polygon") == 7);
  CHECK_THAT(pictures.by_order, ContainsSubstring(">6 reflections and more</text>"));
  CHECK_THAT(pictures.by_order, ContainsSubstring("means of 5"));
  CHECK(is_inside_axes(pictures.by_order));
  CHECK(is_inside_axes(pictures.response));
  CHECK(pictures.by_order.size() < 500'000);
  // All light beyond the time span: empty charts.
  r.h.assign(r.h.size(), 0.0);
  r.h_all.assign(r.h_all.size(), 0.0);
  const ChannelPictures empty = channel_pictures(result, 5);
  CHECK_THAT(empty.response, !ContainsSubstring("nan") && !ContainsSubstring("inf"));
  CHECK_THAT(empty.by_order, !ContainsSubstring("nan") && !ContainsSubstring("inf"));
  r.frequencies_hz.clear();
  r.response.clear();
  CHECK(channel_pictures(result, 5).frequency.empty());
}

TEST_CASE("the report has the channels with their pictures; surfaces do not take the names of these") {
  const Room room = room_with_receivers();
  Result result = simulate_it(room);
  const Folder folder;
  write_report(room, result, folder.path());
  const std::string html = text_of(folder.path() / "report.html");
  CHECK_THAT(html, ContainsSubstring("<h2>Channels</h2>"));
  CHECK_THAT(html, ContainsSubstring("Highest gain: from 'Leuchte Ø 𝄞' to 'dark'"));
  CHECK_THAT(html, ContainsSubstring("Lowest gain: from 'a &quot;b&quot;, c' to 'first'"));
  CHECK_THAT(html, ContainsSubstring("t = 0 is the emission; the delays of the emitters are included."));
  CHECK_THAT(html, ContainsSubstring("≤ 7.25</td>"));
  CHECK(count_of(html, "|H(f)| / H(0), dB") == 2);
  const fs::path pictures = folder.path() / "pictures";
  for (const char* stem : {"impulse_response", "impulse_response_orders", "frequency_response"}) {
    CHECK(text_of(pictures / (std::string(stem) + ".svg")).find("from 'Leuchte") != std::string::npos);
    CHECK(fs::exists(pictures / (std::string(stem) + "_lowest_gain.svg")));
    CHECK_FALSE(fs::exists(pictures / (std::string(stem) + ".png")));  // of the surface
  }
  result.channels.reset();
  write_report(room, result, folder.path());
  CHECK_THAT(text_of(folder.path() / "report.html"), !ContainsSubstring("<h2>Channels</h2>"));
  CHECK_FALSE(fs::exists(pictures / "frequency_response.svg"));
}

TEST_CASE("a chart cuts off what lies outside its limits, and interrupts lines where nothing can be shown") {
  LineChart chart;
  chart.x_scale = Scale::linear;
  chart.series = {{"line", {{0, 1}, {1, 1e-9}, {2, 10}, {3, 0}, {4, 1}}, false, true, {{0, 1e-9, 1e9}, {4, 1, 2}}}};
  chart.areas = {{"area", {{0, 0, 5}, {4, 0, 1e12}}}};
  chart.y_limits = ChartLimits{1.0, 100.0};
  chart.x_marks = {{2.0, "shown"}, {9.0, "not shown"}};
  const std::string svg = to_svg(chart);
  CHECK(count_of(svg, "<polyline") == 3);
  CHECK(count_of(svg, "<polygon") == 2);
  CHECK(is_inside_axes(svg));
  CHECK_THAT(svg, ContainsSubstring(">shown<") && !ContainsSubstring(">not shown<"));
}
