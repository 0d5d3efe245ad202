// Advice from a study's rows, and its charts.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "lichtmc/output.hpp"
#include "output/chart.hpp"
#include "run/advice.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

StudyRow row(Estimator estimator, std::uint64_t histories, double seconds, double error) {
  StudyRow one;
  one.estimator = estimator;
  one.engine = Engine::cuboid;
  one.histories = histories;
  one.tile_edge_m = 0.1;
  one.seconds = seconds;
  one.rms_error = error;
  one.standard_error = error;
  one.figure_of_merit = 1.0 / (error * error * seconds);
  return one;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("advice is the cheapest setting for each accuracy") {
  const std::vector<StudyRow> rows{row(Estimator::collision, 1000, 0.1, 0.2),
                                   row(Estimator::collision, 100'000, 10.0, 0.02),
                                   row(Estimator::weight, 1000, 0.2, 0.1), row(Estimator::weight, 100'000, 20.0, 0.01)};
  const std::vector<Advice> advice = advice_from(rows, 0.1, "room.glb");
  REQUIRE(advice.size() == 3);
  for (const Advice& one : advice) CHECK(one.setting.estimator == Estimator::weight);
  CHECK(advice[0].error == 0.1);
  CHECK(advice[0].histories == Approx(1000.0));
  CHECK(advice[0].seconds == Approx(0.2));
  CHECK(advice[1].seconds == Approx(20.0));
  CHECK(advice[2].histories == Approx(1e7));
  CHECK(advice[2].sentence.find("lichtmc run room.glb --tile 0.1 --estimator weight --target-error 0.1%") !=
        std::string::npos);
  CHECK(advice[2].sentence.find("33.3 min") != std::string::npos);
  CHECK(advice_from(rows, 0.2, "room.glb").empty());
}

TEST_CASE("advice includes the time of steps that are done once, and leaves out walks whose bias is too large") {
  // Integration takes 5 s, then half of the time of the other method.
  std::vector<StudyRow> rows{row(Estimator::collision, 1000, 0.1, 0.2), row(Estimator::collision, 100'000, 10.0, 0.02)};
  StudyRow integrated = row(Estimator::collision, 100'000, 10.0, 0.02);
  integrated.direct = Direct::analytic;
  integrated.direct_seconds = 5.0;
  rows.push_back(integrated);
  std::vector<Advice> advice = advice_from(rows, 0.1, "room.glb");
  REQUIRE(advice.size() == 3);
  CHECK(advice[0].setting.direct == Direct::sampled);
  CHECK(advice[2].setting.direct == Direct::analytic);
  CHECK(advice[2].sentence.find("--direct analytic") != std::string::npos);

  // Ten times as fast, with a bias of 4 %: √(4.5² − 2²).
  StudyRow cut = row(Estimator::weight, 100'000, 1.0, 0.02);
  cut.max_bounces = 3;
  cut.rms_error = 0.045;
  rows.push_back(cut);
  advice = advice_from(rows, 0.1, "room.glb");
  CHECK(advice[0].setting.max_bounces == 3U);
  CHECK(advice[0].sentence.find("--max-bounces 3") != std::string::npos);
  CHECK_FALSE(advice[1].setting.max_bounces.has_value());
  CHECK_FALSE(advice[2].setting.max_bounces.has_value());

  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(advice_from({row(Estimator::weight, 1024, 1.0, nan)}, 0.1, "room.glb").empty());
}

TEST_CASE("line charts leave out values that cannot be drawn") {
  LineChart chart;
  chart.title = "a < b & c";
  chart.x_label = "time, s";
  chart.y_label = "error, %";
  chart.series = {{"one", {{1.0, 10.0}, {10.0, 1.0}, {100.0, 0.1}}},
                  {"two", {{1.0, 0.0}, {2.0, std::numeric_limits<double>::quiet_NaN()}, {3.0, 1.0}, {30.0, 0.5}}}};
  const std::string svg = to_svg(chart);
  CHECK(svg.starts_with("<svg"));
  CHECK(svg.find("</svg>") != std::string::npos);
  CHECK(svg.find("a &lt; b &amp; c") != std::string::npos);
  CHECK(count(svg, "<polyline") == 2);
  CHECK(count(svg, "<circle") == 5);
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf") == std::string::npos);
  chart.series.clear();
  CHECK(to_svg(chart).find("nan") == std::string::npos);
}

TEST_CASE("bars are sorted, the longest first") {
  const std::string svg = bars_to_svg("merit", "1/s", {{"short", 1.0}, {"long", 1000.0}, {"middle", 30.0}});
  CHECK(svg.find(">long") < svg.find(">middle"));
  CHECK(svg.find(">middle") < svg.find(">short"));
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("a study compares every method with one reference") {
  StudyOptions options;
  options.seconds = 5.0;
  options.tile_edge_m = 0.25;
  std::size_t told = 0;
  std::size_t last = 0;
  options.progress = [&](const StudyProgress& progress) {
    ++told;
    CHECK(progress.done >= last);
    last = progress.done;
    if (progress.of > 0) CHECK(progress.done < progress.of);
    CHECK_FALSE(progress.what.empty());
  };
  const Study found = study(unit_cube(0.6, paper_emitter()), options);
  // On a slow machine there is no time for all runs: those left out are reported.
  for (const std::string& sentence : found.left_out) CHECK(sentence.find("Give --max-time more.") != std::string::npos);
  REQUIRE_FALSE(found.references.empty());
  CHECK(found.references.size() <= 3);
  CHECK(found.references[0].tiles == 96);
  CHECK(told >= 25);
  std::size_t backward = 0;
  std::size_t cut = 0;
  std::size_t integrated = 0;
  std::size_t by_embree = 0;
  for (const StudyRow& one : found.rows) {
    CHECK(one.rms_error > 0.0);
    CHECK(one.seconds > 0.0);
    if (one.direction == WalkDirection::forward) CHECK(one.histories * 30 <= found.references[0].histories);
    if (one.direction == WalkDirection::backward) ++backward;
    if (one.max_bounces) ++cut;
    if (one.direction == WalkDirection::forward && one.direct == Direct::analytic) ++integrated;
    if (one.engine != Engine::cuboid) ++by_embree;
    // Truncation after two flights loses most of ρ² = 0.36 … of the power; complete walks lose nothing.
    if (one.max_bounces == 2U) CHECK(one.bias < -0.2);
    if (one.max_bounces == 50U) CHECK(std::abs(one.bias) < 0.01);
  }
  // A plan that is not left out has at least one row.
  const auto left_out = [&](const std::string& part) {
    return static_cast<std::size_t>(
        std::count_if(found.left_out.begin(), found.left_out.end(),
                      [&](const std::string& sentence) { return sentence.find(part) != std::string::npos; }));
  };
  CHECK(backward + left_out("backward, ") >= 3);
  CHECK(cut + left_out("cut off after") == 9);
  CHECK(integrated + left_out("direct light integrated") >= 3);
  CHECK(by_embree + left_out("embree") >= 2);
  CHECK(found.advice.size() == 3);
  CHECK(advice_text(found).find("For 1 %: lichtmc run") != std::string::npos);
}
