// The image of a texture: which one it is, and its pixels.
#pragma once

#include <optional>
#include <string>

#include "gltf/decode_image.hpp"
#include "gltf/document.hpp"

namespace lichtmc {

// The image of a texture in a format that is read: its own one, or that of EXT_texture_webp; none if the texture has
// only images in other formats. `where`: the texture, for messages ("the base colour texture of material 'wall'").
std::optional<std::size_t> image_of_texture(const Document& document, int texture, const std::string& where);

// Name of an image for messages: its name, URI or number.
std::string image_name(const Document& document, std::size_t image);

// The pixels of a texture. Throws InputError with `where`, the name of the image, the reason and `way_out` if it has no
// image that can be read. `way_out`: what the user can do apart from mending the image, a sentence.
DecodedImage read_texture(const Document& document, int texture, const std::string& where, const std::string& way_out);

}  // namespace lichtmc
