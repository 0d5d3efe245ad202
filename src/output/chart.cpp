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
  // Keeps a value within the axis.
  double inside(double value) const {
    const double low = scale_ == Scale::logarithmic ? std::pow(10.0, low_) : low_;
    const double high = scale_ == Scale::logarithmic ? std::pow(10.0, high_) : high_;
    return std::clamp(value, low, high);
  }
  // Whether the axis, which may end before the data, reaches a value, up to rounding.
  bool reaches(double value) const {
    constexpr double rounding = 1e-9;  // of the length of the axis
    const double part = contains(value) ? (at(value) - from_) / (to_ - from_) : -1.0;
    return part >= -rounding && part <= 1.0 + rounding;
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
    constexpr double rounding = 1.0 - 1e-9;  // 120 in six steps are steps of 20
    const double rough = rounding * (high_ - low_) / 6.0;
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

// `thin`: for lines of many points, which would hide what is behind them.
std::string style_of(std::size_t series, bool thin = false) {
  const std::string dash = dashes.at(series / colours.size() % dashes.size());
  return "stroke=\"" + std::string(colours.at(series % colours.size())) + "\" stroke-width=\"" + (thin ? "1" : "2") +
         "\" fill=\"none\"" + (dash.empty() ? "" : " stroke-dasharray=\"" + dash + "\"");
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

std::string colour_of(std::size_t series) {
  return colours.at(series % colours.size());
}

Axis x_axis(const LineChart& chart) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low = infinity, high = -infinity;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) extend(point.x, chart.x_scale, low, high);
  }
  for (const ChartArea& area : chart.areas) {
    for (const ChartRange& range : area.range) extend(range.x, chart.x_scale, low, high);
  }
  return {chart.x_scale, low, high, left, right};
}

Axis y_axis(const LineChart& chart) {
  if (chart.y_limits) return {chart.y_scale, chart.y_limits->low, chart.y_limits->high, bottom, top};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low = infinity, high = -infinity;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) extend(point.y, chart.y_scale, low, high);
  }
  for (const ChartArea& area : chart.areas) {
    for (const ChartRange& range : area.range) {
      extend(range.low, chart.y_scale, low, high);
      extend(range.high, chart.y_scale, low, high);
    }
  }
  return {chart.y_scale, low, high, bottom, top};
}

std::string coordinates(double x, double y) {
  return fixed(x) + "," + fixed(y) + " ";
}

// The ranges as one or more polygons, cut off at the ends of the y axis: there are gaps where nothing is inside it.
std::string filled(const std::vector<ChartRange>& ranges, const Axis& x, const Axis& y, const std::string& colour,
                   double opacity) {
  std::string svg;
  std::string forth;
  std::string back;
  const auto close = [&] {
    if (!forth.empty())
      svg += "<polygon points=\"" + forth + back + "\" fill=\"" + colour + "\" fill-opacity=\"" + fixed(opacity) +
             "\"/>\n";
    forth.clear();
    back.clear();
  };
  for (const ChartRange& range : ranges) {
    const double low = y.at(y.inside(range.low));
    const double high = y.at(y.inside(range.high));
    if (!x.contains(range.x) || !std::isfinite(range.low) || !std::isfinite(range.high) || low == high) {
      close();
      continue;
    }
    forth += coordinates(x.at(range.x), high);
    back.insert(0, coordinates(x.at(range.x), low));
  }
  close();
  return svg;
}

constexpr std::size_t many_points = 500;  // about one for each unit of the width

std::string lines(const ChartSeries& series, std::size_t number, const Axis& x, const Axis& y) {
  std::string svg;
  std::string points;
  std::string dots;
  const auto end_line = [&] {
    if (!points.empty())
      svg += "<polyline points=\"" + points + "\" " + style_of(number, series.points.size() > many_points) + "/>\n";
    points.clear();
  };
  for (const ChartPoint& point : series.points) {
    if (!x.contains(point.x) || !y.reaches(point.y)) {
      if (series.gaps) end_line();
      continue;
    }
    points += coordinates(x.at(point.x), y.at(point.y));
    if (series.dots)
      dots += "<circle cx=\"" + fixed(x.at(point.x)) + "\" cy=\"" + fixed(y.at(point.y)) + "\" r=\"3\" fill=\"" +
              colour_of(number) + "\"/>\n";
  }
  end_line();
  return svg + dots;
}

std::string marks(const LineChart& chart, const Axis& x, const Axis& y) {
  constexpr const char* style = "class=\"frame\" stroke-dasharray=\"5 4\"";
  constexpr const char* small = " font-size=\"12\"";
  std::string svg;
  for (const ChartMark& mark : chart.x_marks) {
    if (!x.reaches(mark.at)) continue;
    const double at = x.at(mark.at);
    svg += svg_line(at, top, at, bottom, style);
    const bool to_the_left = at + 4.0 + text_width(mark.label, 12.0) > right;
    svg += svg_text(at + (to_the_left ? -4.0 : 4.0), top + 14.0, mark.label,
                    to_the_left ? std::string(small) + " text-anchor=\"end\"" : small);
  }
  for (const ChartMark& mark : chart.y_marks) {
    if (!y.reaches(mark.at)) continue;
    svg += svg_line(left, y.at(mark.at), right, y.at(mark.at), style);
    // On paper, because a curve may pass there.
    const double text = text_width(mark.label, 12.0);
    svg += "<rect x=\"" + fixed(right - 4.0 - text) + "\" y=\"" + fixed(y.at(mark.at) - 15.0) + "\" width=\"" +
           fixed(text) + "\" height=\"14\" class=\"paper\" fill-opacity=\"0.8\"/>\n";
    svg += svg_text(right - 4.0, y.at(mark.at) - 4.0, mark.label, std::string(small) + " text-anchor=\"end\"");
  }
  return svg;
}

// The names to the right of the chart, from above.
class Legend {
 public:
  std::string line(const std::string& name, std::size_t series) {
    return named(svg_line(right + 14.0, row_ - 4.0, right + 44.0, row_ - 4.0, style_of(series)), name);
  }
  std::string area(const std::string& name, const std::string& colour) {
    return named("<rect x=\"" + fixed(right + 14.0) + "\" y=\"" + fixed(row_ - 11.0) +
                     "\" width=\"30\" height=\"13\" fill=\"" + colour + "\" fill-opacity=\"0.8\"/>\n",
                 name);
  }
  std::string notes(const std::vector<std::string>& sentences) {
    std::string svg;
    for (const std::string& sentence : sentences) {
      row_ += 8.0;
      for (const std::string& part : text_lines(sentence, 12.0, width - right - 24.0)) {
        svg += svg_text(right + 14.0, row_, part, " font-size=\"12\"");
        row_ += 16.0;
      }
    }
    return svg;
  }

 private:
  std::string named(const std::string& sign, const std::string& name) {
    const std::string svg = sign + svg_text(right + 50.0, row_, name, " font-size=\"12\"");
    row_ += 20.0;
    return svg;
  }

  double row_ = top + 12.0;
};

}  // namespace

std::string to_svg(const LineChart& chart) {
  const Axis x = x_axis(chart);
  const Axis y = y_axis(chart);
  std::string svg = svg_head(width, height, chart.title, left) + grid(x, y, chart);
  Legend legend;
  for (std::size_t k = 0; k < chart.areas.size(); ++k) {
    svg += filled(chart.areas[k].range, x, y, colour_of(k), 0.8);
    svg += legend.area(chart.areas[k].name, colour_of(k));
  }
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    svg += filled(chart.series[k].band, x, y, colour_of(k), 0.3);
    svg += lines(chart.series[k], k, x, y);
    svg += legend.line(chart.series[k].name, k);
  }
  return svg + marks(chart, x, y) + legend.notes(chart.notes) + "</svg>\n";
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
