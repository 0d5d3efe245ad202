// A glTF file parsed by tinygltf, with the checks that tinygltf does not make.
#pragma once

#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace lichtmc {

struct Document {
  std::string file;  // the path as the user gave it, for messages
  tinygltf::Model model;
  std::vector<std::vector<unsigned char>>
      images;                         // the files of Model::images, not decoded; empty if a file is missing
  std::vector<std::string> warnings;  // of the parser, one line each
};

// "node 'lamp'"; "node 3" without a name.
std::string label(const char* kind, const std::string& name, std::size_t index);

// Throws InputError with the message "FILE: what is wrong. What to do."
[[noreturn]] void refuse(const Document& document, const std::string& what_and_remedy);

// Returns an index of the file if it is below `count`; throws InputError otherwise.
std::size_t checked_index(const Document& document, long long index, std::size_t count, const std::string& what);

// A number in extras or an extension; `otherwise` if there is no entry of that name. Throws InputError if the entry is
// not a number. `where`: what it belongs to, for messages.
double number_in(const Document& document, const tinygltf::Value& object, const char* name, double otherwise,
                 const std::string& where);

}  // namespace lichtmc
