#include "output/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <utility>

#include "base/base64.hpp"
#include "base/message.hpp"
#include "lichtmc/version.hpp"
#include "output/assets.hpp"
#include "output/chart.hpp"
#include "output/json.hpp"
#include "output/picture_svg.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t most_receiver_rows = 2000;              // a page that still opens at once
constexpr std::size_t most_embedded = std::size_t{24} << 20;  // bytes of room_lit.glb

std::string short_count(std::uint64_t count) {
  const auto number = static_cast<double>(count);
  return count < 999'500 ? short_number(number) : short_number(1e-6 * number) + " million";
}

std::string percent(double share) {
  return std::isfinite(share) ? short_number(100.0 * share) + " %" : "unknown";
}

std::string element(std::string_view tag, std::string_view content, std::string_view attributes = "") {
  return "<" + std::string(tag) + std::string(attributes) + ">" + std::string(content) + "</" + std::string(tag) +
         ">\n";
}

std::string text_element(std::string_view tag, std::string_view text, std::string_view attributes = "") {
  return element(tag, escaped(text), attributes);
}

std::string heading(std::string_view text) {
  return text_element("h2", text);
}

// A cell with a number that can be sorted by; "–" where there is none.
std::string number_cell(double value) {
  if (!std::isfinite(value)) return "<td>–</td>";
  return "<td data-value=\"" + to_text(value) + "\">" + short_number(value) + "</td>";
}

std::string count_cell(std::uint64_t value) {
  const std::string text = std::to_string(value);
  return "<td data-value=\"" + text + "\">" + text + "</td>";
}

std::string text_cell(std::string_view text) {
  return "<td class=\"text\">" + escaped(text) + "</td>";
}

std::string table_head(std::initializer_list<std::string> names) {
  std::string row;
  for (const std::string& name : names) row += "<th>" + escaped(name) + "</th>";
  return "<thead><tr>" + row + "</tr></thead>\n";
}

std::string list_of(const std::vector<std::string>& sentences) {
  std::string items;
  for (const std::string& sentence : sentences) items += text_element("li", sentence);
  return element("ul", items);
}

class Page {
 public:
  explicit Page(const ReportContent& content)
      : content_(&content),
        room_(content.room),
        result_(content.result),
        power_(power_unit(content.result->quantity)),
        irradiance_(content.result->quantity == Quantity::photometric ? "lx" : "W/m²"),
        word_(irradiance_word(content.result->quantity)) {}

  std::string html() const {
    const std::string title = "lichtmc: " + result_->room;
    std::string head = "<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n";
    head += text_element("title", title);
    head += element("style", std::string(report_css) + std::string(viewer_css));
    std::string body = text_element("h1", "Light in " + result_->room) + opening() + attention() + pictures() + view() +
                       surfaces() + receivers() + balance() + convergence() + settings() + left_out() + reproduction();
    return "<!DOCTYPE html>\n<html lang=\"en\">\n" + element("head", head) +
           element("body", element("main", body) + scripts()) + "</html>\n";
  }

 private:
  std::string opening() const;
  std::string attention() const;
  std::string pictures() const;
  std::string view() const;
  std::string surfaces() const;
  std::string receivers() const;
  std::string balance() const;
  std::string convergence() const;
  std::string settings() const;
  std::string left_out() const;
  std::string reproduction() const;
  std::string scripts() const;
  std::string plan_figure(std::size_t k) const;
  bool embeds_room() const { return !content_->lit_room.empty() && content_->lit_room.size() <= most_embedded; }

  const ReportContent* content_;
  const Room* room_;
  const Result* result_;
  std::string power_;
  std::string irradiance_;
  std::string word_;
};

std::string Page::opening() const {
  const auto figure = [](const std::string& value, const std::string& what) {
    return element("div", text_element("b", value) + escaped(what));
  };
  std::string figures;
  figures += figure(short_number(result_->balance.emitted) + " " + power_,
                    "from " + to_text(room_->emitters.size(), "emitter"));
  if (!result_->tiles.empty()) {
    double area = 0.0;
    for (const SurfaceResult& surface : result_->surfaces) area += surface.area_m2;
    figures += figure(short_number(result_->incident / area) + " " + irradiance_, "mean over all surfaces");
    figures += figure("± " + percent(result_->rms_relative_error),
                      "standard error of a tile (rms), " + to_text(result_->tiles.size(), "tile"));
    figures += figure(short_count(result_->histories),
                      (result_->settings.tiles == TileWalk::forward ? "photons in " : "walks in ") +
                          short_number(result_->seconds) + " s");
  }
  if (!result_->receiver_results.empty()) {
    double sum = 0.0;
    for (const ReceiverResult& receiver : result_->receiver_results) sum += receiver.irradiance;
    figures += figure(short_number(sum / static_cast<double>(result_->receiver_results.size())) + " " + irradiance_,
                      "mean of " + to_text(result_->receiver_results.size(), "receiver") + ", ± " +
                          percent(result_->backward.rms_relative_error) + " each (rms)");
  }
  return text_element("p",
                      "The " + word_ +
                          " of the room's surfaces, simulated by following light packets (photons) from the lamps. All "
                          "surfaces reflect diffusely. A standard error of ± 2 % says: the true value lies within 2 % "
                          "with a probability of 68 %, within 4 % with 95 %.",
                      " class=\"muted\"") +
         element("div", figures, " class=\"figures\"");
}

// What may make the figures mean something else than is thought comes before them.
std::string Page::attention() const {
  std::vector<std::string> sentences = result_->warnings;
  for (const Finding& finding : content_->inspection.findings) {
    if (finding.severity == Severity::note) continue;
    sentences.push_back(finding.text + (finding.advice.empty() ? "" : " " + finding.advice));
  }
  std::size_t ignored = 0;
  for (const Ignored& thing : result_->ignored) ignored += thing.effect == Effect::figures ? 1 : 0;
  if (ignored > 0)
    sentences.push_back(to_text(ignored, "thing") +
                        " in the file may change figures and was not modelled: see the list below.");
  if (result_->stopped_by == StopReason::interrupt)
    sentences.emplace_back("The run was interrupted; the figures are those of what was simulated until then.");
  if (sentences.empty()) return {};
  return element("section", text_element("h2", "Before you use these figures") + list_of(sentences),
                 " class=\"attention\"");
}

std::string Page::pictures() const {
  if (content_->room_picture.empty()) return {};
  std::string html = heading("The room") + element("figure", content_->room_picture, " id=\"picture-room\"") +
                     element("figure", content_->above_picture, " id=\"picture-above\"");
  if (!content_->paths_picture.empty()) html += element("figure", content_->paths_picture, " id=\"picture-paths\"");
  return html;
}

std::string Page::view() const {
  if (content_->lit_room.empty()) return {};
  if (!embeds_room()) {
    return heading("In three dimensions") +
           text_element("p", "room_lit.glb, beside this page, has " +
                                 short_number(static_cast<double>(content_->lit_room.size()) / 1e6) +
                                 " MB: too much for a page. Open it in a glTF viewer.");
  }
  return element(
      "section",
      heading("In three dimensions") +
          text_element(
              "p",
              "Drag to turn, wheel or pinch to come closer, shift and drag to move. Point at a surface to read its " +
                  word_ + ". The same room is in room_lit.glb, for any glTF viewer.",
              " class=\"muted\"") +
          element("div", "", " id=\"view3d\" tabindex=\"0\""),
      " class=\"screen-only\"");
}

std::string attribute(std::string_view name, const std::string& value) {
  return " data-" + std::string(name) + "=\"" + escaped(value) + "\"";
}

std::string vector_text(const glm::dvec3& v) {
  return to_text(v.x) + "," + to_text(v.y) + "," + to_text(v.z);
}

// What a script needs to find a tile in the picture.
std::string Page::plan_figure(std::size_t k) const {
  const SurfacePlan& plan = content_->plans[k];
  const ColourScale& scale = content_->scale;
  std::string attributes = std::string(" class=\"") + (plan.flat ? "plan" : "tile-map") + "\"" +
                           attribute("map", result_->tiling.maps[plan.map].name) +
                           attribute("low", to_text(scale.low)) + attribute("high", to_text(scale.high)) +
                           attribute("scale", scale.logarithmic ? "log" : "linear") +
                           attribute("colours", std::string(to_string(scale.colours)));
  if (plan.flat) {
    attributes += attribute("corner", vector_text(plan.corner)) + attribute("across", vector_text(plan.across)) +
                  attribute("down", vector_text(plan.down));
  }
  return element("figure", content_->plan_pictures[k], attributes);
}

std::string Page::surfaces() const {
  if (result_->tiles.empty()) return {};
  std::string rows;
  for (const SurfaceResult& s : result_->surfaces) {
    rows += "<tr>" + text_cell(s.name) + text_cell(s.material) + number_cell(s.reflectance) + number_cell(s.area_m2) +
            number_cell(s.mean_irradiance) + number_cell(s.standard_error) + number_cell(s.min_irradiance) +
            number_cell(s.max_irradiance) + number_cell(s.power) + number_cell(100.0 * s.behind_share) +
            count_cell(s.tiles) + "</tr>\n";
  }
  std::string html = heading("Surfaces");
  html += text_element("p",
                       "Click a heading to sort. Lowest and highest are those of single tiles and have their chance in "
                       "them. tiles.csv has every tile.",
                       " class=\"muted\"");
  html += element("div",
                  element("table",
                          table_head({"surface", "material", "reflectance", "area, m²", "mean, " + irradiance_,
                                      "standard error, " + irradiance_, "lowest, " + irradiance_,
                                      "highest, " + irradiance_, "arriving, " + power_, "from behind, %", "tiles"}) +
                              element("tbody", rows),
                          " class=\"sortable\" id=\"surfaces\""),
                  " class=\"scroll\"");
  if (content_->plans.empty()) return html;
  std::string figures;
  for (std::size_t k = 0; k < content_->plans.size(); ++k) figures += plan_figure(k);
  html += heading("Surfaces laid flat");
  html += text_element("p",
                       "Walls as seen from where the light is, floors and ceilings as seen from above. The largest "
                       "pieces that are at least 2 % of all surface.",
                       " class=\"muted\"");
  return html + element("div", figures, " class=\"plans\"");
}

std::string Page::receivers() const {
  const std::size_t n = result_->receiver_results.size();
  if (n == 0) return {};
  std::string rows;
  for (std::size_t k = 0; k < std::min(n, most_receiver_rows); ++k) {
    const Receiver& receiver = result_->receivers[k];
    const ReceiverResult& one = result_->receiver_results[k];
    rows += "<tr>" + text_cell(receiver.name) + number_cell(receiver.position.x) + number_cell(receiver.position.y) +
            number_cell(receiver.position.z) + number_cell(one.irradiance) + number_cell(one.standard_error) +
            number_cell(one.direct) + number_cell(one.indirect) + number_cell(10.0 * std::log10(one.gain)) + "</tr>\n";
  }
  std::string html = heading("Receivers");
  if (n > most_receiver_rows)
    html += text_element("p", "The first " + std::to_string(most_receiver_rows) + " of " + std::to_string(n) +
                                  "; receivers.csv has them all.");
  return html + element("div",
                        element("table",
                                table_head({"receiver", "x, m", "y, m", "z, m", word_ + ", " + irradiance_,
                                            "standard error, " + irradiance_, "direct, " + irradiance_,
                                            "reflected, " + irradiance_, "gain, dB"}) +
                                    element("tbody", rows),
                                " class=\"sortable\" id=\"receivers\""),
                        " class=\"scroll\"");
}

// A row of the balance: what became of so much power.
struct Share {
  std::string name;
  double power = 0.0;
  const char* colour = "";
};

std::string shares_svg(const std::vector<Share>& shares, double emitted, const std::string& unit) {
  constexpr double row = 26.0;
  constexpr double names_end = 300.0;
  constexpr double bar_width = 520.0;
  std::string svg =
      svg_head(1080.0, 44.0 + row * static_cast<double>(shares.size()) + 10.0, "Where the light went", 14.0);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double y = 44.0 + row * static_cast<double>(k);
    const double width = bar_width * std::clamp(shares[k].power / emitted, 0.0, 1.0);
    svg += svg_text(names_end - 8.0, y + 16.0, shares[k].name, " text-anchor=\"end\"");
    svg += "<rect x=\"" + fixed(names_end) + "\" y=\"" + fixed(y + 3.0) + "\" width=\"" + fixed(width) +
           "\" height=\"18\" fill=\"" + shares[k].colour + "\"/>\n";
    svg += svg_text(names_end + width + 8.0, y + 16.0,
                    short_number(shares[k].power) + " " + unit + ", " + percent(shares[k].power / emitted));
  }
  return svg + "</svg>\n";
}

std::string Page::balance() const {
  if (result_->tiles.empty()) return {};
  const Balance& b = result_->balance;
  constexpr std::size_t most_surfaces = 8;
  constexpr const char* absorbed = "#0072B2";
  std::vector<Share> shares;
  for (const SurfaceResult& s : result_->surfaces)
    shares.push_back({"absorbed by " + s.name, s.power * (1.0 - s.reflectance), absorbed});
  std::stable_sort(shares.begin(), shares.end(), [](const Share& a, const Share& c) { return a.power > c.power; });
  if (shares.size() > most_surfaces) {
    Share others{"absorbed by " + to_text(shares.size() - most_surfaces + 1, "other surface"), 0.0, "#56B4E9"};
    for (std::size_t k = most_surfaces - 1; k < shares.size(); ++k) others.power += shares[k].power;
    shares.resize(most_surfaces - 1);
    shares.push_back(others);
  }
  std::string note =
      "What surfaces absorb is what arrives there times 1 − reflectance, with the errors of the surfaces' table.";
  if (std::isfinite(b.absorbed)) {
    if (b.escaped > 0.0) shares.push_back({"left the room through openings", b.escaped, "#E69F00"});
    if (b.residual != 0.0) shares.push_back({"cut off, or taken and given by chance", b.residual, "#CC79A7"});
    if (b.lost > 0.0) shares.push_back({"lost to numerical faults", b.lost, "#D55E00"});
    note += " Counted photon by photon: emitted " + short_number(b.emitted) + " " + power_ + " = absorbed " +
            short_number(b.absorbed) + " + left the room " + short_number(b.escaped) + " + residual " +
            short_number(b.residual) + " + lost " + short_number(b.lost) + ".";
  }
  return heading("Balance of power") + element("figure", shares_svg(shares, b.emitted, power_)) +
         text_element("p", note, " class=\"muted\"");
}

ChartSeries series_of(const std::string& name, const std::vector<ErrorLook>& looks) {
  ChartSeries series{name, {}};
  for (const ErrorLook& look : looks)
    series.points.push_back({static_cast<double>(look.histories), 100.0 * look.rms_relative_error});
  return series;
}

std::string Page::convergence() const {
  LineChart chart;
  chart.title = "How the error falls";
  chart.x_label = "photons, or walks of all receivers together";
  chart.y_label = "relative standard error (rms), %";
  if (!result_->tiles.empty()) chart.series.push_back(series_of("tiles", result_->convergence));
  if (!result_->receiver_results.empty()) chart.series.push_back(series_of("receivers", result_->backward.convergence));
  const bool known = std::any_of(chart.series.begin(), chart.series.end(), [](const ChartSeries& series) {
    return std::any_of(series.points.begin(), series.points.end(),
                       [](const ChartPoint& p) { return std::isfinite(p.y) && p.y > 0.0; });
  });
  if (!known) return {};
  std::string sentence = "Four times the photons halve the error";
  sentence += result_->tiles_without_hits > 0
                  ? ", once all tiles are hit; until then it falls more slowly, as tiles with few hits join. " +
                        to_text(result_->tiles_without_hits, "tile") + " got no light yet."
                  : ".";
  return heading("Convergence") + element("figure", to_svg(chart)) + text_element("p", sentence, " class=\"muted\"");
}

std::string Page::settings() const {
  const Settings& s = result_->settings;
  std::string rows;
  const auto row = [&rows](std::string_view name, const std::string& value) {
    rows += "<tr>" + text_cell(name) + text_cell(value) + "</tr>\n";
  };
  row("estimator", std::string(to_string(result_->tiles.empty() ? result_->backward.estimator : result_->estimator)));
  row("engine", std::string(to_string(result_->engine)));
  row("seed", std::to_string(s.seed));
  if (!result_->tiles.empty()) {
    row("edge of a tile", short_number(s.tile_edge_m) + " m");
    row("tiles measured",
        s.tiles == TileWalk::forward ? "by photons from the emitters" : "by walks back from the tiles");
    row("direct light", direct_is_apart(*result_) ? "integrated" : "counted with all other light");
    row("photons", std::to_string(result_->histories));
    row("impacts", std::to_string(result_->impacts));
    row("ended by", std::string(to_string(result_->stopped_by)));
  }
  if (!result_->receiver_results.empty()) {
    row("walks from receivers", std::to_string(result_->backward.histories));
    row("ended by (receivers)", std::string(to_string(result_->backward.stopped_by)));
  }
  if (s.target_error) row("target error", percent(*s.target_error));
  if (s.max_seconds) row("time limit", short_number(*s.max_seconds) + " s");
  if (s.max_bounces) row("cut off after", std::to_string(*s.max_bounces) + " flights");
  row("threads", std::to_string(result_->threads));
  std::string emitters;
  for (const Emitter& e : room_->emitters)
    emitters += "<tr>" + text_cell(e.name) + text_cell(kind_of(e)) + number_cell(e.power) + "</tr>\n";
  std::string html = heading("What was simulated") + element("table", rows);
  if (!result_->choices.empty()) html += list_of(result_->choices);
  if (!result_->mended.empty()) html += text_element("p", "Changed after reading:") + list_of(result_->mended);
  return html + heading("Emitters") +
         element("table", table_head({"emitter", "kind", "power, " + power_}) + element("tbody", emitters),
                 " class=\"sortable\" id=\"emitters\"");
}

std::string Page::left_out() const {
  std::vector<std::string> sentences;
  for (const Ignored& thing : result_->ignored)
    sentences.push_back(thing.what + (thing.effect == Effect::figures ? " (may change figures)" : ""));
  if (sentences.empty()) return {};
  return heading("In the file, but not modelled") + list_of(sentences);
}

std::string Page::reproduction() const {
  std::string html = heading("To reproduce this");
  if (!content_->command.empty()) html += text_element("pre", content_->command);
  if (result_->stopped_by == StopReason::max_time || result_->stopped_by == StopReason::interrupt) {
    html += text_element("p", "The clock ended this run, and clocks differ. To get the same digits give it --photons " +
                                  std::to_string(result_->histories) + " instead of a time.");
  }
  return html + text_element("p",
                             "lichtmc " + std::string(version()) +
                                 ". The same room, settings, seed and number of photons give the same figures to the "
                                 "last digit, for any number of threads.",
                             " class=\"muted\"");
}

std::string Page::scripts() const {
  std::string html = element("script", report_js);
  if (!embeds_room()) return html;
  html += element("script", base64(content_->lit_room), " type=\"application/octet-stream\" id=\"room-lit\"");
  html += element("script", viewer_js);
  // After the page is there to be read.
  return html + element("script", R"(
addEventListener("load", () => {
  const bytes = Uint8Array.from(atob(document.getElementById("room-lit").textContent), c => c.charCodeAt(0));
  lichtmcView(document.getElementById("view3d"), bytes.buffer);
});
)");
}

}  // namespace

std::string report_html(const ReportContent& content) {
  return Page(content).html();
}

}  // namespace lichtmc
