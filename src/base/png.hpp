// PNG files with 8 bits per channel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lichtmc {

// columns × rows pixels of `channels` (1 grey, 3 RGB, 4 RGB and opacity) numbers each, the top row first. Throws
// RuntimeError if the memory does not suffice.
std::string png_file(std::size_t columns, std::size_t rows, int channels, const std::vector<std::uint8_t>& pixels);

// IEC 61966-2-1: linear value (0 … 1) → encoded value (0 … 1), and back.
double srgb_of_light(double light);
double light_of_srgb(double value);

}  // namespace lichtmc
