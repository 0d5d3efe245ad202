// Luminance of colours.
#pragma once

namespace lichtmc {

// Luminance of a linear colour with Rec. 709 primaries.
inline double luminance(double red, double green, double blue) {
  // ITU-R BT.709: 0.2126 R + 0.7152 G + 0.0722 B, in a form that keeps the value of greys exactly.
  return green + 0.2126 * (red - green) + 0.0722 * (blue - green);
}

}  // namespace lichtmc
