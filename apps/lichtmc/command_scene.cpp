// lichtmc scene: a run with some of its emitters dimmed, from the parts that it has kept.
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "lichtmc/dimmed_scene.hpp"
#include "lichtmc/emitter_parts_file.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/visible_text.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

namespace {

struct SceneOptions {
  std::string result;
  std::vector<std::string> dim;
  std::string output;
  bool json = false;
};

DimmedEmitter parse_dim(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(
        "The value '" + text +
        "' of --dim cannot be used (allowed: EMITTER=F, with the name of an emitter and a factor). Give it "
        "in that form, for example downlights=0.3 or pendant=30%.");
  return {text.substr(0, equals), parse_factor(text.substr(equals + 1), "--dim " + text)};
}

void print(const KeptParts& kept, const DimmedScene& scene) {
  const std::string unit(power_unit(kept.quantity));
  for (std::size_t p = 0; p < scene.factors.size(); ++p) {
    const EmitterParts::Part& part = kept.parts.parts[p];
    std::cout << visible_text(part.name) << ": " << four_digits(scene.factors[p] * part.power) << ' ' << unit;
    if (scene.factors[p] != 1.0) std::cout << " (" << four_digits(100.0 * scene.factors[p]) << " % of the run)";
    std::cout << '\n';
  }
  for (const AreaResult& area : scene.areas) std::cout << visible_text(area_line(area, kept.quantity)) << '\n';
  if (!scene.areas.empty()) return;
  std::cout << scene.receivers.size() << (scene.receivers.size() == 1 ? " receiver" : " receivers")
            << "; there is no calculation area. Give --output a folder for the values of the receivers.\n";
}

// A dimmer is set in percent: 50 is hardly fifty times the power.
void note_bright(const DimmedEmitter& one) {
  constexpr double bright = 2.0;
  if (one.factor <= bright) return;
  std::cerr << "Note: '" << visible_text(one.name) << "' has " << four_digits(one.factor)
            << " times its power in the run. For percent write " << four_digits(one.factor) << "%.\n";
}

void run(const SceneOptions& options) {
  const KeptParts kept = read_emitter_parts(options.result);
  std::vector<DimmedEmitter> dimmed;
  for (const std::string& text : options.dim) {
    dimmed.push_back(parse_dim(text));
    note_bright(dimmed.back());
  }
  const DimmedScene scene = dim(kept.parts, kept.receivers, kept.areas, factors_of(kept.parts, dimmed));
  if (!options.output.empty()) write_scene(kept, scene, options.output);
  if (options.json) {
    std::cout << scene_json(kept, scene);
  } else {
    print(kept, scene);
  }
  if (!options.output.empty())
    std::cerr << "Results are in " << visible_text(options.output) << ": receivers.csv, "
              << (scene.areas.empty() ? "" : "areas.csv, areas/*.csv, areas/*.svg, areas/*.dxf, ") << "scene.json.\n";
}

}  // namespace

void add_scene_command(CLI::App& program, const Invocation& /*invocation*/) {
  CLI::App* command = program.add_subcommand(
      "scene", "Dim emitters of a run that has kept their parts (--per-emitter): new figures without new photons");
  auto options = std::make_shared<SceneOptions>();
  command->add_option("result", options->result, "Folder of a run with --per-emitter")->required()->type_name("RESULT");
  command
      ->add_option(
          "--dim", options->dim,
          "Factor of the emitters of a name or pattern: 0 is off, 1 or 100% the power of the run (repeatable) [1]")
      ->type_name("EMITTER=F")
      ->expected(1)
      ->take_all();
  command->add_option("-o,--output", options->output, "Folder for the tables and plans of the scene [none]")
      ->type_name("DIR");
  command->add_flag("--json", options->json, "Print the scene as JSON");
  command->footer(
      "Light is linear: the illuminance is the sum of the parts of the emitters, and its error follows from the\n"
      "covariances of these parts. With all factors 1, value and error are those of the run.\n\n"
      "Examples:\n"
      "  lichtmc run office.glb --plane 0.75 --per-emitter --only receivers --target-error 1%\n"
      "  lichtmc scene office.out                                    the parts, and the areas with all lamps on\n"
      "  lichtmc scene office.out --dim downlights=0.3 --dim pendant=0 -o office_evening");
  command->callback([options] { run(*options); });
}

}  // namespace lichtmc::app
