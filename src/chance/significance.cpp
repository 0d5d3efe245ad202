#include "chance/significance.hpp"

#include <algorithm>
#include <cmath>

namespace lichtmc {

double normal_tail(double z) {
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

double normal_quantile_above(double p) {
  // Bisection: the tail is monotonic, and 200 bisections of [−40, 40] reach the last digit.
  double low = -40.0;
  double high = 40.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (normal_tail(middle) > p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double chi_square_above(double k, double p) {
  const double c = 2.0 / (9.0 * k);
  const double root = std::max(0.0, 1.0 - c + normal_quantile_above(p) * std::sqrt(c));
  return k * root * root * root;
}

double chi_square_tail(double k, double chi_square) {
  const double c = 2.0 / (9.0 * k);
  return normal_tail((std::cbrt(chi_square / k) - (1.0 - c)) / std::sqrt(c));
}

double normal_from_student(double t, double freedom) {
  if (!std::isfinite(t)) return t;
  const double size = std::sqrt(std::log1p(t * t / freedom) / (freedom - 5.0 / 6.0));
  return std::copysign((freedom - 2.0 / 3.0 + 0.1 / freedom) * size, t);
}

double student_from_normal(double z, double freedom) {
  const double size = z / (freedom - 2.0 / 3.0 + 0.1 / freedom);
  return std::copysign(std::sqrt(freedom * std::expm1(size * size * (freedom - 5.0 / 6.0))), z);
}

double largest_of_normals_tail(double z, std::size_t n) {
  return -std::expm1(static_cast<double>(n) * std::log1p(-std::min(1.0, 2.0 * normal_tail(z))));
}

}  // namespace lichtmc
