// Adapts JSON of valid files that tinygltf rejects.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace lichtmc {

// Whether JSON text nests objects and arrays deeper than 256 levels. No glTF file needs that; recursive parsers would
// exhaust the stack.
bool nests_too_deep(const char* begin, const char* end);

// The elements of an array in an object of the file; an empty array, valid until the next call, if there is none.
nlohmann::json& list_in(nlohmann::json& object, const char* name);

// Adapts `json` to tinygltf. Returns whether it was changed.
//  * Indices without a buffer view (in compressed meshes only) are removed; the decompression adds them again.
//  * Buffers without data, the targets of EXT_meshopt_compression, get three bytes of data; lichtmc decompresses into
//    buffers of its own.
bool make_readable(nlohmann::json& json);

}  // namespace lichtmc
