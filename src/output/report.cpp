#include "output/report.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/base64.hpp"
#include "base/message.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/units.hpp"
#include "output/assets.hpp"
#include "output/html.hpp"
#include "output/readable.hpp"
#include "output/report_channels.hpp"
#include "output/report_figures.hpp"
#include "output/report_luminaires.hpp"
#include "output/report_origin.hpp"
#include "output/svg.hpp"
#include "room/measured_surfaces.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t max_embedded_bytes = std::size_t{24} << 20;  // of room_lit.glb

bool embeds_room(const ReportContent& content) {
  return !content.lit_room.empty() && content.lit_room.size() <= max_embedded_bytes;
}

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

std::string key_figures(const Room& room, const Result& result) {
  const std::string irradiance = written_irradiance_unit(result.quantity);
  const auto figure = [](const std::string& value, const std::string& what) {
    return element("div", text_element("b", value) + escaped(what));
  };
  std::string figures;
  figures += figure(short_number(result.balance.emitted) + " " + std::string(power_unit(result.quantity)),
                    "from " + to_text(room.emitters.size(), "emitter"));
  if (!result.tiles.empty()) {
    double lit_m2 = 0.0;
    double power = 0.0;
    for (const SurfaceResult& surface : result.surfaces) {
      lit_m2 += surface.area_m2 - surface.unreached_area_m2;
      power += surface.power;
    }
    figures += figure(short_number(lit_m2 > 0.0 ? power / lit_m2 : 0.0) + " " + irradiance, mean_of_what(room, result));
    figures += figure("± " + percent(result.walk.rms_relative_error),
                      "standard error of a tile (rms), " + to_text(result.tiles.size(), "tile"));
    figures += figure(short_count(result.walk.histories),
                      (result.settings.tile_walk == WalkDirection::forward ? "photons in " : "walks in ") +
                          short_number(result.walk.seconds) + " s");
  }
  if (!result.receiver_results.empty()) {
    double sum = 0.0;
    for (const ReceiverResult& receiver : result.receiver_results) sum += receiver.irradiance;
    figures += figure(short_number(sum / static_cast<double>(result.receiver_results.size())) + " " + irradiance,
                      "mean of " + to_text(result.receiver_results.size(), "receiver") + ", standard error of each ± " +
                          percent(result.receiver_walk.rms_relative_error) + " (rms)");
  }
  return text_element("p",
                      "The " + std::string(irradiance_word(result.quantity)) +
                          " in the room, computed by a Monte Carlo simulation of photons. All surfaces reflect "
                          "diffusely (Lambert's law). " +
                          meaning_of_errors(result),
                      " class=\"muted\"") +
         element("div", figures, " class=\"figures\"");
}

// Warnings and faults: everything that changes the meaning of the figures.
std::string warnings_section(const ReportContent& content) {
  const Result& result = *content.result;
  std::vector<std::string> sentences = result.warnings;
  for (std::string& sentence : files_left_out(result)) sentences.push_back(std::move(sentence));
  for (std::string& line : warning_lines(*content.room, content.inspection)) {
    if (std::find(sentences.begin(), sentences.end(), line) == sentences.end()) sentences.push_back(std::move(line));
  }
  std::size_t ignored = 0;
  for (const Ignored& thing : result.ignored) ignored += thing.effect == Effect::figures ? 1 : 0;
  if (ignored > 0)
    sentences.push_back(to_text(ignored, "item") + " of the file " + (ignored == 1 ? "was" : "were") +
                        " not modelled and may change the figures: see the list below.");
  if (result.walk.stopped_by == StopReason::interrupt)
    sentences.emplace_back("The run was interrupted: the figures are from the histories simulated until then.");
  if (sentences.empty()) return {};
  return element("section", text_element("h2", "Before you use these figures") + list_of(sentences),
                 " class=\"attention\"");
}

std::string pictures_section(const ReportContent& content) {
  if (content.room_picture.empty()) return {};
  std::string html = heading("The room") + element("figure", content.room_picture, " id=\"picture-room\"") +
                     element("figure", content.above_picture, " id=\"picture-above\"");
  if (!content.paths_picture.empty()) html += element("figure", content.paths_picture, " id=\"picture-paths\"");
  return html;
}

std::string view_section(const ReportContent& content) {
  if (content.lit_room.empty()) return {};
  if (!embeds_room(content)) {
    return heading("3-D view") +
           text_element("p", "The file room_lit.glb, in the folder of this page, has " +
                                 short_number(static_cast<double>(content.lit_room.size()) / 1e6) +
                                 " MB (limit for this page: 25 MB). Open it in a glTF viewer.");
  }
  return element(
      "section",
      heading("3-D view") +
          text_element(
              "p",
              "Drag to rotate, use the wheel or pinch to zoom, shift and drag to pan. Point at a surface to read its " +
                  std::string(irradiance_word(content.result->quantity)) +
                  ". The file room_lit.glb contains the same room for any glTF viewer.",
              " class=\"muted\"") +
          element("div", "", " id=\"view3d\" tabindex=\"0\""),
      " class=\"screen-only\"");
}

std::string scripts(const ReportContent& content) {
  std::string html = element("script", report_js);
  if (!embeds_room(content)) return html;
  html += element("script", base64(content.lit_room), " type=\"application/octet-stream\" id=\"room-lit\"");
  html += element("script", viewer_js);
  // Starts after the page has loaded, so that it does not delay the text.
  return html + element("script", R"(
addEventListener("load", () => {
  const bytes = Uint8Array.from(atob(document.getElementById("room-lit").textContent), c => c.charCodeAt(0));
  lichtmcView(document.getElementById("view3d"), bytes.buffer);
});
)");
}

}  // namespace

std::string report_html(const ReportContent& content) {
  const Room& room = *content.room;
  const Result& result = *content.result;
  std::string head = "<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n";
  head += text_element("title", "lichtmc: " + result.room);
  head += element("style", std::string(report_css) + std::string(viewer_css));
  const std::string body =
      text_element("h1",
                   (result.quantity == Quantity::photometric ? "Illuminance in " : "Irradiance in ") + result.room) +
      key_figures(room, result) + warnings_section(content) + pictures_section(content) + view_section(content) +
      luminaires_section(content) + surfaces_section(content) + receivers_section(result) + channels_section(content) +
      balance_section(room, result) + convergence_section(result) +
      settings_section(room, result, content.tile_images) + left_out_section(result) +
      reproduction_section(result, content.command);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n" + element("head", head) +
         element("body", element("main", body) + scripts(content)) + "</html>\n";
}

}  // namespace lichtmc
