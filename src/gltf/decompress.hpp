// Compressed meshes: decompressed once after parsing, so that everything else meets plain buffers.
#pragma once

#include "gltf/document.hpp"

namespace lichtmc {

// Decompresses every buffer view that EXT_meshopt_compression has compressed, by meshoptimizer. Throws InputError
// naming the view where its data is damaged or its description does not fit it.
void decompress_views(Document& document);

// Decompresses every primitive that KHR_draco_mesh_compression has compressed, by Draco, to a list of triangles with
// float attributes. Throws InputError naming the mesh where its data is damaged.
void decompress_primitives(Document& document);

}  // namespace lichtmc
