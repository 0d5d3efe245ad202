// Writes a study to files: a table, three charts, and advice as text.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/message.hpp"
#include "lichtmc/output.hpp"
#include "output/chart.hpp"
#include "output/json.hpp"

namespace lichtmc {

namespace {

std::string csv_of(const Study& study) {
  std::string text =
      "direction,estimator,engine,histories,max_bounces,tile,direct,seconds,rms_error,bias,standard_error,"
      "figure_of_merit\n";
  for (const StudyRow& row : study.rows) {
    text += std::string(to_string(row.direction)) + ',' + std::string(to_string(row.estimator)) + ',' +
            std::string(to_string(row.engine)) + ',' + std::to_string(row.histories) + ',' +
            (row.max_bounces ? std::to_string(*row.max_bounces) : "") + ',' + to_text(row.tile_edge_m) + ',' +
            std::string(to_string(row.direct)) + ',' + to_text(row.seconds) + ',' + to_text(row.rms_error) + ',' +
            to_text(row.bias) + ',' + to_text(row.standard_error) + ',' + to_text(row.figure_of_merit) + '\n';
  }
  return text;
}

std::string name_of(const StudyRow& row) {
  std::string name = std::string(to_string(row.direction)) + ", " + std::string(to_string(row.estimator));
  if (row.direction == WalkDirection::forward && row.direct == Direct::analytic) name += ", direct integrated";
  return name + ", " + std::string(to_string(row.engine));
}

double main_edge(const Study& study) {
  return study.references.front().tile_edge_m;
}

// Rows of the main tile size without a limit of flights, by setting.
std::map<std::string, std::vector<StudyRow>> ladders_of(const Study& study) {
  std::map<std::string, std::vector<StudyRow>> ladders;
  for (const StudyRow& row : study.rows) {
    if (row.tile_edge_m == main_edge(study) && !row.max_bounces) ladders[name_of(row)].push_back(row);
  }
  return ladders;
}

std::string error_over_time(const Study& study) {
  LineChart chart;
  chart.title = "Error over time, tile edge " + short_number(main_edge(study)) + " m";
  chart.x_label = "time, s (" + to_text(study.threads, "thread") + ")";
  chart.y_label = "rms relative error of the tiles, %";
  for (const auto& [name, rows] : ladders_of(study)) {
    ChartSeries series{name, {}};
    for (const StudyRow& row : rows) series.points.push_back({row.seconds, 100.0 * row.rms_error});
    chart.series.push_back(series);
  }
  return to_svg(chart);
}

std::string bias_over_bounces(const Study& study) {
  LineChart chart;
  chart.title = "Bias of walks with a limited number of flights";
  chart.x_label = "number of flights (--max-bounces), weight estimator";
  chart.y_label = "relative error, %";
  chart.x_scale = Scale::linear;
  ChartSeries bias{"bias of the sum over all tiles", {}};
  ChartSeries error{"rms relative error of the tiles", {}};
  ChartSeries stated{"reported standard error, rms", {}};
  for (const StudyRow& row : study.rows) {
    if (!row.max_bounces) continue;
    const double flights = *row.max_bounces;
    bias.points.push_back({flights, 100.0 * std::abs(row.bias)});
    error.points.push_back({flights, 100.0 * row.rms_error});
    stated.points.push_back({flights, 100.0 * row.standard_error});
  }
  chart.series = {bias, error, stated};
  return to_svg(chart);
}

std::string figures_of_merit(const Study& study) {
  std::vector<Bar> bars;
  for (const auto& [name, rows] : ladders_of(study)) bars.push_back({name, rows.back().figure_of_merit});
  return bars_to_svg("Figure of merit, tile edge " + short_number(main_edge(study)) + " m",
                     "1 / (rms relative error² · time), 1/s: twice the value means the same error in half the time",
                     bars);
}

}  // namespace

std::string advice_text(const Study& study) {
  std::string text = "Room " + study.room + ", " + to_text(study.threads, "thread") + ".\n";
  for (const StudyReference& reference : study.references) {
    text += "Reference for a tile edge of " + short_number(reference.tile_edge_m) +
            " m: " + to_text(reference.tiles, "tile") + ", " + short_number(static_cast<double>(reference.histories)) +
            " photons, standard error " + short_number(100.0 * reference.standard_error) +
            " % (rms). Tiles with a standard error of 10 % or less have " + short_number(100.0 * reference.area_share) +
            " % of the lit area; the errors below are those of these tiles.\n";
  }
  text += "\nThe fastest settings for the tiles (area-weighted rms relative error):\n";
  for (const Advice& advice : study.advice) text += advice.sentence + "\n";
  if (study.advice.empty()) text += "None: no run has a known error. Increase --max-time.\n";
  if (!study.left_out.empty()) text += "\nLeft out:\n";
  for (const std::string& sentence : study.left_out) text += sentence + "\n";
  return text;
}

void write_study(const Study& study, const std::filesystem::path& folder) {
  write_file_atomically(folder / "error_over_time.svg", error_over_time(study));
  write_file_atomically(folder / "bias_over_bounces.svg", bias_over_bounces(study));
  write_file_atomically(folder / "figures_of_merit.svg", figures_of_merit(study));
  write_file_atomically(folder / "advice.txt", advice_text(study));
  write_file_atomically(folder / "study.csv", csv_of(study));
}

}  // namespace lichtmc
