// Decompresses meshes once, directly after parsing: all other code reads uncompressed buffers.
#pragma once

#include "gltf/document.hpp"

namespace lichtmc {

// Decompresses every buffer view with EXT_meshopt_compression, using meshoptimizer. Throws InputError with the name of
// the view if its data is damaged or does not match its description.
void decompress_views(Document& document);

// Decompresses every primitive with KHR_draco_mesh_compression, using Draco, to a list of triangles with float
// attributes. Throws InputError with the name of the mesh if its data is damaged.
void decompress_primitives(Document& document);

}  // namespace lichtmc
