// Writes OpenEXR files with named channels of floats.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <ImfHeader.h>

namespace lichtmc {

// A channel: one float per pixel, row by row from the top.
struct ExrChannel {
  const char* name = "";
  std::vector<float> values;
};

// The bytes of the file. `header` determines the size and may have attributes; its channels are set here. Throws
// RuntimeError with the name `what` if OpenEXR or the allocation of memory fails.
std::string exr_file(Imf::Header header, std::vector<ExrChannel> channels, const std::string& what);

}  // namespace lichtmc
