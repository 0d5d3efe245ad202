// The parts of emitters on disk: emitter_parts.h5 in the folder of a run, from which scenes are made without the room.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lichtmc/area.hpp"
#include "lichtmc/dimmed_scene.hpp"
#include "lichtmc/emitter_parts.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/units.hpp"

namespace lichtmc {

struct KeptParts {
  std::string room;  // Room::source
  Quantity quantity = Quantity::photometric;
  EmitterParts parts;
  std::vector<Receiver> receivers;
  std::vector<Area> areas;
  // Upright strips where the room's surfaces cross the plane of each level area: what plans show of the room.
  Room section;
};

// The parts of a result, as read_emitter_parts() reads them after the run was written. result.parts must be set.
KeptParts kept_parts(const Room& room, const Result& result);

// Reads emitter_parts.h5 from the folder of a run. Throws InputError if there is none (then the run had no
// --per-emitter) or if it is damaged.
KeptParts read_emitter_parts(const std::filesystem::path& folder);

// The factor of emitters whose name is this, or matches this pattern with "*", "?" and "[…]".
struct DimmedEmitter {
  std::string name;
  double factor = 1.0;
};

// The factor of each part: 1 where nothing else is given. Throws InputError if a name means no part (the message lists
// the names), or if two entries mean the same part.
std::vector<double> factors_of(const EmitterParts& parts, const std::vector<DimmedEmitter>& dimmed);

// A scene as JSON: factors and powers of the parts, figures of the areas.
std::string scene_json(const KeptParts& kept, const DimmedScene& scene);

// Writes scene.json, receivers.csv and, with areas, areas.csv and areas/NAME.csv, .svg and .dxf into a folder, as a run
// does. Throws InputError if the folder holds the results of a run, RuntimeError if a file cannot be written.
void write_scene(const KeptParts& kept, const DimmedScene& scene, const std::filesystem::path& folder);

}  // namespace lichtmc
