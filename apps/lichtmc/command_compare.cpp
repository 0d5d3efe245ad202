// lichtmc compare: do two results agree within their standard errors?
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "lichtmc/compare.hpp"

namespace lichtmc::app {

namespace {

constexpr int exit_disagree = 1;

struct CompareOptions {
  std::string a;
  std::string b;
  bool json = false;
  bool designs = false;
  std::size_t worst = 5;
};

nlohmann::ordered_json json_of(const Comparison& comparison, std::size_t count) {
  nlohmann::ordered_json worst = nlohmann::ordered_json::array();
  for (const FigurePair* pair : worst_figures(comparison, count)) {
    worst.push_back({{"name", pair->name},
                     {"a", pair->a},
                     {"a_standard_error", pair->error_a},
                     {"b", pair->b},
                     {"b_standard_error", pair->error_b},
                     {"z", pair->z()}});
  }
  return {{"what", to_string(comparison.what)},
          {"agree", comparison.agree},
          {"compared", comparison.figures.size()},
          {"dark", comparison.dark},
          {"unknown", comparison.unknown},
          {"unmatched", comparison.unmatched},
          {"relative_difference", comparison.difference},
          {"relative_difference_standard_error", comparison.difference_error},
          {"chi_square", comparison.chi_square},
          {"expected_chi_square", comparison.expected_chi_square},
          {"chi_square_chance", comparison.chi_square_chance},
          {"largest_z", comparison.largest_z},
          {"largest_chance", comparison.largest_chance},
          {"worst", worst}};
}

nlohmann::ordered_json json_of(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const std::optional<double>& value) {
  return value ? json_of(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(Verdict verdict) {
  return verdict == Verdict::none ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(to_string(verdict));
}

nlohmann::ordered_json json_of(const std::optional<DesignArea>& area) {
  if (!area) return nullptr;
  return {{"quantity", area->quantity},
          {"points", area->points},
          {"em", json_of(area->mean.value)},
          {"em_se", json_of(area->mean.standard_error)},
          {"emin", json_of(area->minimum.value)},
          {"emin_se", json_of(area->minimum.standard_error)},
          {"u0", json_of(area->uniformity.value)},
          {"u0_se", json_of(area->uniformity.standard_error)},
          {"target_lx", json_of(area->target_mean)},
          {"target_uniformity", json_of(area->target_uniformity)},
          {"verdict", json_of(area->verdict)},
          {"em_verdict", json_of(area->mean_verdict)},
          {"u0_verdict", json_of(area->uniformity_verdict)},
          {"above_floor", json_of(area->above_floor_m)}};
}

// Null if it is unknown, or if emitters have different ones.
nlohmann::ordered_json maintenance_factor_of(const DesignTotals& total) {
  return total.least_maintenance_factor == total.greatest_maintenance_factor ? json_of(total.least_maintenance_factor)
                                                                             : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const DesignComparison& designs) {
  nlohmann::ordered_json areas = nlohmann::ordered_json::array();
  for (const DesignAreas& pair : designs.areas) {
    const DesignArea& one = pair.a ? *pair.a : *pair.b;
    areas.push_back({{"name", one.name},
                     {"role", one.role},
                     {"a", json_of(pair.a)},
                     {"b", json_of(pair.b)},
                     {"em_difference", json_of(pair.mean_difference.value)},
                     {"em_difference_se", json_of(pair.mean_difference.standard_error)},
                     {"u0_difference", json_of(pair.uniformity_difference.value)},
                     {"u0_difference_se", json_of(pair.uniformity_difference.standard_error)}});
  }
  return {{"a", designs.a},
          {"b", designs.b},
          {"unit", designs.unit == "lm" ? "lx" : "W/m^2"},
          {"areas", areas},
          {"power_unit", designs.unit},
          {"power", {{"a", json_of(designs.total_a.power)}, {"b", json_of(designs.total_b.power)}}},
          {"watts", {{"a", json_of(designs.total_a.watts)}, {"b", json_of(designs.total_b.watts)}}},
          {"maintenance_factor",
           {{"a", maintenance_factor_of(designs.total_a)}, {"b", maintenance_factor_of(designs.total_b)}}}};
}

void print_json(const nlohmann::ordered_json& json) {
  std::cout << json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

void print_designs(const CompareOptions& options) {
  const DesignComparison designs = compare_designs(options.a, options.b);
  if (options.json) {
    print_json(json_of(designs));
  } else {
    std::cout << designs_text(designs);
  }
}

void compare(const CompareOptions& options, int& status) {
  if (options.designs) {
    print_designs(options);
    return;
  }
  const std::vector<Comparison> comparisons = compare_results(options.a, options.b);
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Comparison& comparison : comparisons) {
    if (!comparison.agree) status = exit_disagree;
    if (options.json) {
      all.push_back(json_of(comparison, options.worst));
    } else {
      std::cout << comparison_text(comparison, options.worst);
    }
  }
  if (options.json) print_json(all);
}

}  // namespace

void add_compare_command(CLI::App& program, const Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("compare", "Compare two results: do they agree within their standard errors?");
  auto options = std::make_shared<CompareOptions>();
  command->add_option("A", options->a, "Folder with results")->required();
  command->add_option("B", options->b, "Folder with results of the same tiles or receivers")->required();
  CLI::Option* designs = command->add_flag(
      "--designs", options->designs,
      "Show the calculation areas of two designs side by side, with the differences; a difference is no failure");
  command->add_option("--worst", options->worst, "Number of values to list, those with the largest |z|")
      ->type_name("N")
      ->capture_default_str()
      ->excludes(designs);
  command->add_flag("--json", options->json, "Write the comparison as JSON");
  command->footer(
      "Every value that both results contain gives z = (B - A) / sqrt(se_A^2 + se_B^2). Tiles are compared with tiles\n"
      "and receivers with receivers. If one result has only tiles and the other only receivers, each receiver is\n"
      "compared with the tile at its point (x, y, z in tiles.csv). Use different seeds: with the same seed the errors\n"
      "are correlated.\n"
      "Exit status: 0 they agree, or --designs; 1 they do not; 2 they cannot be compared.\n\n"
      "Example:\n"
      "  lichtmc run room.glb --seed 1 -o one\n"
      "  lichtmc run room.glb --seed 2 --tiles backward -o two\n"
      "  lichtmc compare one two\n"
      "  lichtmc compare --designs today.out proposal.out");
  command->callback([options, &invocation] { compare(*options, *invocation.status); });
}

}  // namespace lichtmc::app
