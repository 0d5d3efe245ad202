// Files that a room names: only regular files beneath its own folder are opened.
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/stat.h>

#include "base/contained_path.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

// The positions of the triangle of triangle_document(), as a file.
std::string positions() {
  const float p[] = {0, 0, 0, 0, 0, 1, 1, 0, 0};
  return std::string(reinterpret_cast<const char*>(p), sizeof p);
}

json with_buffer(const std::string& uri) {
  json document = triangle_document();
  const auto view =
      document["accessors"][document["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()]
              ["bufferView"]
                  .get<std::size_t>();
  document["buffers"][document["bufferViews"][view]["buffer"].get<std::size_t>()]["uri"] = uri;
  return document;
}

std::string message_of(const fs::path& folder, const json& document, const ReadOptions& options = {}) {
  std::ofstream(folder / "room.gltf") << document.dump();
  try {
    read_gltf(folder / "room.gltf", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("names of files are confined to a folder") {
  const auto fault = [](const char* name) { return path_within("folder", name, false).fault; };
  CHECK(fault("a.bin").empty());
  CHECK(fault("sub/a.bin").empty());
  CHECK(fault("sub/../a.bin").empty());
  CHECK(fault("a..b").empty());
  CHECK(fault("../a.bin") == "it leads out of the folder");
  CHECK(fault("sub/../../a.bin") == "it leads out of the folder");
  CHECK(fault("..") == "it leads out of the folder");
  CHECK(fault("/etc/passwd") == "it is an absolute path");
  CHECK(fault("C:\\a.bin") == "it is an absolute path");
  CHECK(fault("c:a.bin") == "it is an absolute path");
  CHECK(fault("\\\\server\\a.bin") == "it is an absolute path");
  CHECK(fault("") == "the name is empty");
  CHECK(path_within("folder", std::string("a\0b", 3), false).fault == "the name has a NUL character");
  CHECK(path_within("folder", "../a.bin", true).fault == "it leads out of the folder");
  CHECK(path_within("", "a.bin", false).path == fs::path("./a.bin"));
}

TEST_CASE("buffers are read from files beneath the folder, by their decoded names") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "sub folder");
  std::ofstream(folder.path() / "sub folder" / "ä%.bin", std::ios::binary) << positions() << "more bytes";
  CHECK(message_of(folder.path(), with_buffer("sub%20folder/%C3%A4%25.bin")).empty());
  CHECK(message_of(folder.path(), with_buffer("sub folder/ä%.bin")).empty());  // not encoded: read as it is
}

TEST_CASE("buffers elsewhere are refused with the reason and the way out") {
  const TemporaryFolder folder;
  const TemporaryFolder elsewhere;
  std::ofstream(elsewhere.path() / "a.bin", std::ios::binary) << positions();
  const auto says = [&](const std::string& uri, const std::string& reason) {
    INFO(uri);
    CHECK_THAT(message_of(folder.path(), with_buffer(uri)), ContainsSubstring(reason) && ContainsSubstring("buffer 0"));
  };
  const std::string name = elsewhere.path().filename().string() + "/a.bin";
  says("../" + name, "leads out of the folder");
  says("%2E%2E/" + name, "leads out of the folder");
  says("sub/../../" + name, "leads out of the folder");
  says((elsewhere.path() / "a.bin").string(), "absolute path");
  says("%2Fetc%2Fpasswd", "absolute path");
  says("file://" + (elsewhere.path() / "a.bin").string(), "scheme 'file:'");
  says("http://localhost/a.bin", "scheme 'http:'");
  says("C:/a.bin", "absolute path");
  says("none.bin", "No such file");
  says(".", "it is a folder");
  says("a%00b", "NUL");

  REQUIRE(::mkfifo((folder.path() / "pipe").c_str(), 0600) == 0);
  says("pipe", "it is a pipe");
  fs::create_symlink("/dev/zero", folder.path() / "zero");
  says("zero", "symbolic link");
  std::ofstream(folder.path() / "short.bin") << "short";
  says("short.bin", "has 5 bytes (allowed: at least its byteLength, 36)");
}

TEST_CASE("symbolic links out of the folder are followed on request only") {
  const TemporaryFolder folder;
  const TemporaryFolder elsewhere;
  std::ofstream(elsewhere.path() / "a.bin", std::ios::binary) << positions();
  fs::create_symlink(elsewhere.path() / "a.bin", folder.path() / "link.bin");
  fs::create_directory_symlink(elsewhere.path(), folder.path() / "sub");
  ReadOptions follow;
  follow.follow_links = true;
  for (const char* uri : {"link.bin", "sub/a.bin"}) {
    INFO(uri);
    CHECK_THAT(message_of(folder.path(), with_buffer(uri)), ContainsSubstring("--follow-links"));
    CHECK(message_of(folder.path(), with_buffer(uri), follow).empty());
  }
  CHECK_THAT(message_of(folder.path(), with_buffer("../x"), follow), ContainsSubstring("leads out"));
  // A link that stays in the folder needs no option; nor does a folder that is itself reached by a link.
  std::ofstream(folder.path() / "own.bin", std::ios::binary) << positions();
  fs::create_symlink("own.bin", folder.path() / "inner.bin");
  CHECK(message_of(folder.path(), with_buffer("inner.bin")).empty());
  fs::create_directory_symlink(folder.path(), elsewhere.path() / "door");
  CHECK(message_of(elsewhere.path() / "door", with_buffer("own.bin")).empty());
}

TEST_CASE("lengths that no file and no memory can have are refused before reading") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a.bin", std::ios::binary) << positions();
  json document = with_buffer("a.bin");
  document["buffers"][0]["byteLength"] = std::uint64_t{1} << 60;
  CHECK_THAT(message_of(folder.path(), document), ContainsSubstring("more than the memory"));
}

TEST_CASE("images are opened only if a surface needs them, and only beneath the folder") {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["images"] = {{{"uri", "../secret.png"}}};
  document["textures"] = {{{"source", 0}}};
  document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      add_accessor(document, std::vector<float>{0, 0, 0, 1, 1, 0}, "VEC2", 5126, 2);
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  CHECK(message_of(folder.path(), document).empty());  // the material has its reflectance
  document["materials"][0].erase("extras");
  CHECK_THAT(message_of(folder.path(), document),
             ContainsSubstring("leads out of the folder") && ContainsSubstring("--reflectance"));
  REQUIRE(::mkfifo((folder.path() / "pipe.png").c_str(), 0600) == 0);
  document["images"][0]["uri"] = "pipe.png";
  CHECK_THAT(message_of(folder.path(), document), ContainsSubstring("it is a pipe"));
}

TEST_CASE("a room file that is no regular file is refused") {
  const TemporaryFolder folder;
  REQUIRE(::mkfifo((folder.path() / "room.glb").c_str(), 0600) == 0);
  const auto message = [](const fs::path& file) -> std::string {
    try {
      read_gltf(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(message(folder.path() / "room.glb"), ContainsSubstring("it is a pipe"));
  CHECK_THAT(message(folder.path()), ContainsSubstring("it is a folder"));
  CHECK_THAT(message("/dev/zero"), ContainsSubstring("it is a device"));
  const fs::path large = folder.path() / "large.glb";
  std::ofstream(large) << "glTF";
  fs::resize_file(large, std::uintmax_t{1} << 42);
  CHECK_THAT(message(large), ContainsSubstring("4398046511104 bytes"));
}

namespace {

std::string refusal_of_bytes(const json& document) {
  try {
    parse_gltf(document.dump(), "bytes");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a room is read from the content of a file, as from the file") {
  const TemporaryFolder folder;
  for (const char* name : {"room.glb", "room.gltf"}) {
    INFO(name);
    const Room room = read_document(triangle_document());
    write_gltf(room, folder.path() / name);
    std::ifstream in(folder.path() / name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const Room from_file = read_gltf(folder.path() / name);
    ReadOptions options;
    options.scale = 0.01;
    const Room parsed = parse_gltf(bytes, "bytes");
    CHECK(parsed.source == "bytes");
    REQUIRE(parsed.surfaces.size() == from_file.surfaces.size());
    CHECK(parsed.surfaces[0].positions == from_file.surfaces[0].positions);
    CHECK(parsed.surfaces[0].reflectance == from_file.surfaces[0].reflectance);
    CHECK(parsed.emitters.size() == from_file.emitters.size());
    CHECK(parse_gltf(bytes, "bytes", options).surfaces[0].positions != parsed.surfaces[0].positions);
    CHECK_THROWS_WITH(parse_gltf(bytes.substr(0, bytes.size() / 2), "half"), ContainsSubstring("half: "));
  }
  CHECK_THROWS_WITH(parse_gltf("", "nothing"), ContainsSubstring("nothing: there are 0 bytes"));
  CHECK_THROWS_AS(parse_gltf("a letter", "bytes"), InputError);
}

// A file of this name in the working folder must not be read either.
TEST_CASE("bytes in memory name no files") {
  const auto refused = ContainsSubstring("which have no folder (allowed: embedded data");
  CHECK_THAT(refusal_of_bytes(with_buffer("a.bin")), refused && ContainsSubstring("buffer 0"));
  CHECK_THAT(refusal_of_bytes(with_buffer("file:///etc/passwd")), refused);
  json textured = triangle_document();
  textured["images"] = {{{"uri", "paint.png"}}};
  textured["textures"] = {{{"source", 0}}};
  textured["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      add_accessor(textured, std::vector<float>{0, 0, 0, 1, 1, 0}, "VEC2", 5126, 2);
  textured["materials"][0]["extras"].erase("reflectance");
  textured["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  CHECK_THAT(refusal_of_bytes(textured), refused && ContainsSubstring("paint.png"));
  json with_luminaire = triangle_document();
  with_luminaire["nodes"][1]["extras"] = {{"ies", "lamp.ies"}};
  CHECK_THAT(refusal_of_bytes(with_luminaire), refused && ContainsSubstring("lamp.ies"));
}
