// The version of the library.
#pragma once

#include <string_view>

namespace lichtmc {

// "major.minor.patch" (semantic versioning) of the library that is linked.
std::string_view version();

}  // namespace lichtmc
