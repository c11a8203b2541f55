#pragma once
// Student's t distribution, for tests on few runs, and the function that it is made of.

namespace yat {

/// Regularised incomplete beta function I_x(a, b) for a, b > 0; y = 1 - x, given apart because it
/// may be tiny. 0 for x <= 0, 1 for y <= 0. Relative error below 1e-10 for a, b <= 1e6. By
/// its continued fraction (Abramowitz and Stegun 1964, 26.5.8), evaluated by Lentz's method (1976).
double incomplete_beta(double x, double y, double a, double b);

/// Chance that |T| >= |t|, T of Student's distribution with df > 0 degrees of freedom (need not be
/// whole; however large). Relative error below 1e-9 for |t| <= 25.
double student_two_sided(double t, double df);

}  // namespace yat
