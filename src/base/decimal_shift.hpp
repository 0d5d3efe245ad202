// Powers of ten without rounding twice.
#pragma once

namespace lichtmc {

// The double next to value · 10^exponent, where value stands for the shortest decimal number that reads back as it: 0.2
// shifted by −9 is 2e-10, which 0.2 * 1e-9 is not; and shifted back it is 0.2 again. 0 or infinite beyond the range of
// a double.
double shift_decimals(double value, int exponent);

}  // namespace lichtmc
