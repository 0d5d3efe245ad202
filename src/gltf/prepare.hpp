// What tinygltf trips over in sound files, put into a form that it takes.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace lichtmc {

// Whether JSON text nests objects and arrays deeper than any glTF file does: parsers that call themselves for every
// level would run out of stack.
bool nests_too_deep(const char* begin, const char* end);

// Whether `json` was changed:
//  * Indices without a buffer view, which only compressed meshes have, are left out; decompressing brings them back.
//  * Buffers without data, into which EXT_meshopt_compression says to decompress, get three bytes of data; whoever
//    decompresses does so elsewhere.
bool make_readable(nlohmann::json& json);

}  // namespace lichtmc
