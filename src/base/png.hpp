// Pictures of 8 bits a channel as PNG files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lichtmc {

// columns × rows pixels of `channels` (1 grey, 3 RGB, 4 RGB and opacity) numbers each, the top row first. Throws
// RuntimeError where the memory does not suffice.
std::string png_file(std::size_t columns, std::size_t rows, int channels, const std::vector<std::uint8_t>& pixels);

// IEC 61966-2-1: from light (0 … 1) to the value that stands for it (0 … 1), and back.
double srgb_of_light(double light);
double light_of_srgb(double value);

}  // namespace lichtmc
