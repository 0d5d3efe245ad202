// Significance of deviations: tail probabilities of the normal, χ² and Student distributions.
#pragma once

#include <cstddef>

namespace lichtmc {

// Probability that a standard normal variable lies above z, and its inverse for 0 < p < 1.
double normal_tail(double z);
double normal_quantile_above(double p);

// Value that χ² with k degrees of freedom (≥ 3, not only whole numbers) exceeds with probability p, and its inverse. E.
// Wilson, M. Hilferty: The Distribution of Chi-Square, 1931; better than 1 % of √(2k).
double chi_square_above(double k, double p);
double chi_square_tail(double k, double chi_square);

// The standard normal value with the same tail probability as t of Student's distribution with `freedom` (> 1) degrees
// of freedom: a deviation divided by an error that was estimated from few differences follows this distribution. D.
// Peizer, J. Pratt: A Normal Approximation, 1968.
double normal_from_student(double t, double freedom);
// The inverse: Student's t with the same tail probability as the standard normal value z.
double student_from_normal(double z, double freedom);

// Probability that the largest absolute value of n independent standard normal variables exceeds z (Z. Šidák, 1967).
double largest_of_normals_tail(double z, std::size_t n);

}  // namespace lichtmc
