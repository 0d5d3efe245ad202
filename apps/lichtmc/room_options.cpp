#include "room_options.hpp"

#include <utility>

#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/overrides.hpp"
#include "light_spec.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

namespace {

// A material or surface and its new reflectance.
struct NewReflectance {
  std::string name;
  double value = 0.0;
};

NewReflectance parse_reflectance(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos) {
    throw InputError("The value '" + text +
                     "' of --reflectance cannot be used (allowed: NAME=R, with the name of a material or surface). "
                     "Give it in that form, for example Wall=0.6.");
  }
  return {text.substr(0, equals), parse_number(text.substr(equals + 1), "--reflectance " + text)};
}

UpAxis parse_up(const std::string& text) {
  if (text == "y" || text == "Y") return UpAxis::y;
  if (text == "z" || text == "Z") return UpAxis::z;
  throw InputError("The axis '" + text + "' of --up is not known (allowed: y or z). Give the axis that points up.");
}

}  // namespace

void add_room_argument(CLI::App& command, RoomOptions& options) {
  command.add_option("room", options.file, "glTF 2.0 file (.gltf or .glb), metres, Y up")
      ->required()
      ->type_name("ROOM");
}

void add_room_options(CLI::App& command, RoomOptions& options) {
  const std::string reading = "How to read the room";
  command.add_option("--light", options.lights, light_help)
      ->type_name("LIGHT")
      ->expected(1)
      ->take_all()
      ->group(reading);
  command
      .add_option("--reflectance", options.reflectances,
                  "Set the reflectance of a material or surface, 0 to 1 (name or pattern; repeatable)")
      ->type_name("NAME=R")
      ->expected(1)
      ->take_all()
      ->group(reading);
  command
      .add_option("--max-reflectance", options.max_reflectance,
                  "Lower every reflectance above this value to it, 0 to 1")
      ->type_name("R")
      ->group(reading);
  command
      .add_option("--maintenance-factor", options.maintenance_factor,
                  "Share of their new power that the emitters keep, above 0 and up to 1: the figures are maintained "
                  "values. Emitters with a factor of their own keep it [1]")
      ->type_name("F")
      ->group(reading);
  command
      .add_option("--scale", options.scale,
                  "Length of one unit of the file in metres: 0.01 for centimetres, 0.0254 for inches [1]")
      ->type_name("F")
      ->group(reading);
  command.add_option("--up", options.up, "Axis of the file that points up: y as in glTF, or z")
      ->type_name("y|z")
      ->capture_default_str()
      ->group(reading);
  command.add_option("--unit", options.unit, "Interpret the powers of the file in W or lm [as given in the file]")
      ->type_name("W|lm")
      ->group(reading);
  command
      .add_option("--uv-set", options.uv_set,
                  "Texture coordinates for the tiles, the n of TEXCOORD_n [1 if present, else 0]")
      ->type_name("N")
      ->group(reading);
  command
      .add_option("--without", options.without,
                  "Leave out nodes (with all below them), meshes, materials or surfaces of this name or pattern "
                  "(repeatable)")
      ->type_name("NAME")
      ->expected(1)
      ->take_all()
      ->group(reading);
  command
      .add_flag("--follow-links", options.follow_links,
                "Read buffers and images that are symbolic links to files outside the folder of the room")
      ->group(reading);
  command.add_option("--scene", options.scene, "Name of the scene to use [the file's default scene]")
      ->type_name("NAME")
      ->group(reading);
}

Room read_room(const RoomOptions& options) {
  std::vector<NewReflectance> reflectances;
  ReadOptions read;
  read.uv_set = options.uv_set;
  read.scene = options.scene;
  read.up = parse_up(options.up);
  read.without = options.without;
  read.follow_links = options.follow_links;
  if (options.scale) read.scale = parse_number(*options.scale, "--scale");
  if (options.unit) read.quantity = parse_unit(*options.unit, "--unit");
  for (const std::string& text : options.reflectances) {
    reflectances.push_back(parse_reflectance(text));
    read.numbered.push_back(reflectances.back().name);
  }
  Room room = read_gltf(options.file, read);
  if (options.unit) room.overrides.push_back("The powers of the file are interpreted in " + *options.unit + ".");
  for (const NewReflectance& change : reflectances) set_reflectance(room, change.name, change.value);
  if (options.max_reflectance) limit_reflectance(room, parse_number(*options.max_reflectance, "--max-reflectance"));
  add_lights(room, options.lights);
  if (options.maintenance_factor)
    set_maintenance_factor(room, parse_number(*options.maintenance_factor, "--maintenance-factor"));
  return room;
}

}  // namespace lichtmc::app
