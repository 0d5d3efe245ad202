#include "output/report_luminaires.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/luminaire_figures.hpp"
#include "lichtmc/units.hpp"
#include "output/html.hpp"
#include "output/luminaire_schedule.hpp"
#include "output/polar_diagram.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double watts_of(const Photometry& photometry) {
  return photometry.watts > 0.0 ? photometry.watts : unknown;
}

// A number to four digits: fluxes are compared with those of catalogues.
std::string figure_cell(double value) {
  if (!std::isfinite(value)) return element("td", "–");
  return element("td", rounded(value, 4), " data-value=\"" + to_text(value) + "\"");
}

// Which luminaire, and how it is used.
std::string description_of(const ScheduleRow& row, Quantity quantity) {
  const Photometry& photometry = *row.photometry;
  std::string html = text_element("b", luminaire_title(photometry));
  const auto line = [&html](const std::string& text) {
    if (!text.empty()) html += text_element("div", text);
  };
  if (!photometry.catalogue.empty() && photometry.catalogue != photometry.luminaire)
    line("Catalogue number " + photometry.catalogue);
  line(std::filesystem::path(photometry.source).filename().string() + ", " + photometry.version +
       (photometry.lamp_sets.size() > 1 ? ", lamp set " + std::to_string(photometry.lamp_set + 1) : ""));
  const std::optional<double> scale = row.scale(quantity);
  if (!scale)
    line("The file gives the shape of the intensity.");
  else if (std::abs(*scale - 1.0) > 1e-9)
    line("Scaled to " + percent(*scale) + " of the file's " + rounded(photometry.flux(), 4) + " lm.");
  if (row.maintenance_factor != 1.0)
    line("Maintenance factor " + to_text(row.maintenance_factor) + ": " + rounded(row.initial_power(), 4) + " " +
         std::string(power_unit(quantity)) + " when new.");
  line(row.area ? "Light from all over its opening: " + opening_text(photometry.opening) + "." : std::string());
  return element("td", html, " class=\"text\"");
}

std::string sum_row(const std::vector<ScheduleRow>& rows) {
  double count = 0.0;
  double power = 0.0;
  double watts = 0.0;
  for (const ScheduleRow& row : rows) {
    count += row.count();
    power += row.count() * row.power;
    watts += row.count() * watts_of(*row.photometry);
  }
  return element("tfoot", "<tr><td></td>" + text_cell("together") + figure_cell(count) + "<td></td><td></td><td></td>" +
                              flux_cell(power) + figure_cell(watts) + "</tr>\n");
}

}  // namespace

std::string luminaires_section(const ReportContent& content) {
  const Quantity quantity = content.result->quantity;
  const std::vector<ScheduleRow> rows = luminaire_schedule(*content.room);
  if (rows.empty()) return {};
  const std::string unit(power_unit(quantity));
  const bool photometric = quantity == Quantity::photometric;
  std::string body;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const ScheduleRow& row = rows[k];
    const Photometry& photometry = *row.photometry;
    std::string cells;
    if (k == 0 || rows[k - 1].file != row.file) {
      const auto of_file =
          std::count_if(rows.begin(), rows.end(), [&row](const ScheduleRow& other) { return other.file == row.file; });
      cells += element("td", polar_svg(photometry),
                       " class=\"diagram\"" + (of_file > 1 ? " rowspan=\"" + std::to_string(of_file) + "\"" : ""));
    }
    const double watts = watts_of(photometry);
    cells += description_of(row, quantity) + count_cell(row.emitters.size()) + flux_cell(row.power) +
             figure_cell(watts) + figure_cell(photometric ? photometry.efficacy().value_or(unknown) : unknown) +
             flux_cell(row.count() * row.power) + figure_cell(row.count() * watts);
    body += "<tr>" + cells + "</tr>\n";
  }
  const std::string flux = photometric ? "luminous flux" : "radiant flux";
  return heading("Luminaires") +
         text_element("p",
                      "Intensity by the photometric file of each. The flux is that of the simulation; input power and "
                      "efficacy are those that the file states, also of scaled luminaires. emitters.csv has the place "
                      "and the aim of each.",
                      " class=\"muted\"") +
         element(
             "div",
             element(
                 "table",
                 table_head({"intensity", "luminaire", "number", flux + " of each, " + unit, "input power of each, W",
                             "efficacy, lm/W", flux + " together, " + unit, "input power together, W"}) +
                     element("tbody", body) + (rows.size() > 1 || rows[0].emitters.size() > 1 ? sum_row(rows) : ""),
                 " id=\"luminaires\""),
             " class=\"scroll\"");
}

}  // namespace lichtmc
