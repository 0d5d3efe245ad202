#include <cmath>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>
#include <nlohmann/json.hpp>

#include "lichtmc/output.hpp"
#include "lichtmc/version.hpp"
#include "output/tile_image.hpp"
#include "support/catch.hpp"
#include "support/small_result.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
namespace fs = std::filesystem;

namespace {

std::vector<float> channel_of(const fs::path& file, const char* name) {
  Imf::InputFile image(file.c_str());
  const auto window = image.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x + 1);
  std::vector<float> values(width * static_cast<std::size_t>(window.max.y + 1), -1.0F);
  Imf::FrameBuffer frame;
  frame.insert(name,
               Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), sizeof(float) * width));
  image.setFrameBuffer(frame);
  image.readPixels(window.min.y, window.max.y);
  return values;
}

std::vector<std::string> names_for(const std::vector<std::string>& maps) {
  Tiling tiling;
  for (const std::string& name : maps) tiling.maps.emplace_back().name = name;
  return tile_image_names(tiling);
}

}  // namespace

TEST_CASE("a tile map's image contains irradiance, error and area of each cell") {
  const Folder folder;
  const Result result = make_result();
  write_results(make_room(), result, folder.path());
  const fs::path file = folder.path() / "tiles" / "a__b___c_d.exr";
  const auto irradiance = channel_of(file, "Y");
  const auto error = channel_of(file, "standard_error");
  const auto area = channel_of(file, "area");
  REQUIRE(irradiance.size() == 6);
  for (std::size_t cell = 0; cell < 5; ++cell) {
    CAPTURE(cell);
    CHECK(irradiance[cell] == static_cast<float>(result.tiles[cell].irradiance));
    CHECK((cell == 2 ? std::isnan(error[cell]) : error[cell] == 1e-3F));
    CHECK(area[cell] == 0.01F);
  }
  CHECK(irradiance[5] == 0.0F);
  CHECK(error[5] == 0.0F);
  CHECK(area[5] == 0.0F);
}

TEST_CASE("the header of a tile map's image describes it") {
  const Folder folder;
  write_results(make_room(), make_result(), folder.path());
  const Imf::InputFile image((folder.path() / "tiles" / "a__b___c_d.exr").c_str());
  const Imf::Header& header = image.header();
  const auto text = [&header](const char* name) { return header.typedAttribute<Imf::StringAttribute>(name).value(); };
  CHECK(header.dataWindow().max.x == 2);
  CHECK(header.dataWindow().max.y == 1);
  CHECK(header.compression() == Imf::ZIP_COMPRESSION);
  CHECK(header.lineOrder() == Imf::INCREASING_Y);
  for (const char* channel : {"Y", "standard_error", "area"}) {
    REQUIRE(header.channels().findChannel(channel) != nullptr);
    CHECK(header.channels().findChannel(channel)->type == Imf::FLOAT);
  }
  CHECK(text("unit") == "W/m^2");
  CHECK(text("surface") == "a \"b\", c/d");
  CHECK(text("side") == "front");
  CHECK(text("lichtmc_version") == version());
  CHECK(text("software") == "lichtmc " + std::string(version()));
  CHECK(Imf::comments(header).find("row 0") != std::string::npos);
  CHECK(header.typedAttribute<Imf::IntAttribute>("tile_count").value() == 5);
  CHECK(header.typedAttribute<Imf::V2dAttribute>("uv_min").value() == Imath::V2d(0.1, 0.25));
  CHECK(header.typedAttribute<Imf::V2dAttribute>("uv_max").value() == Imath::V2d(0.7, 1.0));
  const Imf::InputFile back((folder.path() / "tiles" / "lamp.back.exr").c_str());
  CHECK(back.header().typedAttribute<Imf::StringAttribute>("side").value() == "back");
}

TEST_CASE("file names of tile maps are safe, unique and as close to the name as possible") {
  using Names = std::vector<std::string>;
  CHECK(names_for({"floor", "Wand.2_a-b", "lamp.back"}) == Names{"floor.exr", "Wand.2_a-b.exr", "lamp.back.exr"});
  CHECK(names_for({"a/b", "a\\b", "a b"}) == Names{"a_b.exr", "a_b_2.exr", "a_b_3.exr"});
  CHECK(names_for({"Floor", "floor", "FLOOR"}) == Names{"Floor.exr", "floor_2.exr", "FLOOR_3.exr"});
  CHECK(names_for({"W\xC3\xA4nde", "\xE5\xBA\x8A"}) == Names{"W\xC3\xA4nde.exr", "\xE5\xBA\x8A.exr"});
  // Bytes that are not UTF-8: alone, truncated, and in the middle.
  CHECK(names_for({"a\xFF", "b\xC3", "c\xE5\xBA-"}) == Names{"a_.exr", "b_.exr", "c__-.exr"});
  for (const std::string& name : names_for({"", ".", "..", ".hidden", "../../etc/passwd", std::string("a\0b", 3)})) {
    CAPTURE(name);
    CHECK(name.front() != '.');
    CHECK(name.find_first_of(std::string("/\\\0", 3)) == std::string::npos);
    CHECK(name.size() > 4);
  }
}

TEST_CASE("long file names of tile maps are cut between characters and stay different") {
  std::string umlauts = "x";
  for (int k = 0; k < 200; ++k) umlauts += "\xC3\xA4";
  const auto names = names_for({umlauts, umlauts + "1", std::string(500, 'a'), std::string(501, 'a')});
  CHECK(std::set<std::string>(names.begin(), names.end()).size() == 4);
  for (const std::string& name : names) {
    // 255 bytes are allowed; the temporary file's name has some more.
    CHECK(name.size() <= 200);
    CHECK(name.size() >= 100);
    CHECK_NOTHROW(nlohmann::json(name).dump());  // throws if the text is not UTF-8
  }
}

TEST_CASE("ten thousand names with the same beginning get different file names in linear time") {
  std::vector<std::string> names;
  for (int k = 0; k < 10'000; ++k) names.push_back(std::string(130, 'a') + std::to_string(k));
  names.push_back(std::string(120, 'A') + "_7");
  const auto stems = file_stems(names);
  CHECK(std::set<std::string>(stems.begin(), stems.end()).size() == names.size());
  CHECK(stems[0] == std::string(120, 'a'));
  CHECK(stems[9999] == std::string(120, 'a') + "_10000");
  // Quadratic time, some minutes, would be the end of the time allowed for this test program.
  CHECK(file_stems({"a", "A", "a_2", "a"}) == std::vector<std::string>{"a", "A_2", "a_2_2", "a_3"});
}
