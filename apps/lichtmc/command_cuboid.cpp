// lichtmc cuboid: writes a cuboid room as glTF.
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "lichtmc/cuboid.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/visible_text.hpp"
#include "light_spec.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

namespace {

struct CuboidOptions {
  std::vector<std::string> size;
  std::string reflectance = "0.5";
  std::optional<std::string> floor, ceiling, walls, x0, x1, z0, z1;
  std::vector<std::string> lights;
  std::string output;
};

CuboidReflectances reflectances(const CuboidOptions& options) {
  const auto value = [](const std::optional<std::string>& own, double otherwise, const char* option) {
    return own ? parse_number(*own, option) : otherwise;
  };
  const double all = parse_number(options.reflectance, "--reflectance");
  const double walls = value(options.walls, all, "--walls");
  return {value(options.floor, all, "--floor"),  value(options.ceiling, all, "--ceiling"),
          value(options.x0, walls, "--wall-x0"), value(options.x1, walls, "--wall-x1"),
          value(options.z0, walls, "--wall-z0"), value(options.z1, walls, "--wall-z1")};
}

void write_cuboid(const CuboidOptions& options) {
  const glm::dvec3 size{parse_number(options.size[0], "--size"), parse_number(options.size[1], "--size"),
                        parse_number(options.size[2], "--size")};
  Room room = make_cuboid(size, reflectances(options));
  add_lights(room, options.lights);
  if (!room.emitters.empty()) check_room(room);
  const std::filesystem::path folder = std::filesystem::path(options.output).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    throw InputError("The folder " + folder.string() + " of the file " + options.output +
                     " does not exist. Create it, or choose another file with --output.");
  }
  write_gltf(room, options.output);
  // What is to be said of photometric files: the room that is written has their light, and no more their texts.
  for (const Ignored& remark : room.ignored) {
    if (remark.effect == Effect::figures)
      std::cerr << "Warning: " << visible_text(remark.what + " " + remark.advice) << '\n';
  }
}

}  // namespace

void add_cuboid_command(CLI::App& program, const Invocation& /*invocation*/) {
  CLI::App* command = program.add_subcommand("cuboid", "Write an empty cuboid room as a glTF file");
  auto options = std::make_shared<CuboidOptions>();
  command->add_option("--size", options->size, "Edges along X, Y (height) and Z in metres, for example --size 5 2.6 4")
      ->expected(3)
      ->required()
      ->type_name("EDGE");
  command
      ->add_option("--reflectance", options->reflectance, "Reflectance of the surfaces without an option of their own")
      ->type_name("R")
      ->capture_default_str();
  command->add_option("--floor", options->floor, "Reflectance of the floor (y = 0)")->type_name("R");
  command->add_option("--ceiling", options->ceiling, "Reflectance of the ceiling")->type_name("R");
  command->add_option("--walls", options->walls, "Reflectance of the four walls")->type_name("R");
  command->add_option("--wall-x0", options->x0, "Reflectance of the wall x = 0")->type_name("R");
  command->add_option("--wall-x1", options->x1, "Reflectance of the opposite wall, at the largest X")->type_name("R");
  command->add_option("--wall-z0", options->z0, "Reflectance of the wall z = 0")->type_name("R");
  command->add_option("--wall-z1", options->z1, "Reflectance of the opposite wall, at the largest Z")->type_name("R");
  command->add_option("--light", options->lights, light_help)->type_name("LIGHT")->expected(1)->take_all();
  command->add_option("-o,--output", options->output, "File to write, .glb or .gltf")->type_name("FILE")->required();
  command->footer(std::string("One corner of the room is the origin; the room extends to +X, +Y (up) and +Z. A "
                              "reflectance is the reflected\n"
                              "fraction of the incident flux, 0 (black) to 1.\n\n") +
                  light_forms +
                  "\nExample:\n  lichtmc cuboid --size 5 2.6 4 --walls 0.6 --ceiling 0.8 --floor 0.3 --light "
                  "point:2.5,2.4,2:2000lm "
                  "-o room.glb\n"
                  "  lichtmc run room.glb");
  command->callback([options] { write_cuboid(*options); });
}

}  // namespace lichtmc::app
