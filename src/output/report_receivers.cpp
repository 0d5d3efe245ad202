#include "output/report_receivers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "lichtmc/units.hpp"
#include "output/html.hpp"
#include "output/picture_marks.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t max_receiver_rows = 2000;  // browsers open a page of this size without delay

// The receivers of the table.
std::vector<std::size_t> listed_receivers(const ReportContent& content) {
  const Result& result = *content.result;
  const bool all = content.style != ReportStyle::lighting;
  const std::vector<bool> of_areas = points_of_areas(result);
  std::vector<std::size_t> listed;
  for (std::size_t k = 0; k < result.receiver_results.size(); ++k) {
    if (all || !of_areas[k]) listed.push_back(k);
  }
  return listed;
}

}  // namespace

std::string receivers_section(const ReportContent& content) {
  const Result& result = *content.result;
  const std::vector<std::size_t> listed = listed_receivers(content);
  const std::size_t n = listed.size();
  if (n == 0) return {};
  const std::string irradiance = written_irradiance_unit(result.quantity);
  const bool gains = result.quantity == Quantity::radiometric || result.channels.has_value();
  std::string rows;
  for (std::size_t k = 0; k < std::min(n, max_receiver_rows); ++k) {
    const Receiver& receiver = result.receivers[listed[k]];
    const ReceiverResult& one = result.receiver_results[listed[k]];
    rows += "<tr>" + text_cell(receiver.name) + number_cell(receiver.position.x) + number_cell(receiver.position.y) +
            number_cell(receiver.position.z) + number_cell(one.irradiance) + number_cell(one.standard_error) +
            number_cell(one.direct) + number_cell(one.indirect) +
            (gains ? number_cell(10.0 * std::log10(one.gain)) : "") + "</tr>\n";
  }
  std::string html = heading("Receivers");
  if (n > max_receiver_rows)
    html += text_element("p", "The first " + std::to_string(max_receiver_rows) + " of " + std::to_string(n) +
                                  " receivers. receivers.csv contains all of them.");
  std::vector<std::string> names{"receiver",
                                 "x, m",
                                 "y, m",
                                 "z, m",
                                 std::string(irradiance_word(result.quantity)) + ", " + irradiance,
                                 "standard error, " + irradiance,
                                 "direct, " + irradiance,
                                 "indirect, " + irradiance};
  if (gains) names.emplace_back("gain, dB");
  return html +
         element("div",
                 element("table", table_head(names) + element("tbody", rows), " class=\"sortable\" id=\"receivers\""),
                 " class=\"scroll\"");
}

}  // namespace lichtmc
