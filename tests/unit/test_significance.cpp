// Probabilities of deviations by chance.
#include "chance/significance.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace lichtmc;

TEST_CASE("significance: tails of the normal law, tabulated") {
  CHECK(normal_tail(0.0) == 0.5);
  CHECK(normal_tail(1.959963985) == Approx(0.025).epsilon(1e-8));
  CHECK(normal_tail(6.0) == Approx(9.865876450e-10).epsilon(1e-9));
  CHECK(normal_quantile_above(0.025) == Approx(1.959963985).epsilon(1e-9));
}

TEST_CASE("significance: chi-square tails, tabulated") {
  // Values that are exceeded with probability 0.01 and 0.95 (NIST/SEMATECH e-Handbook, 1.3.6.7.4).
  CHECK(chi_square_above(10.0, 0.01) == Approx(23.209).epsilon(3e-3));
  CHECK(chi_square_above(100.0, 0.01) == Approx(135.807).epsilon(3e-4));
  CHECK(chi_square_above(100.0, 0.95) == Approx(77.929).epsilon(3e-4));
  CHECK(chi_square_tail(100.0, 135.807) == Approx(0.01).epsilon(0.02));
  CHECK(chi_square_tail(30.0, chi_square_above(30.0, 1e-6)) == Approx(1e-6).epsilon(1e-6));
}

TEST_CASE("significance: Student's law as a normal variable, tabulated") {
  // t that is exceeded with probability 0.025 on one side (NIST/SEMATECH e-Handbook, 1.3.6.7.2).
  CHECK(normal_from_student(2.228, 10.0) == Approx(1.960).epsilon(0.005));
  CHECK(normal_from_student(-2.571, 5.0) == Approx(-1.960).epsilon(0.02));
  CHECK(normal_from_student(2.0, 1e9) == Approx(2.0).epsilon(1e-6));
  CHECK(student_from_normal(1.960, 10.0) == Approx(2.228).epsilon(0.005));
  CHECK(normal_from_student(student_from_normal(3.0, 7.0), 7.0) == Approx(3.0).epsilon(1e-12));
  CHECK(normal_from_student(0.0, 10.0) == 0.0);
}

TEST_CASE("significance: the largest of many") {
  CHECK(largest_of_normals_tail(1.959963985, 1) == Approx(0.05).epsilon(1e-8));
  CHECK(largest_of_normals_tail(6.0, 1000) == Approx(1000 * 2 * 9.8658765e-10).epsilon(1e-5));
  CHECK(largest_of_normals_tail(0.0, 5) == 1.0);
}
