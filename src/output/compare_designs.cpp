#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>

#include "base/message.hpp"
#include "lichtmc/compare.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_design(const fs::path& file, const std::string& fault) {
  throw InputError("Cannot read " + in_quotes(file.string()) + " (" + fault +
                   "). Give an output folder of 'lichtmc run' with calculation areas, or run it again.");
}

// A number; NaN where the file has null.
double number_of(const nlohmann::json& object, const std::string& key) {
  const nlohmann::json& value = object.at(key);
  return value.is_null() ? std::nan("") : value.get<double>();
}

Figure figure_of(const nlohmann::json& area, const std::string& key) {
  return {number_of(area, key), number_of(area, key + "_se")};
}

std::optional<double> known(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

Verdict verdict_of(const nlohmann::json& area, const std::string& key) {
  if (!area.contains(key) || area.at(key).is_null()) return Verdict::none;
  const auto text = area.at(key).get<std::string>();
  for (const Verdict one : {Verdict::pass, Verdict::fail, Verdict::undecided}) {
    if (to_string(one) == text) return one;
  }
  return Verdict::none;
}

struct Design {
  std::string unit;
  std::vector<DesignArea> areas;
  DesignTotals total;
};

// The schedule must hold every emitter: else the sum would be too small without a word.
std::optional<double> watts_of(const nlohmann::json& summary) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const nlohmann::json& luminaire : summary.at("luminaires")) {
    const double watts = number_of(luminaire, "total_watts");
    if (std::isnan(watts)) return std::nullopt;
    sum += watts;
    count += luminaire.at("count").get<std::size_t>();
  }
  return count > 0 && count == summary.at("emitters").size() ? std::optional<double>(sum) : std::nullopt;
}

// Of all emitters; NaN, if the file does not tell it.
void set_maintenance(const nlohmann::json& summary, DesignTotals& total) {
  if (summary.contains("maintenance_factor") && !summary.at("maintenance_factor").is_null()) {
    total.least_maintenance_factor = number_of(summary, "maintenance_factor");
    total.greatest_maintenance_factor = total.least_maintenance_factor;
    return;
  }
  if (!summary.contains("emitters")) return;
  for (const nlohmann::json& emitter : summary.at("emitters")) {
    const double factor =
        emitter.contains("maintenance_factor") ? number_of(emitter, "maintenance_factor") : std::nan("");
    if (std::isnan(factor)) {
      total.least_maintenance_factor = total.greatest_maintenance_factor = std::nan("");
      return;
    }
    total.least_maintenance_factor = std::fmin(total.least_maintenance_factor, factor);
    total.greatest_maintenance_factor = std::fmax(total.greatest_maintenance_factor, factor);
  }
}

Design design_of(const nlohmann::json& summary) {
  Design design;
  design.unit = summary.at("unit").get<std::string>();
  design.total.power = number_of(summary, "emitted");
  set_maintenance(summary, design.total);
  if (summary.contains("luminaires")) design.total.watts = watts_of(summary);  // a scene has none
  for (const nlohmann::json& area : summary.at("areas")) {
    design.areas.push_back({area.at("name").get<std::string>(), area.at("role").get<std::string>(),
                            area.at("quantity").get<std::string>(), area.at("points").get<std::size_t>(),
                            figure_of(area, "em"), figure_of(area, "emin"), figure_of(area, "u0"),
                            known(number_of(area, "target_lx")), known(number_of(area, "target_uniformity")),
                            verdict_of(area, "verdict"), verdict_of(area, "em_verdict"), verdict_of(area, "u0_verdict"),
                            area.contains("above_floor") ? known(number_of(area, "above_floor")) : std::nullopt});
  }
  return design;
}

Design read_design(const fs::path& folder) {
  std::error_code unknown;
  const bool is_scene = !fs::exists(folder / "summary.json", unknown) && fs::exists(folder / "scene.json", unknown);
  const fs::path file = folder / (is_scene ? "scene.json" : "summary.json");
  std::ifstream in(file);
  if (!in) refuse_design(file, "the file does not exist; a complete run writes it");
  const nlohmann::json summary = nlohmann::json::parse(in, nullptr, false);
  if (!summary.is_object()) refuse_design(file, "it is not a JSON object");
  if (!summary.contains("areas") || summary["areas"].empty())
    throw InputError("The result in " + in_quotes(folder.string()) +
                     " has no calculation areas (allowed: results with at least one). Run it again with --plane, "
                     "--area or --area-on, or with areas in its room; or compare without --designs.");
  try {
    return design_of(summary);
  } catch (const nlohmann::json::exception& fault) {
    refuse_design(file, fault.what());
  }
}

Figure difference(const Figure& a, const Figure& b) {
  return {b.value - a.value, std::hypot(a.standard_error, b.standard_error)};
}

}  // namespace

DesignComparison compare_designs(const fs::path& a, const fs::path& b) {
  Design design_a = read_design(a);
  Design design_b = read_design(b);
  if (design_a.unit != design_b.unit)
    throw InputError("The powers in " + in_quotes(a.string()) + " are in " + design_a.unit + ", those in " +
                     in_quotes(b.string()) + " in " + design_b.unit +
                     " (allowed: the same unit). Give --unit for one of the runs.");
  DesignComparison designs;
  designs.a = a.string();
  designs.b = b.string();
  designs.unit = design_a.unit;
  designs.total_a = design_a.total;
  designs.total_b = design_b.total;
  for (DesignArea& area : design_a.areas) designs.areas.push_back({std::move(area), std::nullopt, {}, {}});
  for (DesignArea& area : design_b.areas) {
    const auto same = std::find_if(designs.areas.begin(), designs.areas.end(),
                                   [&area](const DesignAreas& other) { return other.a && other.a->name == area.name; });
    if (same == designs.areas.end()) {
      designs.areas.push_back({std::nullopt, std::move(area), {}, {}});
      continue;
    }
    same->mean_difference = difference(same->a->mean, area.mean);
    same->uniformity_difference = difference(same->a->uniformity, area.uniformity);
    same->b = std::move(area);
  }
  return designs;
}

}  // namespace lichtmc
