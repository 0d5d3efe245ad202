#include "direct.hpp"

#include <cstddef>
#include <string>

#include "lichtmc/gltf.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/tiles.hpp"
#include "plain_tiles.hpp"
#include "run/tile_light.hpp"
#include "walk/scene.hpp"

namespace lichtmc::bench {

namespace {

Settings settings_of_target() {
  Settings settings;
  settings.direct = Direct::analytic;
  settings.target_error = 0.02;
  return settings;
}

}  // namespace

struct DirectStage::Parts {
  Parts()
      : room(read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb")),
        tiling(make_tiling(room, 0.26)),
        scene(room, tiling, Engine::embree),
        settings(settings_of_target()),
        light(room, *scene.tracer),
        faces(room, tiling, *scene.tracer) {}

  Room room;
  Tiling tiling;
  Scene scene;
  Settings settings;
  DirectLight light;
  TileFaces faces;
  std::size_t turn = 0;
};

DirectStage::DirectStage() : parts_(std::make_unique<Parts>()) {}
DirectStage::~DirectStage() = default;

double DirectStage::all() {
  const TileLight light(parts_->room, parts_->tiling, parts_->scene, parts_->settings, WalkDirection::forward);
  TraceCount count;
  for (std::size_t face = 0; face < light.faces().size(); ++face) light.mean(face, count);
  return static_cast<double>(light.faces().size());
}

double DirectStage::plain_eighth() {
  constexpr std::size_t parts = 8;
  double area = 0.0;
  double power = 0.0;
  for (const Surface& surface : parts_->room.surfaces) area += surface_area(surface);
  for (const Emitter& emitter : parts_->room.emitters) power += emitter.power;
  const PlainTiles plain(parts_->light, parts_->faces, *parts_->scene.tracer, Stream(1), PlainTiles::accuracy(0.02),
                         power / area);
  TraceCount count;
  std::size_t done = 0;
  const std::size_t turn = parts_->turn++;
  for (std::size_t face = 0; face < parts_->faces.size(); ++face) {
    // In no order: neighbours are alike, and faces alternate between fronts and backs.
    const std::uint32_t scattered = static_cast<std::uint32_t>(face) * 0x9E3779B9U >> 16;
    if ((scattered + turn) % parts != 0) continue;
    plain.mean(face, count);
    ++done;
  }
  return static_cast<double>(done);
}

}  // namespace lichtmc::bench
