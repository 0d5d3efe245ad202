#include "lichtmc/lit_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "base/png.hpp"
#include "gltf/builder.hpp"
#include "room/bounds.hpp"
#include "room/emitter_place.hpp"
#include "room/nearest_tile.hpp"

namespace lichtmc {

namespace {

using Json = GltfBuilder::Json;

constexpr std::uint32_t max_pixels = 4096;  // of a texture's side: every WebGL device supports it
constexpr double unlit_opacity = 0.06;      // opacity of triangles without light on either side
constexpr int nearest = 9728;               // texture filters: a tile has one uniform colour;
constexpr int mipmaps = 9987;               // from a distance, a pixel shows the mean of the tiles behind it
constexpr int clamp_to_edge = 33071;
constexpr int lines = 1;

// False colours of a tile map's texture. If the map has more cells than the texture has pixels, a pixel shows the
// area-weighted mean irradiance of its cells.
std::vector<std::uint8_t> pixels_of(const Result& result, const TileMap& map, const ColourScale& scale,
                                    std::uint32_t columns, std::uint32_t rows) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(std::size_t{3} * columns * rows);
  const std::vector<std::uint32_t> tiles = nearest_tiles(map);
  const auto begin = [](std::uint32_t k, std::uint32_t pixels_there, std::uint32_t cells) {
    return static_cast<std::uint32_t>(std::uint64_t{k} * cells / pixels_there);
  };
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      double power = 0.0;
      double area = 0.0;
      for (std::uint32_t row = begin(y, rows, map.rows); row < begin(y + 1, rows, map.rows); ++row) {
        for (std::uint32_t column = begin(x, columns, map.columns); column < begin(x + 1, columns, map.columns);
             ++column) {
          const std::uint32_t tile = tiles[std::size_t{row} * map.columns + column];
          if (tile == no_tile) continue;
          power += result.tiles[tile].irradiance * result.tiling.tiles[tile].area_m2;
          area += result.tiling.tiles[tile].area_m2;
        }
      }
      const Colour colour = colour_of(scale, area > 0.0 ? power / area : 0.0);
      pixels.insert(pixels.end(), colour.begin(), colour.end());
    }
  }
  return pixels;
}

// Triangles with their texture coordinates on the tile map; shared corners are stored once.
class Mesh {
 public:
  Mesh(const Surface& surface, const std::vector<std::array<glm::dvec2, 3>>& cells, const TileMap& map)
      : surface_(&surface), cells_(&cells), size_(map.columns, map.rows) {}

  void add(std::size_t n, bool reversed) {
    const glm::uvec3 corner = surface_->triangles[n];
    std::array<std::uint32_t, 3> index{};
    for (int k = 0; k < 3; ++k)
      index[static_cast<std::size_t>(k)] = vertex(corner[k], (*cells_)[n][static_cast<std::size_t>(k)]);
    if (reversed) std::swap(index[1], index[2]);
    indices_.insert(indices_.end(), index.begin(), index.end());
  }
  bool empty() const { return indices_.empty(); }

  Json primitive(GltfBuilder& document, std::size_t material) const {
    const std::size_t position = document.add_positions(positions_);
    const std::size_t uv = document.add_vectors(uvs_);
    const std::size_t indices = document.add_indices(indices_);
    return {{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}, {"indices", indices}, {"material", material}};
  }

 private:
  std::uint32_t vertex(std::uint32_t position, const glm::dvec2& cell) {
    const std::array<float, 2> uv{static_cast<float>(cell.x / size_.x), static_cast<float>(cell.y / size_.y)};
    const auto [entry, inserted] =
        vertices_.try_emplace({position, uv[0], uv[1]}, static_cast<std::uint32_t>(positions_.size()));
    if (inserted) {
      positions_.push_back(surface_->positions[position]);
      uvs_.push_back(uv);
    }
    return entry->second;
  }

  const Surface* surface_;
  const std::vector<std::array<glm::dvec2, 3>>* cells_;
  glm::dvec2 size_;
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> vertices_;  // by position and texture coordinates
  std::vector<glm::dvec3> positions_;                                          // m, world
  std::vector<std::array<float, 2>> uvs_;
  std::vector<std::uint32_t> indices_;
};

class LitRoom {
 public:
  LitRoom(const Room& room, const Result& result, const LitSides& lit, const ColourScale& scale)
      : room_(&room), result_(&result), lit_(&lit), scale_(&scale), document_(file_offset(bounds_of(room))) {
    document_.use_extension("KHR_materials_unlit");
    document_.json["scenes"][0]["extras"]["lichtmc"] = {{"room", room.source},
                                                        {"quantity", std::string(irradiance_word(room.quantity))},
                                                        {"unit", std::string(irradiance_unit(room.quantity))},
                                                        {"scale",
                                                         {{"low", scale.low},
                                                          {"high", scale.high},
                                                          {"logarithmic", scale.logarithmic},
                                                          {"colours", std::string(to_string(scale.colours))}}}};
    document_.json["samplers"] = Json::array(
        {{{"magFilter", nearest}, {"minFilter", mipmaps}, {"wrapS", clamp_to_edge}, {"wrapT", clamp_to_edge}}});
    for (std::size_t m = 0; m < result.tiling.maps.size(); ++m) {
      if (result.tiling.maps[m].side == Side::front) add_surface(m);
    }
    for (const Emitter& emitter : room.emitters) add_emitter(emitter);
  }

  GltfBuilder& document() { return document_; }

 private:
  void add_surface(std::size_t m);
  void add_emitter(const Emitter& emitter);
  std::size_t add_material(std::size_t m, bool double_sided);
  std::size_t add_texture(std::size_t m);
  std::size_t unlit_material();

  const Room* room_;
  const Result* result_;
  const LitSides* lit_;
  const ColourScale* scale_;
  GltfBuilder document_;
  std::map<std::size_t, std::size_t> textures_;  // by tile map
  std::map<std::size_t, Json> extras_;           // of the materials, by tile map
  std::optional<std::size_t> unlit_material_;
};

std::size_t LitRoom::add_texture(std::size_t m) {
  const auto [entry, inserted] = textures_.try_emplace(m, 0);
  if (!inserted) return entry->second;
  const TileMap& map = result_->tiling.maps[m];
  const std::uint32_t columns = std::min(map.columns, max_pixels);
  const std::uint32_t rows = std::min(map.rows, max_pixels);
  const std::size_t image =
      document_.add_png(map.name, png_file(columns, rows, 3, pixels_of(*result_, map, *scale_, columns, rows)));
  Json& textures = document_.json["textures"];
  textures.push_back({{"source", image}, {"sampler", 0}});
  entry->second = textures.size() - 1;

  std::vector<float> irradiance;
  std::vector<float> error;
  for (const std::uint32_t tile : map.tile_of_cell) {
    const bool has_tile = tile != no_tile;
    irradiance.push_back(has_tile ? static_cast<float>(result_->tiles[tile].irradiance)
                                  : std::numeric_limits<float>::quiet_NaN());
    error.push_back(has_tile ? static_cast<float>(result_->tiles[tile].standard_error)
                             : std::numeric_limits<float>::quiet_NaN());
  }
  const SurfaceResult& surface = result_->surfaces[m];
  extras_[m] = {{"surface", map.name},
                {"side", map.side == Side::front ? "front" : "back"},
                {"unit", std::string(irradiance_unit(result_->quantity))},
                {"columns", map.columns},
                {"rows", map.rows},
                {"irradiance", document_.add_view(irradiance.data(), irradiance.size() * sizeof(float))},
                {"standard_error", document_.add_view(error.data(), error.size() * sizeof(float))},
                {"mean", surface.mean_irradiance},
                {"lowest", surface.min_irradiance},
                {"highest", surface.max_irradiance},
                {"area", surface.area_m2},
                {"reflectance", surface.reflectance}};
  return entry->second;
}

std::size_t LitRoom::add_material(std::size_t m, bool double_sided) {
  const std::size_t texture = add_texture(m);
  Json& materials = document_.json["materials"];
  materials.push_back({{"name", result_->tiling.maps[m].name},
                       {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0.0}}},
                       {"doubleSided", double_sided},
                       {"extensions", {{"KHR_materials_unlit", Json::object()}}},
                       {"extras", {{"lichtmc", extras_[m]}}}});
  return materials.size() - 1;
}

std::size_t LitRoom::unlit_material() {
  if (unlit_material_) return *unlit_material_;
  Json& materials = document_.json["materials"];
  materials.push_back(
      {{"name", "no light"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, unlit_opacity}}, {"metallicFactor", 0.0}}},
       {"alphaMode", "BLEND"},
       {"doubleSided", true},
       {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
  unlit_material_ = materials.size() - 1;
  return *unlit_material_;
}

void LitRoom::add_surface(std::size_t m) {
  const TileMap& map = result_->tiling.maps[m];
  const Surface& surface = room_->surfaces[map.surface];
  const auto& cells = result_->tiling.cells[map.surface];
  Mesh front(surface, cells, map), back(surface, cells, map), either(surface, cells, map), dark(surface, cells, map);
  const bool map_per_side = surface.sides == Sides::both;
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    const SideLight side = (*lit_)[map.surface][n];
    if (!side.front && !side.back) {
      dark.add(n, false);
    } else if (side.front && side.back && !map_per_side) {
      either.add(n, false);
    } else {
      if (side.front) front.add(n, false);
      if (side.back) back.add(n, true);
    }
  }
  Json primitives = Json::array();
  if (!front.empty()) primitives.push_back(front.primitive(document_, add_material(m, false)));
  if (!back.empty()) primitives.push_back(back.primitive(document_, add_material(map_per_side ? m + 1 : m, false)));
  if (!either.empty()) primitives.push_back(either.primitive(document_, add_material(m, true)));
  if (!dark.empty()) primitives.push_back(dark.primitive(document_, unlit_material()));
  if (primitives.empty()) return;
  Json& meshes = document_.json["meshes"];
  meshes.push_back({{"name", surface.name}, {"primitives", std::move(primitives)}});
  document_.add_node({{"name", surface.name}, {"mesh", meshes.size() - 1}});
}

void LitRoom::add_emitter(const Emitter& emitter) {
  const glm::dvec3 place = place_of(*room_, emitter);
  Json node = document_.placed_node(emitter.name, place);
  node["extras"]["lichtmc"] = {{"kind", "emitter"},
                               {"name", emitter.name},
                               {"power", emitter.power},
                               {"unit", std::string(power_unit(room_->quantity))}};
  document_.add_node(std::move(node));
}

void add_paths(GltfBuilder& document, const std::vector<PhotonPath>& paths) {
  std::vector<glm::dvec3> points;
  std::vector<std::array<float, 3>> colours;
  for (const PhotonPath& path : paths) {
    for (std::size_t k = 1; k < path.points.size(); ++k) {
      const Colour colour = colour_of_flight(k);
      std::array<float, 3> light{};
      for (std::size_t c = 0; c < 3; ++c) light[c] = static_cast<float>(light_of_srgb(colour[c] / 255.0));
      for (const glm::dvec3& p : {path.points[k - 1].place, path.points[k].place}) {
        points.push_back(p);
        colours.push_back(light);
      }
    }
  }
  if (points.empty()) return;
  document.use_extension("KHR_materials_unlit");
  Json& materials = document.json["materials"];
  materials.push_back({{"name", "photon paths"},
                       {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
                       {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
  const std::size_t material = materials.size() - 1;
  const std::size_t position = document.add_positions(points);
  const std::size_t colour = document.add_vectors(colours);
  Json& meshes = document.json["meshes"];
  meshes.push_back(
      {{"name", "photon paths"},
       {"primitives",
        {{{"attributes", {{"POSITION", position}, {"COLOR_0", colour}}}, {"mode", lines}, {"material", material}}}}});
  document.add_node({{"name", "photon paths"},
                     {"mesh", meshes.size() - 1},
                     {"extras", {{"lichtmc", {{"kind", "paths"}, {"photons", paths.size()}}}}}});
}

}  // namespace

Colour colour_of_flight(std::size_t flight) {
  // The colours of the first flights, which nearly all photons make, differ most.
  constexpr double flights = 2.5;
  return colour_at(ColourMap::viridis, 1.0 - std::exp(-(static_cast<double>(flight) - 1.0) / flights));
}

std::string lit_room_glb(const Room& room, const Result& result, const LitSides& lit, const ColourScale& scale,
                         const std::vector<PhotonPath>& paths) {
  LitRoom lit_room(room, result, lit, scale);
  add_paths(lit_room.document(), paths);
  return lit_room.document().binary();
}

std::string paths_glb(const std::vector<PhotonPath>& paths) {
  Bounds bounds;
  for (const PhotonPath& path : paths) {
    for (const auto& point : path.points) bounds.add(point.place);
  }
  GltfBuilder document(paths.empty() ? glm::dvec3(0.0) : file_offset(bounds));
  add_paths(document, paths);
  return document.binary();
}

}  // namespace lichtmc
