#include "output/report_lighting.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/units.hpp"
#include "lichtmc/version.hpp"
#include "output/area_words.hpp"
#include "output/html.hpp"
#include "output/json.hpp"
#include "output/luminaire_schedule.hpp"
#include "output/readable.hpp"
#include "output/report_areas.hpp"
#include "output/report_luminaires.hpp"
#include "output/report_pictures.hpp"
#include "output/report_receivers.hpp"
#include "output/report_remarks.hpp"
#include "output/svg.hpp"
#include "output/tile_extremes.hpp"
#include "room/emitter_place.hpp"
#include "room/measured_surfaces.hpp"

namespace lichtmc {

namespace {

std::string file_name_of_room(const Result& result) {
  const std::string name = std::filesystem::path(result.room).filename().string();
  return name.empty() ? result.room : name;
}

bool is_photometric(const ReportContent& content) {
  return content.result->quantity == Quantity::photometric;
}

std::string client_title(const ReportContent& content) {
  std::string lines;
  const auto line = [&lines](std::string_view name, const std::string& value) {
    if (!value.empty()) lines += "<div>" + text_element("dt", name) + text_element("dd", value) + "</div>\n";
  };
  line("Project", content.project);
  line("Room", file_name_of_room(*content.result));
  line("Author", content.author);
  line("Date", content.date);
  return element("header",
                 text_element("h1", is_photometric(content) ? "Lighting calculation" : "Irradiance calculation") +
                     element("dl", lines),
                 " class=\"title\"");
}

// Without areas: the mean over the surfaces, or over the receivers.
std::string figures_without_areas(const ReportContent& content) {
  const Result& result = *content.result;
  if (!result.areas.empty()) return {};
  const std::string unit = " " + written_irradiance_unit(result.quantity);
  std::string text = "No calculation area was defined.";
  double area = 0.0;
  double power = 0.0;
  for (const SurfaceResult& surface : result.surfaces) {
    area += surface.area_m2 - surface.unreached_area_m2;
    power += surface.power;
  }
  if (area > 0.0)
    text += " Mean " + std::string(irradiance_word(result.quantity)) + " of all " +
            (measures_all(*content.room) ? "" : "measured ") + "surfaces: " + short_number(power / area) + unit + ".";
  return text_element("p", text);
}

// Remarks concern whoever made the model: they follow with the technical details, and the first page says so.
std::string notice_of_remarks(const ReportContent& content) {
  const std::size_t count = remarks_of(content).size();
  if (count == 0) return {};
  return element("p",
                 "<a href=\"#remarks\">" + to_text(count, "remark") + "</a> on the model of the room and on the " +
                     "calculation may concern these figures: see “Before you use these figures” in the technical " +
                     "details.",
                 " class=\"notice\"");
}

// Light sources without a photometric file, those of the same kind, power and maintenance factor together.
struct SourceRow {
  std::string_view kind;
  double power = 0.0;
  double maintenance_factor = 1.0;
  std::size_t count = 0;
  Names names;
};

std::string source_words(const SourceRow& row, Quantity quantity) {
  std::string text = row.kind == "surface"     ? "area light"
                     : row.kind == "isotropic" ? "isotropic point light"
                     : row.kind == "lambert"   ? "point light, generalized Lambert (cos^m)"
                                               : std::string(row.kind);
  if (row.maintenance_factor != 1.0)
    text += "; maintenance factor " + rounded(row.maintenance_factor, 4) + ", new " +
            rounded(row.power / row.maintenance_factor, 5) + " " + std::string(power_unit(quantity));
  return text;
}

std::string client_sources(const ReportContent& content) {
  const Room& room = *content.room;
  std::vector<SourceRow> sources;
  for (const Emitter& emitter : room.emitters) {
    if (photometry_of(emitter) != nullptr) continue;
    const auto same = std::find_if(sources.begin(), sources.end(), [&emitter](const SourceRow& row) {
      return row.kind == kind_of(emitter) && row.power == emitter.power &&
             row.maintenance_factor == emitter.maintenance_factor;
    });
    SourceRow& row = same != sources.end() ? *same : sources.emplace_back();
    row.kind = kind_of(emitter);
    row.power = emitter.power;
    row.maintenance_factor = emitter.maintenance_factor;
    ++row.count;
    row.names.add(in_quotes(emitter.name));
  }
  if (sources.empty()) return {};
  std::string rows;
  double all = 0.0;
  std::size_t count = 0;
  for (const SourceRow& row : sources) {
    const double together = static_cast<double>(row.count) * row.power;
    rows += "<tr>" + text_cell(row.names.text()) + text_cell(source_words(row, room.quantity)) + count_cell(row.count) +
            flux_cell(row.power) + flux_cell(together) + "</tr>\n";
    all += together;
    count += row.count;
  }
  if (sources.size() > 1)
    rows += "<tr class=\"sum\">" + text_cell("together") + "<td></td>" + count_cell(count) + "<td></td>" +
            flux_cell(all) + "</tr>\n";
  const std::string unit = ", " + std::string(power_unit(room.quantity));
  const std::string flux = is_photometric(content) ? "luminous flux" : "radiant flux";
  const bool alone = luminaire_schedule(room).empty();
  return heading(alone ? "Luminaires" : "Light sources without a photometric file") +
         element("div",
                 element("table",
                         table_head(
                             {"light source", "kind", "number", flux + " of each" + unit, flux + " together" + unit}) +
                             element("tbody", rows),
                         " id=\"sources\""),
                 " class=\"scroll\"");
}

// The surfaces with the largest lit areas, of at least 1 % of all each.
std::vector<std::size_t> largest_surfaces(const Result& result) {
  constexpr std::size_t most = 40;  // a page and a half
  constexpr double least_share = 0.01;
  const auto lit = [&result](std::size_t m) {
    return result.surfaces[m].area_m2 - result.surfaces[m].unreached_area_m2;
  };
  double all = 0.0;
  for (std::size_t m = 0; m < result.surfaces.size(); ++m) all += lit(m);
  std::vector<std::size_t> order;
  for (std::size_t m = 0; m < result.surfaces.size(); ++m) {
    if (result.surfaces[m].mean_irradiance > 0.0 && lit(m) >= least_share * all) order.push_back(m);
  }
  std::stable_sort(order.begin(), order.end(), [&lit](std::size_t a, std::size_t b) { return lit(a) > lit(b); });
  order.resize(std::min(order.size(), most));
  return order;
}

// An extreme value, or a limit of it: "< 12".
std::string extreme_cell(const char* sign, const std::string& text, double value) {
  if (!std::isfinite(value)) return element("td", "–");
  return element("td", sign + text, " data-value=\"" + to_text(value) + "\"");
}

std::string client_surface_row(const ReportContent& content, std::size_t m, const TileExtremes& extremes) {
  const SurfaceResult& s = content.result->surfaces[m];
  const char* below = extremes.below ? "&lt; " : "";
  const double uniformity = extremes.minimum / s.mean_irradiance;
  constexpr double least_limit = 0.01;  // of two decimals
  return "<tr>" + text_cell(s.name) + text_cell(content.lit_sides.empty() ? "" : content.lit_sides[m]) +
         number_cell(s.area_m2 - s.unreached_area_m2) + number_cell(s.reflectance) +
         element("td", escaped(figure_text({s.mean_irradiance, s.standard_error})),
                 " data-value=\"" + to_text(s.mean_irradiance) + "\"") +
         extreme_cell(below, short_number(extremes.minimum), extremes.minimum) +
         extreme_cell(extremes.above ? "&gt; " : "", short_number(extremes.maximum), extremes.maximum) +
         extreme_cell(below, decimals_of(extremes.below ? std::max(uniformity, least_limit) : uniformity, 2),
                      uniformity) +
         "</tr>\n";
}

std::string client_surfaces(const ReportContent& content) {
  const Result& result = *content.result;
  if (result.tiles.empty()) return {};
  const std::vector<std::size_t> shown = largest_surfaces(result);
  if (shown.empty()) return {};
  const std::string unit = ", " + written_irradiance_unit(result.quantity);
  const std::vector<TileExtremes> extremes = tile_extremes(result);
  std::string rows;
  bool limits = false;
  for (const std::size_t m : shown) {
    rows += client_surface_row(content, m, extremes[m]);
    limits = limits || extremes[m].below || extremes[m].above;
  }
  const std::size_t others = result.surfaces.size() - shown.size();
  const char* uniformity = is_photometric(content) ? "U0" : "uniformity";
  std::string note =
      "Over the area that light can reach, without outer faces and undersides. Minimum and maximum are "
      "those of single tiles with an edge of " +
      rounded(result.settings.tile_edge_m, 3) + " m and include their statistical errors, so that " + uniformity +
      " = minimum/mean is rather too low.";
  if (limits)
    note +=
        " < and >: places that few photons reach are darker, or brighter, than this; a longer calculation shows by "
        "how much.";
  if (others > 0)
    note += " " + to_text(others, "surface") + " with less than 1 % of the lit area each" +
            (others == 1 ? " is" : " are") + " not shown: surfaces.csv contains all.";
  return heading("Surfaces") +
         element("div",
                 element("table",
                         table_head({"surface", "lit side", "lit area, m²", "reflectance", "mean" + unit,
                                     "minimum" + unit, "maximum" + unit, uniformity}) +
                             element("tbody", rows),
                         " class=\"sortable\" id=\"lit-surfaces\""),
                 " class=\"scroll\"") +
         text_element("p", note, " class=\"muted\"");
}

// Where the surfaces were not measured: what they reflect.
std::string client_materials(const ReportContent& content) {
  constexpr std::size_t most = 40;
  if (!content.result->tiles.empty()) return {};
  struct Material {
    std::string name;
    double reflectance = 0.0;
    double area_m2 = 0.0;
  };
  std::vector<Material> materials;
  for (const Surface& surface : content.room->surfaces) {
    const std::string& name = surface.material.empty() ? surface.name : surface.material;
    const auto same = std::find_if(materials.begin(), materials.end(), [&](const Material& other) {
      return other.name == name && other.reflectance == surface.reflectance;
    });
    Material& material =
        same != materials.end() ? *same : materials.emplace_back(Material{name, surface.reflectance, 0.0});
    material.area_m2 += surface_area(surface);
  }
  std::stable_sort(materials.begin(), materials.end(),
                   [](const Material& a, const Material& b) { return a.area_m2 > b.area_m2; });
  std::string rows;
  for (std::size_t k = 0; k < std::min(most, materials.size()); ++k)
    rows += "<tr>" + text_cell(materials[k].name) + number_cell(materials[k].reflectance) +
            number_cell(materials[k].area_m2) + "</tr>\n";
  const std::string left_out =
      materials.size() > most ? text_element("p",
                                             "The " + std::to_string(most) + " of " +
                                                 to_text(materials.size(), "material") + " with the largest areas.",
                                             " class=\"muted\"")
                              : std::string();
  return heading("Reflectances") +
         element(
             "div",
             element("table", table_head({"material", "reflectance", "area of all faces, m²"}) + element("tbody", rows),
                     " id=\"materials\""),
             " class=\"scroll\"") +
         left_out;
}

// How many photons and paths, in words.
std::string method_text(const ReportContent& content) {
  const Result& result = *content.result;
  std::string text = "lichtmc " + std::string(version()) +
                     " follows photons, particles of light, from the luminaires through the room until they are "
                     "absorbed (Monte Carlo simulation), with all reflections between the surfaces. ";
  if (!result.tiles.empty())
    text += "For the surfaces it followed " + short_count(result.walk.histories) +
            (result.settings.tile_walk == WalkDirection::forward ? " photons. " : " paths of light. ");
  if (!result.receiver_results.empty())
    text += "For the points of areas it evaluated " + short_count(result.receiver_walk.histories) +
            " paths of light between luminaires and points; the light that comes straight from a luminaire is "
            "calculated directly. ";
  return text +
         "Every surface reflects diffusely, with the reflectance in the table above; gloss, mirrors and daylight are "
         "not "
         "part of the model.";
}

std::string trust_section(const ReportContent& content) {
  const Result& result = *content.result;
  std::vector<std::string> sentences{
      "A figure after ± is the standard error of the calculation. If the calculation were repeated many times, two of "
      "three results would lie within one standard error of the true value of the model, and 19 of 20 within two."};
  const bool targets = std::any_of(result.areas.begin(), result.areas.end(),
                                   [](const AreaResult& area) { return area.verdict != Verdict::none; });
  if (targets)
    sentences.emplace_back(
        "“pass” and “fail” are only said if the figure is at least two standard errors from the target; nearer it is "
        "“undecided”, and a longer calculation decides.");
  if (!result.areas.empty())
    sentences.emplace_back(
        "Minimum and uniformity are corrected for the statistical errors of the points: without that, the lowest of "
        "many values would be too low.");
  if (is_photometric(content)) sentences.push_back(maintenance_text(*content.room));
  sentences.emplace_back(
      "The errors are those of the calculation alone. How well the model agrees with the room (reflectances, "
      "furniture, "
      "tolerances of luminaires, voltage, temperature) is not part of them.");
  return heading("How this was calculated, and how sure it is") + text_element("p", method_text(content)) +
         list_of(sentences);
}

}  // namespace

std::string subject_of(const ReportContent& content) {
  return content.project.empty() ? file_name_of_room(*content.result) : content.project;
}

std::string lighting_pages(const ReportContent& content) {
  return client_title(content) + area_verdicts(content) + figures_without_areas(content) + notice_of_remarks(content) +
         area_plans(content) + luminaires_section(content) + client_sources(content) + pictures_section(content) +
         view_section(content) + client_surfaces(content) + client_materials(content) + receivers_section(content) +
         trust_section(content);
}

}  // namespace lichtmc
