#include "output/tile_image.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include <ImathVec.h>
#include <ImfFloatAttribute.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include "base/utf8.hpp"
#include "lichtmc/version.hpp"
#include "output/exr.hpp"

namespace lichtmc {

namespace {

struct Pixels {
  explicit Pixels(std::size_t cells) : irradiance(cells), standard_error(cells), area(cells), direct(cells) {}
  std::vector<float> irradiance, standard_error, area, direct;
};

Pixels pixels_of(const Result& result, const TileMap& map) {
  const std::size_t cells = map.tile_of_cell.size();
  Pixels pixels(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::uint32_t tile = map.tile_of_cell[cell];
    if (tile == no_tile) continue;
    pixels.irradiance[cell] = static_cast<float>(result.tiles[tile].irradiance);
    pixels.standard_error[cell] = static_cast<float>(result.tiles[tile].standard_error);
    pixels.area[cell] = static_cast<float>(result.tiling.tiles[tile].area_m2);
    pixels.direct[cell] = static_cast<float>(result.tiles[tile].direct);
  }
  return pixels;
}

Imf::Header header_of(const Result& result, std::size_t m) {
  const TileMap& map = result.tiling.maps[m];
  Imf::Header header(static_cast<int>(map.columns), static_cast<int>(map.rows));
  const auto text = [&header](const char* name, std::string_view value) {
    header.insert(name, Imf::StringAttribute(std::string(value)));
  };
  text("unit", irradiance_unit(result.quantity));
  text("quantity", irradiance_word(result.quantity));
  text("surface", map.name);
  text("material", result.surfaces[m].material);
  text("side", map.side == Side::front ? "front" : "back");
  text("lichtmc_version", version());
  text("software", "lichtmc " + std::string(version()));
  text("comments",
       "Y and standard_error in the unit named, area in m^2; the top line is row 0, at the smallest v; cells without "
       "surface have the area 0, and 0 for the others");
  header.insert("uv_min", Imf::V2dAttribute({map.uv_min.x, map.uv_min.y}));
  header.insert("uv_max", Imf::V2dAttribute({map.uv_max.x, map.uv_max.y}));
  header.insert("tile_count", Imf::IntAttribute(static_cast<int>(result.surfaces[m].tiles)));
  header.insert("tile_edge_m", Imf::FloatAttribute(static_cast<float>(result.settings.tile_edge_m)));
  return header;
}

std::string safe_stem(std::string_view name) {
  constexpr std::size_t max_bytes = 120;  // file systems allow 255
  std::string stem;
  while (!name.empty()) {
    const Character c = first_character(name);
    const bool ascii = c.code < 0x80 &&
                       (std::isalnum(static_cast<int>(c.code)) != 0 || c.code == '_' || c.code == '-' || c.code == '.');
    const bool plain = c.bytes > 1 ? !acts_on_terminal(c.code) : c.bytes == 1 && ascii;
    const std::string_view piece = plain ? name.substr(0, c.bytes) : std::string_view("_");
    if (stem.size() + piece.size() > max_bytes) break;
    stem += piece;
    name.remove_prefix(std::max<std::size_t>(c.bytes, 1));
  }
  if (stem.empty() || stem.front() == '.') stem.insert(0, "_");
  return stem;
}

}  // namespace

std::string tile_image(const Result& result, std::size_t m) {
  const TileMap& map = result.tiling.maps[m];
  Pixels pixels = pixels_of(result, map);
  std::vector<ExrChannel> channels;
  channels.push_back({"Y", std::move(pixels.irradiance)});
  channels.push_back({"standard_error", std::move(pixels.standard_error)});
  channels.push_back({"area", std::move(pixels.area)});
  if (direct_is_apart(result)) channels.push_back({"direct", std::move(pixels.direct)});
  return exr_file(header_of(result, m), std::move(channels), "the image of tile map '" + map.name + "'");
}

std::vector<std::string> file_stems(const std::vector<std::string>& names) {
  std::vector<std::string> stems;
  std::unordered_map<std::string, int> next;  // by a name that is taken: the number to try when it comes again
  const auto folded = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  for (const std::string& name : names) {
    const std::string stem = safe_stem(name);
    std::string unique = stem;
    // Numbers below the one remembered are taken, so that many names with the same beginning take linear time.
    if (const auto found = next.find(folded(stem)); found != next.end()) {
      int& n = found->second;
      do unique = stem + "_" + std::to_string(n++);
      while (next.contains(folded(unique)));
    }
    next.emplace(folded(unique), 2);
    stems.push_back(std::move(unique));
  }
  return stems;
}

std::vector<std::string> tile_image_names(const Tiling& tiling) {
  std::vector<std::string> names;
  for (const TileMap& map : tiling.maps) names.push_back(map.name);
  names = file_stems(names);
  for (std::string& name : names) name += ".exr";
  return names;
}

}  // namespace lichtmc
