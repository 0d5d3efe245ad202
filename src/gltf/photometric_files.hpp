// Photometric files that a glTF file names or contains. Each is read once, however many nodes use it.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>

#include "gltf/document.hpp"
#include "lichtmc/photometry.hpp"

namespace lichtmc {

class PhotometricFiles {
 public:
  using Shared = std::shared_ptr<const Photometry>;

  explicit PhotometricFiles(const Document& document) : document_(&document) {}

  // The file of a light of EXT_lights_ies, by its number; `where`: what uses it. Throws InputError if there is no such
  // light, if it has not exactly one of a URI and a buffer view with its media type, or if its file cannot be read.
  // What a file has to be told about it goes to `ignored`, once.
  Shared of_light(double number, const PhotometryOptions& options, const std::string& where,
                  std::vector<Ignored>& ignored);

  // A file by its name relative to the folder of the glTF file; the same errors.
  Shared of_name(const std::string& name, const PhotometryOptions& options, const std::string& where,
                 std::vector<Ignored>& ignored);

 private:
  struct Content {
    std::string bytes;
    std::string source;                           // for messages of the reader
    std::optional<std::filesystem::path> folder;  // of a file that is not embedded
  };
  using Key = std::tuple<std::string, std::size_t, bool, bool>;  // place in the file, then the options

  // which: the light, `start`: the start of a message.
  Content content_of_light(const tinygltf::Value& light, const std::string& which, const std::string& start) const;
  Content content_of_view(const tinygltf::Value& light, const std::string& which, const std::string& start) const;
  Content content_of_file(const std::string& name, bool is_uri, const std::string& what) const;
  // own_name: in place of the file's name, unless it is empty.
  Shared parsed(const Content& content, const Key& key, const std::string& own_name, const PhotometryOptions& options);
  void tell(const Photometry& photometry, bool of_extension, std::vector<Ignored>& ignored);

  const Document* document_;
  std::map<Key, Shared> files_;
  std::set<std::string> told_;
};

}  // namespace lichtmc
