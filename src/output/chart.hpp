// Charts as SVG: lines over logarithmic or linear axes, and bars.
#pragma once

#include <string>
#include <vector>

namespace lichtmc {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;  // in ascending order of x; points that are not finite, or not > 0 on a logarithmic
                                   // axis, are left out
};

enum class Scale { linear, logarithmic };

struct LineChart {
  std::string title;
  std::string x_label;  // with its unit
  std::string y_label;
  Scale x_scale = Scale::logarithmic;
  Scale y_scale = Scale::logarithmic;
  std::vector<ChartSeries> series;
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
