#include "output/report.hpp"

#include <cctype>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/overrides.hpp"
#include "lichtmc/units.hpp"
#include "lichtmc/visible_text.hpp"
#include "output/assets.hpp"
#include "output/html.hpp"
#include "output/picture_marks.hpp"
#include "output/readable.hpp"
#include "output/report_areas.hpp"
#include "output/report_channels.hpp"
#include "output/report_figures.hpp"
#include "output/report_lighting.hpp"
#include "output/report_luminaires.hpp"
#include "output/report_origin.hpp"
#include "output/report_pictures.hpp"
#include "output/report_receivers.hpp"
#include "output/report_remarks.hpp"
#include "output/svg.hpp"
#include "room/measured_surfaces.hpp"

namespace lichtmc {

namespace {

std::string mean_of_what(const Room& room, const Result& result) {
  if (!measures_all(room)) return "mean over the measured surfaces";
  return unreached_text(result).empty() ? "mean over all surfaces" : "mean over all that light can reach";
}

// The meaning of the errors, for readers who know no statistics.
std::string meaning_of_errors(const Result& result) {
  std::string text;
  if (!result.tiles.empty()) text += error_text(result, Measured::tiles);
  if (!result.receiver_results.empty()) text += (text.empty() ? "" : " ") + error_text(result, Measured::receivers);
  return text;
}

std::string key_figure(const std::string& value, const std::string& what) {
  return element("div", text_element("b", value) + escaped(what));
}

// Of the receivers that are no points of calculation areas; empty if there are none.
std::string receiver_figure(const Result& result) {
  const std::vector<bool> of_areas = points_of_areas(result);
  double sum = 0.0;
  double squares = 0.0;  // of the relative errors
  std::size_t count = 0;
  std::size_t with_error = 0;
  for (std::size_t k = 0; k < of_areas.size(); ++k) {
    if (of_areas[k]) continue;
    const ReceiverResult& one = result.receiver_results[k];
    ++count;
    sum += one.irradiance;
    if (!(one.irradiance > 0.0) || !std::isfinite(one.standard_error)) continue;
    squares += std::pow(one.standard_error / one.irradiance, 2);
    ++with_error;
  }
  if (count == 0) return {};
  const double error = count == of_areas.size() ? result.receiver_walk.rms_relative_error
                                                : std::sqrt(squares / static_cast<double>(with_error));
  return key_figure(short_number(sum / static_cast<double>(count)) + " " + written_irradiance_unit(result.quantity),
                    "mean of " + to_text(count, "receiver") +
                        (std::isfinite(error) ? ", standard error of each ± " + percent(error) + " (rms)" : ""));
}

std::string key_figures(const Room& room, const Result& result) {
  const std::string irradiance = written_irradiance_unit(result.quantity);
  std::string figures;
  figures += key_figure(short_number(result.balance.emitted) + " " + std::string(power_unit(result.quantity)),
                        "from " + to_text(room.emitters.size(), "emitter"));
  if (!result.tiles.empty()) {
    double lit_m2 = 0.0;
    double power = 0.0;
    for (const SurfaceResult& surface : result.surfaces) {
      lit_m2 += surface.area_m2 - surface.unreached_area_m2;
      power += surface.power;
    }
    figures +=
        key_figure(short_number(lit_m2 > 0.0 ? power / lit_m2 : 0.0) + " " + irradiance, mean_of_what(room, result));
    figures += key_figure("± " + percent(result.walk.rms_relative_error),
                          "standard error of a tile (rms), " + to_text(result.tiles.size(), "tile"));
    figures += key_figure(short_count(result.walk.histories),
                          (result.settings.tile_walk == WalkDirection::forward ? "photons in " : "walks in ") +
                              short_number(result.walk.seconds) + " s");
  }
  figures += receiver_figure(result);
  const std::string maintained = maintained_text(room);
  return text_element("p",
                      "The " + std::string(irradiance_word(result.quantity)) +
                          " in the room, computed by a Monte Carlo simulation of photons. All surfaces reflect "
                          "diffusely (Lambert's law). " +
                          (maintained.empty() ? "" : maintained + ". ") + meaning_of_errors(result),
                      " class=\"muted\"") +
         element("div", figures, " class=\"figures\"");
}

// The technical report; in a lighting report behind the pages for the client, without what these contain.
std::string technical_report(const ReportContent& content) {
  const Room& room = *content.room;
  const Result& result = *content.result;
  const bool whole = content.style == ReportStyle::technical;
  std::string html = key_figures(room, result) + remarks_section(content);
  if (whole)
    html += area_verdicts(content) + area_plans(content) + pictures_section(content) + view_section(content) +
            luminaires_section(content);
  html += area_details(content) + surfaces_section(content);
  if (whole) html += receivers_section(content);
  return html + channels_section(content) + balance_section(room, result) + convergence_section(result) +
         settings_section(room, result, content.tile_images) + left_out_section(result) +
         reproduction_section(result, content.command);
}

// A text as a string of CSS, also within the style element of a page.
std::string css_string(std::string_view text) {
  std::string css;
  for (const char letter : visible_text(text)) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool plain = byte >= 0x80 || std::isalnum(byte) != 0 || letter == ' ' || letter == '.' || letter == ',';
    constexpr const char* digits = "0123456789abcdef";
    css += plain ? std::string(1, letter) : std::string("\\") + digits[byte / 16] + digits[byte % 16] + ' ';
  }
  return "\"" + css + "\"";
}

// The foot of each printed page.
std::string page_foot(const ReportContent& content) {
  return "@page { @bottom-left { content: " + css_string(shortened(subject_of(content), 13.0, 500.0)) + "; } }\n";
}

}  // namespace

std::string report_html(const ReportContent& content) {
  const Result& result = *content.result;
  const bool lighting = content.style == ReportStyle::lighting;
  const std::string word = result.quantity == Quantity::photometric ? "Illuminance in " : "Irradiance in ";
  std::string head = "<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n";
  head += text_element("title", lighting ? subject_of(content) : "lichtmc: " + result.room);
  head += element("style", std::string(report_css) + std::string(viewer_css) + page_foot(content));
  const std::string body = lighting
                               ? lighting_pages(content) +
                                     element("div", text_element("h1", "Technical details") + technical_report(content),
                                             " class=\"appendix\"")
                               : text_element("h1", word + result.room) + technical_report(content);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n" + element("head", head) +
         element("body", element("main", body) + scripts_of_page(content)) + "</html>\n";
}

}  // namespace lichtmc
