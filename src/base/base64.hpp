// Base64: bytes as text for URIs and web pages (RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lichtmc {

std::string base64(std::string_view bytes);

// The bytes of such a text, with or without padding; none if it is not one.
std::optional<std::string> base64_decoded(std::string_view text);

}  // namespace lichtmc
