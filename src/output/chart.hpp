// Charts as SVG: lines and filled ranges over logarithmic or linear axes, and bars.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lichtmc {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
};

// A range of y at x.
struct ChartRange {
  double x = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;  // in ascending order of x; points that are not finite, or not > 0 on a logarithmic
                                   // axis, are left out
  bool dots = true;                // a dot at each point
  bool gaps = false;               // points that are left out interrupt the line
  std::vector<ChartRange> band = {};    // filled behind the line
};

// The lowest and the highest value of an axis; what lies outside is cut off.
struct ChartLimits {
  double low = 0.0;
  double high = 0.0;
};

// A filled range with a name.
struct ChartArea {
  std::string name;
  std::vector<ChartRange> range;
};

// A line across the chart at a value of one axis, with a text beside it.
struct ChartMark {
  double at = 0.0;
  std::string label;
};

enum class Scale { linear, logarithmic };

struct LineChart {
  std::string title;
  std::string x_label;  // with its unit
  std::string y_label;
  Scale x_scale = Scale::logarithmic;
  Scale y_scale = Scale::logarithmic;
  std::vector<ChartSeries> series;
  std::vector<ChartArea> areas;         // behind the series
  std::vector<ChartMark> x_marks;       // vertical lines
  std::vector<ChartMark> y_marks;       // horizontal lines
  std::vector<std::string> notes;       // sentences below the legend
  std::optional<ChartLimits> y_limits;  // none: those of the points
};

// A complete SVG, 980 × 560; text is escaped.
std::string to_svg(const LineChart& chart);

struct Bar {
  std::string name;
  double value = 0.0;  // > 0
};

// Horizontal bars over a logarithmic axis, longest first.
std::string bars_to_svg(const std::string& title, const std::string& label, std::vector<Bar> bars);

}  // namespace lichtmc
