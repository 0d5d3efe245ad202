#include "output/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/message.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

constexpr double width = 980.0;
constexpr double height = 560.0;
constexpr double left = 80.0;
constexpr double right = 600.0;  // the legend is to the right of it
constexpr double top = 50.0;
constexpr double bottom = 500.0;

// Colours that can be distinguished with any colour vision (M. Okabe, K. Ito, Color Universal Design, 2008). Further
// series repeat them with dashed lines.
constexpr std::array<const char*, 7> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                             "#E69F00", "#56B4E9", "#999999"};
constexpr std::array<const char*, 3> dashes{"", "6 4", "2 3"};

// Maps values to coordinates along an axis.
class Axis {
 public:
  Axis(Scale scale, double low, double high, double from, double to) : scale_(scale), from_(from), to_(to) {
    if (!(low <= high)) low = high = 1.0;
    if (scale == Scale::logarithmic) {
      low_ = std::floor(std::log10(low) + 1e-9);
      high_ = std::max(std::ceil(std::log10(high) - 1e-9), low_ + 1.0);
    } else {
      low_ = std::min(low, 0.0);
      high_ = std::max(high, low_ + 1e-12);
    }
  }
  bool contains(double value) const { return std::isfinite(value) && (scale_ == Scale::linear || value > 0.0); }
  double at(double value) const {
    const double v = scale_ == Scale::logarithmic ? std::log10(value) : value;
    return from_ + (to_ - from_) * (v - low_) / (high_ - low_);
  }
  std::vector<double> ticks() const {
    std::vector<double> ticks;
    if (scale_ == Scale::logarithmic) {
      const double step = std::ceil((high_ - low_) / 10.0);
      for (int k = 0; low_ + k * step <= high_; ++k) ticks.push_back(std::pow(10.0, low_ + k * step));
      return ticks;
    }
    const double rough = (high_ - low_) / 6.0;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = decade * (rough > 5.0 * decade   ? 10.0
                                  : rough > 2.0 * decade ? 5.0
                                  : rough > decade       ? 2.0
                                                         : 1.0);
    for (double k = std::ceil(low_ / step); k * step <= high_; k += 1.0) ticks.push_back(k * step);
    return ticks;
  }

 private:
  Scale scale_;
  double low_ = 0.0;
  double high_ = 1.0;
  double from_;
  double to_;
};

constexpr const char* grid_style = "class=\"rule\"";

std::string style_of(std::size_t series) {
  const std::string dash = dashes.at(series / colours.size() % dashes.size());
  return "stroke=\"" + std::string(colours.at(series % colours.size())) + "\" stroke-width=\"2\" fill=\"none\"" +
         (dash.empty() ? "" : " stroke-dasharray=\"" + dash + "\"");
}

// Extends a range by a value, unless the axis cannot show it.
void extend(double value, Scale scale, double& low, double& high) {
  if (!std::isfinite(value) || (scale == Scale::logarithmic && !(value > 0.0))) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

std::string grid(const Axis& x, const Axis& y, const LineChart& chart) {
  std::string svg;
  for (const double tick : x.ticks()) {
    svg += svg_line(x.at(tick), top, x.at(tick), bottom, grid_style);
    svg += svg_text(x.at(tick), bottom + 18.0, short_number(tick), " text-anchor=\"middle\"");
  }
  for (const double tick : y.ticks()) {
    svg += svg_line(left, y.at(tick), right, y.at(tick), grid_style);
    svg += svg_text(left - 6.0, y.at(tick) + 4.0, short_number(tick), " text-anchor=\"end\"");
  }
  svg += svg_text(0.5 * (left + right), height - 16.0, chart.x_label, " text-anchor=\"middle\"");
  const double middle = 0.5 * (top + bottom);
  svg += svg_text(18.0, middle, chart.y_label,
                  " text-anchor=\"middle\" transform=\"rotate(-90 18 " + fixed(middle) + ")\"");
  return svg;
}

}  // namespace

std::string to_svg(const LineChart& chart) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double x_low = infinity, x_high = -infinity, y_low = infinity, y_high = -infinity;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      extend(point.x, chart.x_scale, x_low, x_high);
      extend(point.y, chart.y_scale, y_low, y_high);
    }
  }
  const Axis x(chart.x_scale, x_low, x_high, left, right);
  const Axis y(chart.y_scale, y_low, y_high, bottom, top);
  std::string svg = svg_head(width, height, chart.title, left) + grid(x, y, chart);
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    std::string points;
    std::string dots;
    for (const ChartPoint& point : chart.series[k].points) {
      if (!x.contains(point.x) || !y.contains(point.y)) continue;
      points += fixed(x.at(point.x)) + "," + fixed(y.at(point.y)) + " ";
      dots += "<circle cx=\"" + fixed(x.at(point.x)) + "\" cy=\"" + fixed(y.at(point.y)) + "\" r=\"3\" fill=\"" +
              colours.at(k % colours.size()) + "\"/>\n";
    }
    svg += "<polyline points=\"" + points + "\" " + style_of(k) + "/>\n" + dots;
    const double row = top + 12.0 + 20.0 * static_cast<double>(k);
    svg += svg_line(right + 14.0, row - 4.0, right + 44.0, row - 4.0, style_of(k));
    svg += svg_text(right + 50.0, row, chart.series[k].name, " font-size=\"12\"");
  }
  return svg + "</svg>\n";
}

std::string bars_to_svg(const std::string& title, const std::string& label, std::vector<Bar> bars) {
  constexpr double row_height = 26.0;
  constexpr double names_end = 330.0;
  constexpr double bars_end = 820.0;
  std::stable_sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.value > b.value; });
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Bar& bar : bars) extend(bar.value, Scale::logarithmic, low, high);
  // The axis starts at half of the lowest value, so that the shortest bar is visible.
  const Axis axis(Scale::logarithmic, 0.5 * low, high, names_end, bars_end);
  const double end = top + row_height * static_cast<double>(bars.size());
  std::string svg = svg_head(width, end + 60.0, title, left);
  for (const double tick : axis.ticks()) {
    svg += svg_line(axis.at(tick), top - 4.0, axis.at(tick), end, grid_style);
    svg += svg_text(axis.at(tick), end + 18.0, short_number(tick), " text-anchor=\"middle\"");
  }
  for (std::size_t k = 0; k < bars.size(); ++k) {
    if (!axis.contains(bars[k].value)) continue;
    const double y = top + row_height * static_cast<double>(k);
    const double x = axis.at(bars[k].value);
    svg += svg_text(names_end - 8.0, y + 16.0, bars[k].name, " text-anchor=\"end\" font-size=\"12\"");
    svg += "<rect x=\"" + fixed(names_end) + "\" y=\"" + fixed(y + 3.0) + "\" width=\"" + fixed(x - names_end) +
           "\" height=\"18\" fill=\"" + colours.front() + "\"/>\n";
    svg += svg_text(x + 6.0, y + 16.0, short_number(bars[k].value), " font-size=\"12\"");
  }
  svg += svg_text(0.5 * (names_end + bars_end), end + 44.0, label, " text-anchor=\"middle\"");
  return svg + "</svg>\n";
}

}  // namespace lichtmc
