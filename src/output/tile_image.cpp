#include "output/tile_image.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <set>

#include <ImathVec.h>
#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"

namespace lichtmc {

namespace {

// Collects what OpenEXR writes. It seeks back to fill in its table of offsets.
class ByteStream final : public Imf::OStream {
 public:
  ByteStream() : Imf::OStream("tile map") {}

  void write(const char c[], int n) override {
    const std::size_t end = position_ + static_cast<std::size_t>(n);
    if (bytes_.size() < end) bytes_.resize(end);
    std::copy(c, c + n, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ = end;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

struct Pixels {
  std::vector<float> irradiance, standard_error, area;
};

Pixels pixels_of(const Result& result, const TileMap& map) {
  const std::size_t cells = map.tile_of_cell.size();
  Pixels pixels{std::vector<float>(cells, 0.0F), std::vector<float>(cells, std::numeric_limits<float>::quiet_NaN()),
                std::vector<float>(cells, 0.0F)};
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::uint32_t tile = map.tile_of_cell[cell];
    if (tile == no_tile) continue;
    pixels.irradiance[cell] = static_cast<float>(result.tiles[tile].irradiance);
    pixels.standard_error[cell] = static_cast<float>(result.tiles[tile].standard_error);
    pixels.area[cell] = static_cast<float>(result.tiling.tiles[tile].area_m2);
  }
  return pixels;
}

Imf::Header header_of(const Result& result, std::size_t m) {
  const TileMap& map = result.tiling.maps[m];
  Imf::Header header(static_cast<int>(map.columns), static_cast<int>(map.rows));
  header.compression() = Imf::ZIP_COMPRESSION;
  const auto text = [&header](const char* name, std::string_view value) {
    header.insert(name, Imf::StringAttribute(std::string(value)));
  };
  text("unit", irradiance_unit(result.quantity));
  text("quantity", irradiance_word(result.quantity));
  text("surface", map.name);
  text("material", result.surfaces[m].material);
  text("side", map.side == Side::front ? "front" : "back");
  text("lichtmc_version", version());
  text("comments", "Y and standard_error in the unit named, area in m^2; row 0 at the smallest v; NaN: error unknown");
  header.insert("uv_min", Imf::V2fAttribute({static_cast<float>(map.uv_min.x), static_cast<float>(map.uv_min.y)}));
  header.insert("uv_max", Imf::V2fAttribute({static_cast<float>(map.uv_max.x), static_cast<float>(map.uv_max.y)}));
  header.insert("tile_edge_m", Imf::FloatAttribute(static_cast<float>(result.settings.tile_edge_m)));
  for (const char* channel : {"Y", "standard_error", "area"})
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  return header;
}

}  // namespace

std::string tile_image(const Result& result, std::size_t m) {
  const TileMap& map = result.tiling.maps[m];
  Pixels pixels = pixels_of(result, map);
  try {
    ByteStream stream;
    {
      Imf::OutputFile file(stream, header_of(result, m));
      Imf::FrameBuffer frame;
      const auto slice = [&](const char* name, std::vector<float>& channel) {
        frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(channel.data()), sizeof(float),
                                      sizeof(float) * map.columns));
      };
      slice("Y", pixels.irradiance);
      slice("standard_error", pixels.standard_error);
      slice("area", pixels.area);
      file.setFrameBuffer(frame);
      file.writePixels(static_cast<int>(map.rows));
    }
    return stream.take();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw RuntimeError("Cannot make the image of tile map '" + map.name + "' (" + error.what() +
                       "). Use larger tiles.");
  }
}

std::vector<std::string> tile_image_names(const Tiling& tiling) {
  constexpr std::size_t longest = 120;  // bytes; file systems allow 255 and the temporary name needs some
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const TileMap& map : tiling.maps) {
    std::string stem;
    for (const char c : map.name.substr(0, longest)) {
      const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.' ||
                         static_cast<unsigned char>(c) >= 0x80;
      stem += plain ? c : '_';
    }
    if (stem.empty() || stem.front() == '.') stem.insert(0, "_");
    const auto folded = [](std::string text) {
      std::transform(text.begin(), text.end(), text.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      return text;
    };
    std::string name = stem;
    for (int n = 2; !taken.insert(folded(name)).second; ++n) name = stem + "_" + std::to_string(n);
    names.push_back(name + ".exr");
  }
  return names;
}

}  // namespace lichtmc
