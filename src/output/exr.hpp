// OpenEXR files of named channels of floats.
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

// The file's bytes. `header` may have attributes of its own; its channels are set here, its size is that of the
// picture. Throws RuntimeError naming `what` where OpenEXR or the memory refuses.
std::string exr_file(Imf::Header header, std::vector<ExrChannel> channels, const std::string& what);

}  // namespace lichtmc
