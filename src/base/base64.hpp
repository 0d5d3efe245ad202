// Base64: bytes as text for URIs and web pages (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace lichtmc {

std::string base64(std::string_view bytes);

}  // namespace lichtmc
