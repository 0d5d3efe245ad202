// Files that a glTF file names: buffers and images beside it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <tiny_gltf.h>
#include <nlohmann/json_fwd.hpp>

#include "base/contained_path.hpp"
#include "gltf/document.hpp"

namespace lichtmc {

// The file that a URI names: its percent-encoding is decoded. Faults are those of path_within(), and a URI with a
// scheme ("http:", "file:"). Of a document in memory every file is a fault.
ContainedPath locate_uri(const Document& document, const std::string& uri);

// The file of a name that is not encoded, as people write it into custom properties; the same faults.
ContainedPath locate_name(const Document& document, const std::string& name);

// The buffers of files, read before parsing, so that the parser opens no file itself.
class ExternalFiles {
 public:
  // Reads the buffer files of `json`, of each the bytes that it declares, and gives them and the image files names
  // under which the parser finds them in this object. The URIs of the images go to Document::image_uris; their files
  // are read later, if they are needed. Returns whether `json` was changed. Throws InputError naming the buffer and its
  // file.
  bool take(nlohmann::json& json, Document& document);

  // Makes the parser use this object in place of the disk. The object must live until the parser ends.
  void serve(tinygltf::TinyGLTF& parser);

 private:
  bool take_buffers(nlohmann::json& json, const Document& document);
  bool take_images(nlohmann::json& json, Document& document);

  std::map<std::string, std::vector<unsigned char>> content_;  // by the name that the parser sees
};

}  // namespace lichtmc
